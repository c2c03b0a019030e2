#include "report/format.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <set>

#include "core/program.hpp"
#include "core/units.hpp"
#include "report/words_dataset.hpp"

namespace recoil {

Cell interval_cell(const Interval& interval, const Notation& notation) {
  if (!interval.available()) return {};
  return NumberRange{*interval.lower, *interval.upper, notation};
}

std::string diameter_text(double diameter) {
  const double um = diameter / units::um;
  if (!std::isfinite(um) || um <= 0.0) return "n/a";
  const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(um))), 1, 6);
  return fmt::format("{:.{}f}", um, decimals);
}

SizeUnit size_unit(std::span<const double> diameters) {
  constexpr double ball = 1e-3;  // [m]
  const bool balls = !diameters.empty() && std::ranges::all_of(diameters, [](double diameter) {
    return diameter >= ball;
  });
  return balls ? SizeUnit{1e-3, "mm", "mm"} : SizeUnit{units::um, "um", "µm"};
}

SizeUnit size_unit(std::span<const Dataset> datasets) {
  std::vector<double> diameters;
  for (const Dataset& dataset : datasets) {
    for (const ImpactPoint& point : dataset.points) diameters.push_back(point.diameter);
  }
  return size_unit(diameters);
}

std::string size_text(double diameter, const SizeUnit& unit) {
  return diameter_text(diameter * units::um / unit.metres);
}

std::string diameter_label(double diameter) {
  const SizeUnit unit = size_unit(std::span<const double>(&diameter, 1));
  return size_text(diameter, unit) + " " + unit.sign;
}

std::string diameter_words(double diameter) { return plain_text(diameter_sentence(diameter)); }

Sentence diameter_sentence(double diameter) {
  return diameter < 1e-3 ? say("{:.3g} {um}", diameter / units::um)
                         : say("{:.3g} mm", diameter / 1e-3);
}

std::string today() {
  const char* const stated = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t now =
      stated == nullptr ? std::time(nullptr) : static_cast<std::time_t>(std::atoll(stated));
  std::tm date{};
  gmtime_r(&now, &date);
  return fmt::format("{:04}-{:02}-{:02}", date.tm_year + 1900, date.tm_mon + 1, date.tm_mday);
}

std::string p_words(double p) { return p < 1e-6 ? "p < 1e-6" : fmt::format("p = {:.2g}", p); }

Number with_interval(double value, const Interval& interval, const Notation& notation) {
  Number number{value, notation};
  if (interval.available()) number.band = {*interval.lower, *interval.upper};
  return number;
}

const CaptureEstimate* reference_capture(const Analysis& a, std::size_t dataset) {
  const double reference = a.fitted.model.contacts[dataset].reference_diameter;
  const CaptureEstimate* nearest = nullptr;
  for (const CaptureEstimate& capture : a.uncertainty.capture) {
    if (capture.dataset != dataset || !capture.found || without_adhesion(a, dataset)) continue;
    const auto distance = [&](const CaptureEstimate& one) {
      return std::abs(std::log(one.diameter / reference));
    };
    if (nearest == nullptr || distance(capture) < distance(*nearest)) nearest = &capture;
  }
  return nearest;
}

Document page_of(const std::string& title, const std::string& name, std::vector<Section> sections) {
  Document page;
  page.title = title;
  page.heading = title;
  page.name = name;
  page.foot = "recoil " + version();
  page.sections = std::move(sections);
  page.sections.front().title = {};
  page.sections.front().remark = {};
  return page;
}

IntervalSet intervals_of(const Analysis& analysis, std::size_t slot) {
  const auto& all = analysis.uncertainty.intervals;
  const bool fixed = !analysis.fitted.model.slots[slot].free;
  if (!fixed && slot < all.size()) return all[slot];
  IntervalSet set;
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    set[kind] = no_interval(fixed ? NoInterval::fixed : NoInterval::not_assessed);
  }
  return set;
}

std::vector<std::pair<std::string, std::string>> provenances(const std::vector<Dataset>& datasets) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Dataset& dataset : datasets) {
    const std::pair entry{to_string(dataset.provenance), provenance_sentence(dataset.provenance)};
    if (std::ranges::find(list, entry) == list.end()) list.push_back(entry);
  }
  return list;
}

std::string short_name(const std::vector<Dataset>& datasets, std::size_t dataset) {
  std::set<std::string> surfaces;
  for (const Dataset& one : datasets) surfaces.insert(one.system.surface.name);
  const bool all_differ = surfaces.size() == datasets.size() && !surfaces.contains("");
  return all_differ ? datasets[dataset].system.surface.name : datasets[dataset].id;
}

std::string constant_words(const ImpactModel& model, std::size_t constant,
                           const std::vector<Dataset>& datasets) {
  const UncertainConstant& one = model.constants[constant];
  if (one.of_laws) return "error of the laws";
  const ImpactSystem& system = datasets[one.datasets.front()].system;
  const std::string& name = one.body == Body::particle ? system.particle.name : system.surface.name;
  return fmt::format("{} of {}", words_of_constant(one.constant),
                     name.empty() ? "the " + std::string(name_of(one.body)) : name);
}

Sentence parameter_words(const ImpactModel& model, std::size_t slot,
                         const std::vector<Dataset>& datasets) {
  const ParameterSlot& one = model.slots[slot];
  if (one.is_constant()) return constant_words(model, slot - model.first_constant(), datasets);
  const std::string name(one.parameter->name);
  const std::string label = one.label();
  std::string owner = label.size() > name.size()
                          ? label.substr(name.size() + 1, label.size() - name.size() - 2)
                          : std::string();
  for (std::size_t k = 0; k < datasets.size(); ++k) {
    if (owner == datasets[k].id) owner = short_name(datasets, k);
  }
  if (one.mechanism() == nullptr) {
    return symbol(owner.empty() ? name : fmt::format("{}[{}]", name, owner));
  }
  return words_of(name) + (owner.empty() ? "" : fmt::format(" ({})", owner));
}

Sentence name_with_unit(const Sentence& name, std::string_view unit_name) {
  return unit_name == "1" ? name : name + " [" + unit(unit_name) + "]";
}

bool without_adhesion(const Analysis& analysis, std::size_t dataset) {
  return without_adhesion(analysis.fitted.model, dataset);
}

bool adheres_anywhere(const ImpactModel& model) {
  for (std::size_t d = 0; d < model.contacts.size(); ++d) {
    if (!without_adhesion(model, d)) return true;
  }
  return false;
}

ImpactConditions reference_conditions(const Analysis& analysis, std::size_t dataset,
                                      double velocity) {
  const FitResult& fitted = analysis.fitted;
  return conditions_at(fitted.model, fitted.theta, dataset,
                       fitted.model.contacts[dataset].reference_diameter, velocity);
}

List list_of_sentences(const std::vector<Sentence>& sentences) {
  List list;
  for (const Sentence& sentence : sentences) {
    if (!sentence.empty()) list.entries.push_back(as_sentence(sentence));
  }
  return list;
}

Section shown_section(const char* id, const char* title, Blocks blocks) {
  return {id, title, {}, std::move(blocks)};
}

Section detail_section(const char* id, const char* title, Blocks blocks) {
  return {id, title, {}, std::move(blocks), "", Importance::detail};
}

}  // namespace recoil
