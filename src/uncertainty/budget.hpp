#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "estimate/fit.hpp"
#include "uncertainty/capture_estimate.hpp"

namespace recoil {

/// One row of a budget.
struct BudgetEntry {
  /// "scatter", "spread" (uncertainty of the estimated scatter from impact to impact), "numerics"
  /// (the solver's tolerance), "laws" (`LawError`), or ErrorSource::names; empty for a constant.
  std::string_view source = {};
  std::string_view words = {};               ///< the same for a sentence
  std::optional<std::size_t> constant = {};  ///< index into ImpactModel::constants
  double sd = 0.0;     ///< standard deviation from this source alone, in the quantity's unit
  double share = 0.0;  ///< share of the variance [1]
  /// The shift of the quantity when the constant is one standard deviation lower and higher and the
  /// model is refitted; only for a share of at least 2 %.
  std::optional<double> lower = {}, upper = {};
};

/// The error budget of one quantity, by independent sources: the law of propagation of the GUM
/// (JCGM 100:2008, 5.1). With C the covariance of the fit, J its Jacobian and g the gradient of the
/// quantity, and s the noise scale, observation i contributes sd_i = |g'C J_i| / s, and the squares
/// add up to g'C g.
struct ErrorBudget {
  double value = 0.0;
  double sd = 0.0;                   ///< of all sources together
  std::vector<BudgetEntry> entries;  ///< the largest first; without sources whose part is 0
  /// Do the shifts by the constants agree with their sd within 25 % on both sides? If not, the
  /// shares show which sources are large but not how large they are.
  bool linear = true;
  /// The remaining error if the constant with the largest share were exact.
  std::optional<double> sd_without_first_constant;

  bool available() const { return sd > 0.0; }
};

/// The budgets of the slots [slots]: available for free slots and for an adhesion that changes with
/// the materials (f0 or W at the reference diameter).
std::vector<ErrorBudget> parameter_budgets(const FitResult& fitted);

/// The budgets of the capture velocities, in the order of `capture`.
std::vector<ErrorBudget> capture_budgets(const FitResult& fitted,
                                         const std::vector<CaptureEstimate>& capture);

}  // namespace recoil
