#pragma once

#include <optional>
#include <vector>

#include "report/report.hpp"

namespace recoil {

/// What is shown of one pair of points, beside the full fit on the same simulated data.
struct PairFigures {
  std::optional<double> bias_C_H, bias_C_A;      ///< median over the full fit's value, less one [1]
  std::optional<double> spread_C_H, spread_C_A;  ///< over the full fit's [1]
  double without_answer = 0.0;                   ///< share of the simulated data sets [1]
};

/// Nothing where the full fit's value or spread is zero.
PairFigures figures_of(const PairStudy& study, const PairQuality& pair);

/// The capture velocity [m/s] of the diameter that the study calibrates; nothing when unknown.
std::optional<double> capture_of(const Analysis& analysis, const PairStudy& study);

/// Two sentences: what the paper's pair costs, and what the choice of another would.
std::vector<Sentence> pair_words(const Analysis& analysis, const PairStudy& study);

}  // namespace recoil
