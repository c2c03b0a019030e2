#include "report/comparison_document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "json/fit_file.hpp"

namespace recoil {
namespace {

const ComparedQuantity* quantity_of(const ComparedFit& fit, const std::string& name) {
  const auto found =
      std::find_if(fit.quantities.begin(), fit.quantities.end(),
                   [&](const ComparedQuantity& quantity) { return quantity.name == name; });
  return found == fit.quantities.end() ? nullptr : &*found;
}

std::string title_of(const ComparedFit& fit) {
  std::string title = fit.adhesion;
  for (const std::string& mechanism : fit.mechanisms) title += " + " + mechanism;
  return title;
}

Table quality_table(const std::vector<ComparedFit>& fits) {
  std::optional<double> best;
  for (const ComparedFit& fit : fits) {
    if (const auto aicc = fit.aicc()) best = std::min(best.value_or(*aicc), *aicc);
  }
  Table table;
  table.columns = {{"fit"},      {"adhesion"}, {"free"}, {"chi2"}, {"AICc above the best"},
                   {"rms of e"}, {"held out"}};
  for (const ComparedFit& fit : fits) {
    const auto aicc = fit.aicc();
    table.rows.push_back(
        {Sentence(fit.id), Sentence(title_of(fit)),
         Number{static_cast<double>(fit.free_parameters), fixed(0)}, Number{fit.chi2},
         aicc && best ? Cell(Number{*aicc - *best, fixed(1)}) : Cell("not defined"),
         Number{fit.rmse}, fit.held_out_rmse ? Cell(Number{*fit.held_out_rmse}) : Cell()});
  }
  return table;
}

/// A compared quantity by its name: "C_A", "V* at 1.27 um, quartz".
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
  const auto listed_names = [](const std::vector<std::string>& names) {
    std::vector<Sentence> sentences;
    for (const std::string& name : names) sentences.push_back(quantity_sentence(name));
    return join(sentences, ", ");
  };
  if (found.depends.empty() && found.holds.empty()) {
    return "No quantity has an interval in more than one of the fits.";
  }
  if (found.depends.empty()) {
    return say("Nothing depends on the choice: the intervals of {} overlap.",
               listed_names(found.holds));
  }
  if (found.holds.empty()) {
    return say("Everything depends on the choice: the intervals of {} do not overlap.",
               listed_names(found.depends));
  }
  return say(
      "These depend on the choice, since their intervals do not overlap: {}. These do not: {}.",
      listed_names(found.depends), listed_names(found.holds));
}

}  // namespace

std::vector<std::string> compared_names(const std::vector<ComparedFit>& fits) {
  std::vector<std::string> names;
  for (const ComparedFit& fit : fits) {
    for (const ComparedQuantity& quantity : fit.quantities) {
      if (std::find(names.begin(), names.end(), quantity.name) == names.end()) {
        names.push_back(quantity.name);
      }
    }
  }
  return names;
}

void require_same_data(const std::vector<ComparedFit>& fits) {
  for (const ComparedFit& fit : fits) {
    if (fit.data == fits.front().data) continue;
    throw InputError({},
                     fmt::format("{} and {} are fits of different data", fits.front().id, fit.id),
                     "only fits of the same points can be compared", "fit the same datasets again");
  }
}

std::optional<double> ComparedFit::aicc() const {
  const int k = free_parameters;
  if (!sd_stated || points - k - 1 <= 0) return std::nullopt;
  return chi2 + 2.0 * k + 2.0 * k * (k + 1.0) / (points - k - 1.0);
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
  fit.sd_stated = read.goodness.p_value.value.has_value();
  fit.rmse = read.goodness.rmse.value.value_or(NAN);
  fit.held_out_rmse = read.full.held_out_rmse.value;
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
  const std::string name = fmt::format("V* at {:.4g} um", diameter_um);
  return datasets > 1 ? name + ", " + dataset : name;
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
  return {{"quality", "How well each describes the data", {}, {quality_table(fits)}},
          {"quantities",
           "What each fit gives",
           {},
           {Paragraph{dependence_words(choice_dependence(fits))}, quantity_table(fits)}}};
}

}  // namespace recoil
