#pragma once

#include <optional>
#include <vector>

#include "estimate/fit.hpp"
#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/budget.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/curves.hpp"
#include "uncertainty/identifiability.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/parameter_intervals.hpp"
#include "uncertainty/posterior.hpp"
#include "uncertainty/two_point_comparison.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// All that is known about the errors of a fit.
struct UncertaintyResult {
  UncertaintyOptions options;
  std::vector<IntervalSet> intervals;  ///< [slots]
  BootstrapResult bootstrap;
  std::vector<CaptureEstimate> capture;
  std::vector<RestitutionCurve> curves;
  std::vector<TwoPointComparison> two_point;  ///< one per dataset, empty without adhesion
  Identifiability identifiability;
  std::optional<PosteriorResult> posterior;   ///< where it was asked for
  std::vector<ErrorBudget> budgets;           ///< [slots]
  std::vector<ErrorBudget> capture_budgets;   ///< in the order of `capture`
  std::optional<OddPoint> odd_point;          ///< without which the others fit
  std::optional<ConditionalFit> conditional;  ///< where constants are uncertain
};

}  // namespace recoil
