#include "report/pair_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/format.hpp"

namespace recoil {
namespace {

constexpr double most_without_answer = 0.1;

std::optional<double> relative_bias(const EstimateScatter& scatter, double truth) {
  if (!scatter.median || !(truth > 0.0)) return std::nullopt;
  return *scatter.median / truth - 1.0;
}

std::optional<double> relative_spread(const EstimateScatter& scatter, const EstimateScatter& full) {
  if (!scatter.spread || !full.spread || !(*full.spread > 0.0)) return std::nullopt;
  return *scatter.spread / *full.spread;
}

std::string velocities(const Analysis& a, const PairQuality& pair) {
  return fmt::format("{} and {} m/s", number(a.fitted.data.points[pair.low_point].velocity, 3),
                     number(a.fitted.data.points[pair.high_point].velocity, 3));
}

Sentence estimate_words(const char* name, const std::optional<double>& bias,
                        const std::optional<double>& spread) {
  constexpr double hardly = 0.01;
  const std::string off = !bias ? std::string("off by an unknown bias")
                          : std::abs(*bias) < hardly
                              ? std::string("off by less than 1 %")
                              : fmt::format("off by {:+.0f} %", 100.0 * *bias);
  const std::string wide =
      spread ? fmt::format("{} times the spread of the full fit", number(*spread, 2))
             : std::string("a spread that cannot be compared");
  return say("{} {} with {}", symbol(name), off, wide);
}

/// "0.021 (full fit: 0.018) at the other points of the series and ... at the other diameters"
std::string error_words(const HeldOut& two, const HeldOut& full) {
  std::string words;
  const auto add = [&](const std::optional<double>& mine, const std::optional<double>& all,
                       const char* where) {
    if (!mine || !all) return;
    words += fmt::format("{}{} {} (full fit: {})", words.empty() ? "" : " and ", number(*mine, 2),
                         where, number(*all, 2));
  };
  add(two.series, full.series, "at the other points of this diameter");
  add(two.diameters, full.diameters, "at the other diameters");
  return words;
}

Sentence paper_sentence(const Analysis& a, const PairStudy& study) {
  const PairQuality& pair = study.pairs[study.paper];
  const PairFigures figures = figures_of(study, pair);
  Sentence text = say("{}: in {} data sets simulated from the full fit, ",
                      a.datasets[study.dataset].id, study.simulations);
  const std::string no_answer = fmt::format("{:.0f} %", 100.0 * figures.without_answer);
  if (!pair.C_H.median) {
    return text +
           say("the paper's two points, {}, give no answer in {}.", velocities(a, pair), no_answer);
  }
  text += say("the paper's two points, {}, give {} and {}, and no answer in {}",
              velocities(a, pair), estimate_words("C_H", figures.bias_C_H, figures.spread_C_H),
              estimate_words("C_A", figures.bias_C_A, figures.spread_C_A), no_answer);
  const std::string error = error_words(pair.held_out, study.held_out);
  if (!error.empty()) {
    text += say("; their curve would miss a new measurement of {e} by {}", error);
  }
  return text + ".";
}

Sentence others_sentence(const Analysis& a, const PairStudy& study) {
  int often_without = 0;
  std::vector<double> spreads;
  std::vector<double> errors;
  const PairQuality* best = nullptr;
  for (const PairQuality& pair : study.pairs) {
    const PairFigures figures = figures_of(study, pair);
    if (figures.without_answer > most_without_answer) {
      ++often_without;
      continue;
    }
    if (!figures.spread_C_A) continue;
    spreads.push_back(*figures.spread_C_A);
    if (spreads.back() == *std::min_element(spreads.begin(), spreads.end())) best = &pair;
    if (pair.held_out.series) errors.push_back(*pair.held_out.series);
  }
  const std::size_t count = study.pairs.size();
  Sentence text = say(
      "Of the {} choice{} of two points whose velocities differ by at least half, {} leave{} more "
      "than a tenth of the data sets without an answer",
      count, count == 1 ? "" : "s", often_without, often_without == 1 ? "s" : "");
  if (best != nullptr) {
    const auto range = [](const std::vector<double>& values, int figures) {
      return fmt::format("{} to {}",
                         number(*std::min_element(values.begin(), values.end()), figures),
                         number(*std::max_element(values.begin(), values.end()), figures));
    };
    text +=
        say("; among the others {C_A} scatters {} times as much as in the full fit, least with {}",
            range(spreads, 2), velocities(a, *best));
    if (!errors.empty()) {
      text += fmt::format(", and a new measurement is missed by {}", range(errors, 2));
    }
  }
  if (study.taken < study.points) {
    text += fmt::format(" ({} of the {} points were tried)", study.taken, study.points);
  }
  return text + ".";
}

}  // namespace

PairFigures figures_of(const PairStudy& study, const PairQuality& pair) {
  return {relative_bias(pair.C_H, study.truth_C_H), relative_bias(pair.C_A, study.truth_C_A),
          relative_spread(pair.C_H, study.C_H), relative_spread(pair.C_A, study.C_A),
          pair.without_answer()};
}

std::optional<double> capture_of(const Analysis& analysis, const PairStudy& study) {
  for (const CaptureEstimate& capture : analysis.uncertainty.capture) {
    if (capture.dataset == study.dataset && capture.diameter == study.diameter && capture.found &&
        capture.value > 0.0) {
      return capture.value;
    }
  }
  return std::nullopt;
}

std::vector<Sentence> pair_words(const Analysis& analysis, const PairStudy& study) {
  if (study.pairs.empty()) return {};
  return {paper_sentence(analysis, study), others_sentence(analysis, study)};
}

}  // namespace recoil
