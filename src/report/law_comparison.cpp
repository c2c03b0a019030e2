#include "report/law_comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/units.hpp"
#include "report/json_values.hpp"

namespace recoil {
namespace {

constexpr double width = 1.96;  // standard errors of a 95 % interval of a normal estimate

NumberRange around(double value, double error, bool log_scale) {
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
      const NumberRange ends = around(f.theta[s], error, slot.log_scale);
      quantity.interval = {std::max(ends.lower, slot.lower), std::min(ends.upper, slot.upper)};
    }
    fit.free_parameters += slot.free ? 1 : 0;
    fit.quantities.push_back(std::move(quantity));
  }
  for (const LawCapture& capture : law.captures) {
    ComparedQuantity quantity;
    quantity.name = fmt::format("V* at {:.4g} um", capture.diameter / units::um);
    if (datasets.size() > 1) quantity.name += ", " + datasets[capture.dataset].id;
    quantity.unit = "m/s";
    quantity.value = capture.value.value_or(NAN);
    if (capture.value && capture.std_error) {
      quantity.interval = around(*capture.value, *capture.std_error, true);
    }
    fit.quantities.push_back(std::move(quantity));
  }
  return fit;
}

Json range_json(const std::optional<NumberRange>& range) {
  return range ? Json::array({range->lower, range->upper}) : Json();
}

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
  Json all = Json::array();
  for (const ComparedFit& fit : laws) {
    Json quantities = Json::array();
    for (const ComparedQuantity& quantity : fit.quantities) {
      quantities.push_back({{"name", quantity.name},
                            {"unit", quantity.unit},
                            {"value", number_or_null(quantity.value)},
                            {"free", quantity.free},
                            {"interval", range_json(quantity.interval)}});
    }
    all.push_back({{"adhesion", fit.adhesion},
                   {"mechanisms", fit.mechanisms},
                   {"data", fit.data},
                   {"points", fit.points},
                   {"free_parameters", fit.free_parameters},
                   {"chi2", number_or_null(fit.chi2)},
                   {"sd_stated", fit.sd_stated},
                   {"aicc", fit.aicc() ? Json(*fit.aicc()) : Json()},
                   {"rmse", number_or_null(fit.rmse)},
                   {"held_out_rmse", fit.held_out_rmse ? Json(*fit.held_out_rmse) : Json()},
                   {"quantities", quantities}});
  }
  return Json({{"laws", all}}).dump(2) + "\n";
}

std::vector<ComparedFit> read_laws(const std::string& page, const std::string& json) {
  const auto number = [](const Json& value) {
    return value.is_number() ? value.get<double>() : NAN;
  };
  std::vector<ComparedFit> fits;
  try {
    const Json parsed = Json::parse(json);
    for (const Json& one : parsed.at("laws")) {
      ComparedFit& fit = fits.emplace_back();
      fit.adhesion = one.at("adhesion").get<std::string>();
      fit.id = fit.adhesion;
      fit.mechanisms = one.at("mechanisms").get<std::vector<std::string>>();
      fit.data = one.at("data").get<std::vector<std::string>>();
      fit.points = one.at("points").get<int>();
      fit.free_parameters = one.at("free_parameters").get<int>();
      fit.chi2 = number(one.at("chi2"));
      fit.sd_stated = one.at("sd_stated").get<bool>();
      fit.rmse = number(one.at("rmse"));
      if (one.at("held_out_rmse").is_number()) {
        fit.held_out_rmse = one.at("held_out_rmse").get<double>();
      }
      for (const Json& quantity : one.at("quantities")) {
        ComparedQuantity& next = fit.quantities.emplace_back();
        next.name = quantity.at("name").get<std::string>();
        next.unit = quantity.at("unit").get<std::string>();
        next.value = number(quantity.at("value"));
        next.free = quantity.at("free").get<bool>();
        const Json& ends = quantity.at("interval");
        if (ends.is_array()) {
          next.interval = NumberRange{ends.at(0).get<double>(), ends.at(1).get<double>()};
        }
      }
    }
  } catch (const Json::exception&) {
    throw InputError({page}, "its laws.json is not what recoil writes", "the index is made from it",
                     "run recoil report --force");
  }
  return fits;
}

}  // namespace recoil
