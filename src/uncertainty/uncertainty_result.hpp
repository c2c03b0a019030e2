#pragma once

#include <optional>
#include <vector>

#include "estimate/fit.hpp"
#include "estimate/odd_point.hpp"
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

/// The uncertainty of a fit.
struct UncertaintyResult {
  UncertaintyOptions options;
  std::vector<IntervalSet> intervals;  ///< [slots]
  BootstrapResult bootstrap;
  std::vector<CaptureEstimate> capture;
  std::vector<RestitutionCurve> curves;
  std::vector<TwoPointComparison> two_point;  ///< one per dataset, empty without adhesion
  Identifiability identifiability;
  std::optional<PosteriorResult> posterior;   ///< if requested
  std::vector<ErrorBudget> budgets;           ///< [slots]
  std::vector<ErrorBudget> capture_budgets;   ///< in the order of `capture`
  std::optional<OddPoint> odd_point;          ///< a point without which the model fits the others
  std::optional<ConditionalFit> conditional;  ///< with exact constants; nullopt if all are exact
};

}  // namespace recoil
