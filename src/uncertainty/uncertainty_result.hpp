#pragma once

#include <vector>

#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/curves.hpp"
#include "uncertainty/identifiability.hpp"
#include "uncertainty/interval_set.hpp"
#include "uncertainty/two_point_comparison.hpp"
#include "uncertainty/two_point_pairs.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// What `assess_uncertainty` finds.
struct UncertaintyResult {
  UncertaintyOptions options;
  std::vector<IntervalSet> intervals;  ///< [slots]
  BootstrapResult bootstrap;
  std::vector<CaptureEstimate> capture;
  std::vector<RestitutionCurve> curves;
  std::vector<TwoPointComparison> two_point;  ///< one per dataset, unless it was not asked for
  std::vector<PairStudy> pairs;  ///< one per dataset with a pair of points, unless not asked for
  Identifiability identifiability;
};

}  // namespace recoil
