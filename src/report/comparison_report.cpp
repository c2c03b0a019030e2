#include "report/comparison_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/program.hpp"
#include "core/units.hpp"
#include "estimate/likelihood.hpp"
#include "report/format.hpp"
#include "report/result_entries.hpp"
#include "report/result_json.hpp"
#include "report/words_verdict.hpp"

namespace recoil {
namespace {

constexpr double errors_to_end = 1.96;  // half width of a 95 % interval in standard errors

/// The names of all quantities in the fits, without repetition.
std::vector<std::string> compared_names(const std::vector<ComparedFit>& fits) {
  std::vector<std::string> names;
  for (const ComparedFit& fit : fits) {
    for (const ComparedQuantity& quantity : fit.quantities) {
      if (std::ranges::find(names, quantity.name) == names.end()) names.push_back(quantity.name);
    }
  }
  return names;
}

/// @throws InputError if the fits are not of the same data
void require_same_data(const std::vector<ComparedFit>& fits) {
  for (const ComparedFit& fit : fits) {
    if (fit.data == fits.front().data) continue;
    throw InputError({},
                     fmt::format("{} and {} are fits of different data", fits.front().id, fit.id),
                     "only fits of the same points can be compared", "fit the same datasets again");
  }
}

/// Null if the fit does not have the quantity.
const ComparedQuantity* quantity_of(const ComparedFit& fit, const std::string& name) {
  const auto found = std::ranges::find(fit.quantities, name, &ComparedQuantity::name);
  return found == fit.quantities.end() ? nullptr : &*found;
}

std::string title_of(const ComparedFit& fit) {
  std::string title = fit.adhesion;
  for (const std::string& mechanism : fit.mechanisms) title += " + " + mechanism;
  return title;
}

std::optional<double> lowest_aicc(const std::vector<ComparedFit>& fits) {
  std::optional<double> lowest;
  for (const ComparedFit& fit : fits) {
    if (const auto aicc = fit.aicc()) lowest = std::min(lowest.value_or(*aicc), *aicc);
  }
  return lowest;
}

Table quality_table(const std::vector<ComparedFit>& fits) {
  const std::optional<double> best = lowest_aicc(fits);
  Table table;
  table.columns = {{"fit"},
                   {"adhesion"},
                   {"free"},
                   {"chi-square"},
                   {"AICc above the best"},
                   {say("rms of {e}")},
                   {"held out"}};
  const bool laws =
      std::ranges::any_of(fits, [](const ComparedFit& fit) { return fit.laws.has_value(); });
  if (laws) table.columns.push_back({"error of the laws", "of the loss", true});
  for (const ComparedFit& fit : fits) {
    const auto aicc = fit.aicc();
    table.rows.push_back(
        {Sentence(fit.id), title_of(fit) == fit.id ? Cell() : Cell(Sentence(title_of(fit))),
         whole(fit.free_parameters), Number{fit.chi2},
         aicc && best ? Cell(Number{*aicc - *best, fixed(1)}) : Cell("not defined"),
         Number{fit.rmse}, cell_if(number_if(fit.held_out_rmse, {}))});
    if (laws) {
      table.rows.back().push_back(fit.laws ? law_error_range(*fit.laws) : "taken as exact");
    }
  }
  return table;
}

/// The name of a quantity with its symbol and unit marked: "C_A", "V* at 1.27 um, quartz".
Sentence quantity_sentence(const std::string& name) {
  const auto end = name.find(" at ");
  if (end == std::string::npos) return symbol(name);
  const std::string where = name.substr(end);
  const auto um = where.find(" um");
  Sentence words = symbol(name.substr(0, end));
  if (um == std::string::npos) return words + where;
  return words + say("{} {um}{}", where.substr(0, um), where.substr(um + 3));
}

Cell quantity_cell(const ComparedQuantity* quantity) {
  if (quantity == nullptr) return {};
  if (!std::isfinite(quantity->value)) return "none";
  if (!quantity->free) return say("{} (not fitted)", number(quantity->value));
  if (!quantity->interval) return Number{quantity->value};
  const auto& [lower, upper] = *quantity->interval;
  return say("{} {}", number(quantity->value), NumberRange{lower, upper}.text());
}

Table quantity_table(const std::vector<ComparedFit>& fits) {
  Table table;
  table.columns = {{"quantity"}, {"unit"}};
  for (const ComparedFit& fit : fits) table.columns.push_back({Sentence(fit.id), "", true});
  for (const std::string& name : compared_names(fits)) {
    std::vector<Cell> row = {quantity_sentence(name), Cell()};
    for (const ComparedFit& fit : fits) {
      const ComparedQuantity* const quantity = quantity_of(fit, name);
      if (quantity != nullptr) row[1] = unit(quantity->unit);
      row.push_back(quantity_cell(quantity));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

Sentence dependence_words(const ChoiceDependence& found) {
  if (found.depends.empty() && found.holds.empty()) {
    return "No quantity has an interval in more than one of the fits.";
  }
  if (found.depends.empty()) return "No quantity depends on the choice: all intervals overlap.";
  if (found.holds.empty()) {
    return "Every quantity depends on the choice, as their intervals do not overlap.";
  }
  const std::size_t all = found.depends.size() + found.holds.size();
  const auto listed = [](const std::vector<std::string>& names) {
    return joined(names, ", ", quantity_sentence);
  };
  if (found.holds.size() < found.depends.size()) {
    return say(
        "{} of {} quantities depend on the choice, as their intervals do not overlap: all "
        "but {}.",
        found.depends.size(), all, listed(found.holds));
  }
  return say("{} of {} quantities depend on the choice, as their intervals do not overlap: {}.",
             found.depends.size(), all, listed(found.depends));
}

/// The interval of +- `errors_to_end` standard errors, in ln(value) if `log_scale`.
Ends around(double value, double error, bool log_scale) {
  if (!log_scale) return {value - errors_to_end * error, value + errors_to_end * error};
  const double factor = std::exp(errors_to_end * error / value);
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
  if (f.data.noise.sd_stated) fit.minus_two_log_likelihood = minus_two_log_likelihood(f);
  fit.rmse = f.rmse;
  fit.held_out_rmse = law.held_out_rmse;
  fit.laws = judge_model(f).laws;
  for (std::size_t s = 0; s < f.theta.size(); ++s) {
    const ParameterSlot& slot = f.model.slots[s];
    if (slot.is_constant() && !slot.moves()) continue;  // fixed at its stated value under every law
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

/// laws.json.
struct LawsFile {
  std::vector<ComparedFit> laws;
  RECOIL_FIELDS(laws)
};

ComparisonFile::Fit fit_of(const ComparedFit& fit, std::optional<double> best) {
  const auto aicc = fit.aicc();
  return {.id = fit.id,
          .adhesion = value_named<AdhesionLaw>(fit.adhesion).value(),
          .mechanisms = fit.mechanisms,
          .free_parameters = fit.free_parameters,
          .points = fit.points,
          .chi2 = fit.chi2,
          .aicc = aicc,
          .aicc_above_best = aicc && best ? OrNull<double>(*aicc - *best) : std::nullopt,
          .rmse = fit.rmse,
          .held_out_rmse = fit.held_out_rmse,
          .law_error = law_error_found(fit.laws)};
}

}  // namespace

std::optional<double> ComparedFit::aicc() const {
  const int k = free_parameters;
  if (!minus_two_log_likelihood || points - k - 1 <= 0) return std::nullopt;
  return *minus_two_log_likelihood + 2.0 * k + 2.0 * k * (k + 1.0) / (points - k - 1.0);
}

std::vector<ComparedFit> told_apart(std::vector<ComparedFit> fits) {
  std::map<std::string, std::vector<ComparedFit*>> same;
  for (ComparedFit& fit : fits) same[fit.id].push_back(&fit);
  for (const auto& [id, members] : same) {
    for (std::size_t k = 0; k < members.size() && members.size() > 1; ++k) {
      members[k]->id += fmt::format(" ({})", k + 1);
    }
  }
  return fits;
}

ComparedFit compared_fit(const std::string& file, const std::string& fit_json) {
  const FitFile read = read_fit_file(file, fit_json, "recoil compare");
  ComparedFit fit;
  fit.id = read.fit.id;
  fit.adhesion = to_string(read.options.adhesion);
  fit.mechanisms = read.options.mechanisms;
  for (const DatasetEntry& dataset : read.datasets) {
    fit.data.push_back(dataset.id + " " + dataset.sha256);
    fit.points += static_cast<int>(dataset.points);
  }
  fit.chi2 = read.goodness.chi2.value.value_or(NAN);
  fit.minus_two_log_likelihood = read.goodness.minus_two_log_likelihood.value;
  fit.rmse = read.goodness.rmse.value.value_or(NAN);
  fit.held_out_rmse = read.full.held_out_rmse.value;
  if (const auto& laws = read.model_verdict.law_error) {
    fit.laws = {laws->probability_of_exact_laws, laws->median, laws->lower, laws->upper};
  }
  for (const auto& [name, parameter] : read.parameters) {
    fit.quantities.push_back(
        {.name = name,
         .unit = parameter.unit,
         .value = parameter.value.value.value_or(NAN),
         .free = parameter.free,
         .interval = parameter.free ? recommended_interval(parameter) : std::nullopt});
    fit.free_parameters += parameter.free ? 1 : 0;
  }
  for (const FitFile::CaptureVelocity& capture : read.derived.capture_velocity) {
    fit.quantities.push_back({.name = capture_name(capture.diameter_um.value_or(NAN),
                                                   capture.dataset, read.datasets.size()),
                              .unit = "m/s",
                              .value = capture.value.value.value_or(NAN),
                              .free = true,
                              .interval = capture.interval});
  }
  return fit;
}

std::string capture_name(double diameter_um, const std::string& dataset, std::size_t datasets) {
  const std::string name = diameter_um < 1000.0
                               ? fmt::format("V* at {:.4g} um", diameter_um)
                               : fmt::format("V* at {:.4g} mm", diameter_um / 1000.0);
  return datasets > 1 ? name + ", " + dataset : name;
}

std::vector<ComparedFit> compared_laws(const std::vector<LawFit>& laws,
                                       const std::vector<Dataset>& datasets) {
  std::vector<ComparedFit> fits;
  for (const LawFit& law : laws) {
    if (law.fitted && law.fitted->usable) fits.push_back(compared_law(law, datasets));
  }
  return fits;
}

std::string laws_json(const std::vector<ComparedFit>& laws) {
  Json json = as_json(LawsFile{laws});
  for (std::size_t k = 0; k < laws.size(); ++k) json["laws"][k]["aicc"] = as_json(laws[k].aicc());
  return json_text(json);
}

ChoiceDependence choice_dependence(const std::vector<ComparedFit>& fits) {
  ChoiceDependence found;
  for (const std::string& name : compared_names(fits)) {
    std::size_t with_interval = 0;
    double highest_lower = -INFINITY;
    double lowest_upper = INFINITY;
    for (const ComparedFit& fit : fits) {
      const ComparedQuantity* const quantity = quantity_of(fit, name);
      if (quantity == nullptr || !quantity->interval) continue;
      ++with_interval;
      highest_lower = std::max(highest_lower, (*quantity->interval)[0]);
      lowest_upper = std::min(lowest_upper, (*quantity->interval)[1]);
    }
    if (with_interval < 2) continue;
    (highest_lower > lowest_upper ? found.depends : found.holds).push_back(name);
  }
  return found;
}

std::vector<Section> comparison_sections(const std::vector<ComparedFit>& fits) {
  require_same_data(fits);
  return {
      shown_section("quality", "Quality of the fits", {quality_table(fits)}),
      shown_section("quantities", "Parameters and capture velocities",
                    {Paragraph{dependence_words(choice_dependence(fits))}, quantity_table(fits)})};
}

std::vector<Block> law_blocks(const std::vector<ComparedFit>& laws) {
  if (laws.size() < 2) return {};
  Table table = quality_table(laws);
  table.columns.front().heading = "law of adhesion";
  for (std::size_t k = 0; k < laws.size(); ++k) table.rows[k].front() = words_of(laws[k].adhesion);
  return {table, Paragraph{dependence_words(choice_dependence(laws))}};
}

std::string comparison_json(const std::vector<ComparedFit>& fits) {
  require_same_data(fits);
  const std::optional<double> best = lowest_aicc(fits);
  ComparisonFile out = {.recoil_version = version(), .data = fits.front().data};
  for (const ComparedFit& fit : fits) out.fits.push_back(fit_of(fit, best));
  const ChoiceDependence dependence = choice_dependence(fits);
  for (const std::string& name : compared_names(fits)) {
    ComparisonFile::Quantity& entry = out.quantities.emplace_back();
    entry.name = name;
    for (const ComparedFit& fit : fits) {
      auto& of_fit = entry.fits.emplace_back();
      const ComparedQuantity* const found = quantity_of(fit, name);
      if (found == nullptr) continue;
      entry.unit = found->unit;
      of_fit = {found->value, found->free, found->interval};
    }
    const auto is_in = [&](const std::vector<std::string>& names) {
      return std::ranges::find(names, name) != names.end();
    };
    if (is_in(dependence.depends)) entry.depends_on_choice = true;
    if (is_in(dependence.holds)) entry.depends_on_choice = false;
  }
  return text_of(out);
}

}  // namespace recoil
