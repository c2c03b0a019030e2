#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/capture_estimate.hpp"

namespace recoil {

/// From what an error comes.
enum class BudgetSource {
  scatter,   ///< of the points, the errors of V and d apart
  velocity,  ///< stated errors of V, independent from point to point
  diameter,  ///< stated errors of d, independent from point to point
  spread,    ///< that the scatter from impact to impact is estimated
  constant,  ///< a constant of the materials
  numerics,  ///< the solver's tolerance
};
template <>
struct NamesOf<BudgetSource> {
  static constexpr std::array<std::string_view, 6> names = {"scatter", "velocity", "diameter",
                                                            "spread",  "constant", "numerics"};
};

/// One row of a budget.
struct BudgetEntry {
  BudgetSource source = BudgetSource::scatter;
  std::size_t constant = 0;  ///< of ImpactModel::constants, where the source is one
  double sd = 0.0;           ///< what it alone makes of the error, in the quantity's unit
  double share = 0.0;        ///< of the variance [1]
  /// By how much the quantity moves when the constant is stated one standard deviation lower and
  /// higher and everything is fitted again; only where its share is worth it.
  std::optional<double> lower, upper;
};

/// The error of one quantity by its sources, which are independent: the law of propagation of the
/// GUM (JCGM 100:2008, 5.1). With C the covariance of the fit, J its Jacobian and g the gradient of
/// the quantity, observation i has the part sd_i = |g'C J_i| / s, and the sum of the squares is
/// g'C g.
struct ErrorBudget {
  double value = 0.0;
  double sd = 0.0;                   ///< of all together
  std::vector<BudgetEntry> entries;  ///< the largest first; without those that are exactly 0
  /// Do the moves by the constants that count agree with their sd, within a quarter, to both sides?
  /// If not, the shares say what is large but not how large.
  bool linear = true;
  /// The error that would be left if the constant with the largest share were known exactly.
  std::optional<double> sd_without_first_constant;

  bool available() const { return sd > 0.0; }
};

/// The budgets of all slots: of those that are free, and of an adhesion that follows the materials
/// (f0 or W at the reference diameter); others are not available.
std::vector<ErrorBudget> parameter_budgets(const FitResult& fitted);

/// Those of the capture velocities, in their order.
std::vector<ErrorBudget> capture_budgets(const FitResult& fitted,
                                         const std::vector<CaptureEstimate>& capture);

}  // namespace recoil
