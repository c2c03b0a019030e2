#pragma once

#include <cstddef>
#include <vector>

#include "estimate/fit.hpp"

namespace recoil {

/// Where a start ended that may lead to the best fit.
struct StartLead {
  std::size_t start = 0;  ///< its place among the starts
  LeastSquaresResult run;
};

/// What the descents from several starts found.
struct StartSearch {
  std::vector<StartSummary> starts;
  std::size_t points = 0;  ///< that they saw
  bool sampled = false;    ///< these were drawn from very many
  /// The best of them, and where the points were sampled all that end elsewhere with a sum of
  /// squares that these points cannot tell from the smallest. None where no descent ended.
  std::vector<StartLead> leads;
  long handovers = 0;  ///< impacts that the fast solver left to the reference
};

/// Descends from `first` and, with `several`, from the places about it where other minima are
/// known to lie.
StartSearch search_from_starts(const ImpactModel& model, const Observations& data,
                               const std::vector<double>& first, bool several,
                               LeastSquaresOptions options);

}  // namespace recoil
