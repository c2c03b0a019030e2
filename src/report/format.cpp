#include "report/format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace recoil {
namespace {

bool starts_code_point(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

std::size_t code_points(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_code_point));
}

/// Cuts after `count` code points, never inside one.
std::size_t cut_position(std::string_view text, std::size_t count) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (starts_code_point(text[i]) && seen++ == count) return i;
  }
  return text.size();
}

void add_new(std::vector<std::string>& list, const std::vector<std::string>& more) {
  for (const std::string& item : more) {
    if (std::find(list.begin(), list.end(), item) == list.end()) list.push_back(item);
  }
}

Interval no_interval(const std::string& why) {
  Interval interval;
  interval.why = why;
  return interval;
}

}  // namespace

std::string version() { return RECOIL_VERSION; }

std::string number(double value, int count) {
  if (!std::isfinite(value)) return "n/a";
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (size >= std::pow(10.0, count) && size < 1e6) return fmt::format("{:.0f}", value);
  std::string text = fmt::format("{:.{}g}", value, count);
  // 3e-05 has a zero that says nothing.
  const auto e = text.find('e');
  if (e != std::string::npos && text.size() == e + 4 && text[e + 2] == '0') text.erase(e + 2, 1);
  return text;
}

std::string digits(double value, int count) {
  if (!std::isfinite(value) || value == 0.0) return number(value, count);
  const int leading = static_cast<int>(std::floor(std::log10(std::abs(value))));
  if (leading < -4 || leading > 5) return number(value, count);
  return fmt::format("{:.{}f}", value, std::max(0, count - 1 - leading));
}

std::pair<std::string, std::string> number_with_error(double value, double error) {
  if (!std::isfinite(value) || !std::isfinite(error) || error <= 0.0) {
    return {number(value), number(error)};
  }
  const double largest = std::max(std::abs(value), error);
  if (largest < 1e-4 || largest >= 1e6) {
    const int count =
        std::clamp(2 + static_cast<int>(std::floor(std::log10(largest / error))), 2, 12);
    return {number(value, count), number(error, 2)};
  }
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 12);
  return {fmt::format("{:.{}f}", value, decimals), fmt::format("{:.{}f}", error, decimals)};
}

std::string interval_text(const Interval& interval, int count) {
  if (!interval.available()) return "none";
  return fmt::format("[{}, {}]", digits(*interval.lower, count), digits(*interval.upper, count));
}

std::string p_value_text(double p) {
  if (!std::isfinite(p)) return "n/a";
  return p < 1e-6 ? "< 1e-6" : number(p, 2);
}

std::string percent(double fraction) { return fmt::format("{:.4g} %", 100.0 * fraction); }

std::string diameter_text(double diameter) {
  const double um = diameter / units::um;
  if (!std::isfinite(um) || um <= 0.0) return "n/a";
  const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(um))), 1, 6);
  return fmt::format("{:.{}f}", um, decimals);
}

std::string wrap(std::string_view text, std::size_t width, std::size_t indent) {
  std::string out;
  std::size_t column = indent;
  const auto break_line = [&] {
    out += '\n';
    out.append(indent, ' ');
    column = indent;
  };
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t start = text.find_first_not_of(" \t\r\n", at);
    if (start == std::string_view::npos) break;
    std::size_t end = text.find_first_of(" \t\r\n", start);
    if (end == std::string_view::npos) end = text.size();
    std::string_view word = text.substr(start, end - start);
    at = end;
    const bool first = out.empty();
    if (!first && column + 1 + code_points(word) > width) {
      break_line();
    } else if (!first) {
      out += ' ';
      ++column;
    }
    while (column + code_points(word) > width) {
      const std::size_t cut = cut_position(word, width - column);
      out += word.substr(0, cut);
      word.remove_prefix(cut);
      break_line();
    }
    out += word;
    column += code_points(word);
  }
  return out;
}

std::string as_sentence(std::string words) {
  if (words.empty()) return words;
  if (words[0] >= 'a' && words[0] <= 'z' && !words.starts_with("f0")) {
    words[0] = static_cast<char>(words[0] - 'a' + 'A');
  }
  if (std::string_view(".!?").find(words.back()) == std::string_view::npos) words += '.';
  return words;
}

std::string words_of(std::string identifier) {
  std::replace(identifier.begin(), identifier.end(), '_', ' ');
  return identifier;
}

IntervalSet intervals_of(const Analysis& analysis, std::size_t slot) {
  const auto& all = analysis.uncertainty.intervals;
  IntervalSet set;
  if (slot < all.size()) set = all[slot];
  const bool fixed = !analysis.fitted.model.slots[slot].free;
  const std::string why = fixed               ? "the parameter is fixed"
                          : slot < all.size() ? "not computed"
                                              : "no uncertainty was assessed";
  for (Interval* interval :
       {&set.wald, &set.profile, &set.percentile, &set.bca, &set.studentized}) {
    if (fixed || slot >= all.size()) *interval = no_interval(why);
    if (!interval->available() && interval->why.empty()) interval->why = why;
  }
  if (fixed) set.recommended.clear();
  if (set.recommended.empty() && set.recommended_why.empty()) set.recommended_why = why;
  return set;
}

