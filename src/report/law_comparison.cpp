#include "report/law_comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace recoil {
namespace {

constexpr double width = 1.96;  // standard errors of a 95 % interval of a normal estimate

Ends around(double value, double error, bool log_scale) {
  if (!log_scale) return {value - width * error, value + width * error};
  const double factor = std::exp(width * error / value);
  return {value / factor, value * factor};
}

ComparedFit compared_law(const LawFit& law, const std::vector<Dataset>& datasets) {
  const FitResult& f = *law.fitted;
  ComparedFit fit;
  fit.id = to_string(law.law);
  fit.adhesion = fit.id;
  fit.mechanisms = law.spec.mechanisms;
  for (const Dataset& dataset : datasets) {
    fit.data.push_back(dataset.id + " " + dataset.sha256);
    fit.points += static_cast<int>(dataset.points.size());
  }
  fit.chi2 = f.chi2;
  fit.sd_stated = f.data.sd_stated && f.dof > 0;
  fit.rmse = f.rmse;
  fit.held_out_rmse = law.held_out_rmse;
  for (std::size_t s = 0; s < f.theta.size(); ++s) {
    const ParameterSlot& slot = f.model.slots[s];
    ComparedQuantity quantity{slot.label(), std::string(slot.parameter->unit),
                              acting_value(f.model, f.theta, s), slot.free, std::nullopt};
    const double error = s < f.std_error.size() ? f.std_error[s] : 0.0;
    if (slot.free && !f.at_bound[s] && error > 0.0) {
      const Ends ends = around(f.theta[s], error, slot.log_scale);
      quantity.interval = {std::max(ends[0], slot.lower), std::min(ends[1], slot.upper)};
    }
    fit.free_parameters += slot.free ? 1 : 0;
    fit.quantities.push_back(std::move(quantity));
  }
  for (const LawCapture& capture : law.captures) {
    ComparedQuantity quantity;
    quantity.name =
        capture_name(capture.diameter / units::um, datasets[capture.dataset].id, datasets.size());
    quantity.unit = "m/s";
    quantity.value = capture.value.value_or(NAN);
    if (capture.value && capture.std_error) {
      quantity.interval = around(*capture.value, *capture.std_error, true);
    }
    fit.quantities.push_back(std::move(quantity));
  }
  return fit;
}

/// `laws.json`.
struct LawsFile {
  std::vector<ComparedFit> laws;
  RECOIL_FIELDS(laws)
};

}  // namespace

std::vector<ComparedFit> compared_laws(const std::vector<LawFit>& laws,
                                       const std::vector<Dataset>& datasets) {
  std::vector<ComparedFit> fits;
  for (const LawFit& law : laws) {
    if (law.fitted && law.fitted->usable) fits.push_back(compared_law(law, datasets));
  }
  return fits;
}

Section laws_section(const std::vector<ComparedFit>& laws) {
  Section section{"laws", "The choice of the adhesion law", {}, {}};
  if (laws.size() < 2) {
    section.blocks.emplace_back(Paragraph{"No other law has an answer here."});
    return section;
  }
  for (Section& part : comparison_sections(laws)) {
    for (Block& block : part.blocks) section.blocks.push_back(std::move(block));
  }
  section.blocks.emplace_back(Paragraph{say(
      "The same points under other laws. The intervals extend by 1.96 standard errors to either "
      "side, to first order, and stop at the bounds. Under another law {C_A} and {C_H} act on "
      "another force: that their intervals overlap does not make them one quantity.")});
  return section;
}

std::string laws_json(const std::vector<ComparedFit>& laws) {
  Json json = as_json(LawsFile{laws});
  for (std::size_t k = 0; k < laws.size(); ++k) {
    json["laws"][k]["aicc"] = as_json(laws[k].aicc());
  }
  return json_text(json);
}

std::vector<ComparedFit> read_laws(const std::string& page, const std::string& json) {
  const Json parsed = Json::parse(json, nullptr, false);
  try {
    if (!parsed.contains("laws")) throw JsonMismatch(parsed, "the fits under several laws");
    LawsFile file = value_from<LawsFile>(parsed);
    for (ComparedFit& fit : file.laws) fit.id = fit.adhesion;
    return file.laws;
  } catch (const JsonMismatch&) {
    throw InputError({page}, "its laws.json is not what recoil writes", "the index is made from it",
                     "run recoil report --force");
  }
}

}  // namespace recoil
