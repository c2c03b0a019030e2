#include "report/comparison_document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/json.hpp"
#include "report/json_result.hpp"

namespace recoil {
namespace {

std::optional<NumberRange> range_of(const Json& ends) {
  if (!ends.is_array() || ends.size() != 2 || !ends[0].is_number() || !ends[1].is_number()) {
    return std::nullopt;
  }
  return NumberRange{ends[0].get<double>(), ends[1].get<double>()};
}

std::optional<double> number_of(const Json& value) {
  return value.is_number() ? std::optional<double>(value.get<double>()) : std::nullopt;
}

void take_parameters(const Json& parameters, ComparedFit& fit) {
  for (const auto& [name, parameter] : parameters.items()) {
    ComparedQuantity quantity;
    quantity.name = name;
    quantity.unit = parameter.at("unit").get<std::string>();
    quantity.free = parameter.at("free").get<bool>();
    quantity.value = number_of(parameter.at("value")).value_or(NAN);
    const Json& recommended = parameter.at("recommended");
    if (quantity.free && recommended.is_object() && recommended.at("interval").is_string()) {
      const Json& intervals = parameter.at("intervals");
      quantity.interval =
          range_of(intervals.value(recommended.at("interval").get<std::string>(), Json()));
    }
    fit.free_parameters += quantity.free ? 1 : 0;
    fit.quantities.push_back(std::move(quantity));
  }
}

void take_captures(const Json& captures, bool several, ComparedFit& fit) {
  for (const Json& capture : captures) {
    ComparedQuantity quantity;
    quantity.name = fmt::format("V* at {:.4g} um", capture.at("diameter_um").get<double>());
    if (several) quantity.name += fmt::format(", {}", capture.at("dataset").get<std::string>());
    quantity.unit = "m/s";
    quantity.value = number_of(capture.at("value")).value_or(NAN);
    quantity.interval = range_of(capture.value("interval", Json()));
    fit.quantities.push_back(std::move(quantity));
  }
}

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
  return say("{} {}", number(quantity->value), quantity->interval->text());
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
  const std::string reader = "recoil compare";
  const Json json = read_fit_json(file, fit_json, reader);
  ComparedFit fit;
  try {
    fit.id = json.at("fit").is_object() ? json.at("fit").at("id").get<std::string>()
                                        : json.at("fit").get<std::string>();
    fit.adhesion = json.at("options").value("adhesion", "ring");
    fit.mechanisms = json.at("options").at("mechanisms").get<std::vector<std::string>>();
    const Json& datasets = json.at("datasets");
    for (const Json& dataset : datasets) {
      fit.data.push_back(dataset.at("id").get<std::string>() + " " +
                         dataset.at("sha256").get<std::string>());
      fit.points += dataset.at("points").get<int>();
    }
    const Json& goodness = json.at("goodness");
    fit.chi2 = number_of(goodness.at("chi2")).value_or(NAN);
    fit.sd_stated = goodness.at("p_value").is_number();
    fit.rmse = number_of(goodness.at("rmse")).value_or(NAN);
    fit.held_out_rmse = number_of(json.at("full").value("held_out_rmse", Json()));
    take_parameters(json.at("parameters"), fit);
    take_captures(json.at("derived").at("capture_velocity"), datasets.size() > 1, fit);
  } catch (const Json::exception&) {
    throw InputError({file}, "this is not the whole fit.json of a fit", reader + " needs all of it",
                     "make it again with recoil fit FIT --out DIR");
  }
  return fit;
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
      highest_lower = std::max(highest_lower, quantity->interval->lower);
      lowest_upper = std::min(lowest_upper, quantity->interval->upper);
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