std::string reason_without(const IntervalSet& set) {
  const std::string& why = recommended_interval(set).why;
  return why.empty() ? set.recommended_why : why;
}

std::vector<std::string> recommendations(const Analysis& analysis) {
  std::vector<std::string> sentences;
  for (std::size_t slot = 0; slot < analysis.fitted.model.slots.size(); ++slot) {
    const IntervalSet set = intervals_of(analysis, slot);
    if (set.recommended.empty() || !recommended_interval(set).available()) continue;
    add_new(sentences, {fmt::format("The {} interval is recommended: {}.", set.recommended,
                                    set.recommended_why)});
  }
  return sentences;
}

std::vector<std::string> disagreements(const Analysis& analysis) {
  std::vector<std::string> sentences;
  for (const IntervalSet& set : analysis.uncertainty.intervals) {
    if (!set.disagreement.empty()) add_new(sentences, {as_sentence(set.disagreement)});
  }
  return sentences;
}

std::string chance_text(const BootstrapResult& bootstrap) {
  if (!bootstrap.relative_error) return "";
  return fmt::format(
      "with other random numbers an interval's end would move by at most {:.1f} % of its width "
      "(one standard deviation)",
      100.0 * *bootstrap.relative_error);
}

double correlation(const Analysis& analysis, std::size_t a, std::size_t b) {
  const FitResult& fitted = analysis.fitted;
  const std::size_t slots = fitted.model.slots.size();
  if (fitted.covariance.size() != slots * slots) return 0.0;
  const double product = fitted.covariance[a * slots + a] * fitted.covariance[b * slots + b];
  if (!(product > 0.0) || !std::isfinite(product)) return 0.0;
  return std::clamp(fitted.covariance[a * slots + b] / std::sqrt(product), -1.0, 1.0);
}

Provenance weakest_provenance(const std::vector<Dataset>& datasets) {
  // The enumerators stand in the order of how much they claim, the most first.
  Provenance weakest = Provenance::measured;
  for (const Dataset& dataset : datasets) weakest = std::max(weakest, dataset.provenance);
  return weakest;
}

std::vector<std::pair<std::string, std::string>> provenances(const std::vector<Dataset>& datasets) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Dataset& dataset : datasets) {
    const std::pair entry{to_string(dataset.provenance), provenance_sentence(dataset.provenance)};
    if (std::find(list.begin(), list.end(), entry) == list.end()) list.push_back(entry);
  }
  return list;
}

std::vector<std::string> all_warnings(const Analysis& analysis) {
  std::vector<std::string> warnings;
  for (const Dataset& dataset : analysis.datasets) add_new(warnings, dataset.warnings);
  add_new(warnings, analysis.data.warnings);
  add_new(warnings, analysis.fitted.warnings);
  add_new(warnings, analysis.uncertainty.warnings);
  return warnings;
}

std::vector<std::string> all_contradictions(const Analysis& analysis) {
  std::vector<std::string> sentences;
  const auto& contacts = analysis.fitted.model.contacts;
  for (std::size_t k = 0; k < contacts.size() && k < analysis.datasets.size(); ++k) {
    for (const std::string& sentence : contacts[k].contradictions) {
      sentences.push_back(fmt::format("{}: {}", analysis.datasets[k].id, sentence));
    }
  }
  return sentences;
}

const TwoPointComparison* two_point_of(const Analysis& analysis, std::size_t dataset) {
  for (const TwoPointComparison& comparison : analysis.uncertainty.two_point) {
    if (comparison.dataset == dataset) return &comparison;
  }
  return nullptr;
}

bool without_adhesion(const Analysis& analysis, std::size_t dataset) {
  const ImpactModel& model = analysis.fitted.model;
  if (dataset >= model.contacts.size() || !model.chain.empty()) return false;
  return model.contacts[dataset].adhesion_force == 0.0 && !model.slots[model.slot_f0[dataset]].free;
}

ImpactConditions reference_conditions(const Analysis& analysis, std::size_t dataset,
                                      double velocity) {
  const FitResult& fitted = analysis.fitted;
  return conditions_at(fitted.model, fitted.theta, dataset,
                       fitted.model.contacts[dataset].reference_diameter, velocity);
}

double residual_unit(const Analysis& analysis) {
  const double scale = analysis.fitted.noise_scale;
  return !analysis.data.sd_stated && std::isfinite(scale) && scale > 0.0 ? scale : 1.0;
}

}  // namespace recoil
