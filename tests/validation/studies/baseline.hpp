#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "estimate/fit.hpp"
#include "validation/synthetic/case.hpp"

namespace recoil::hidden {

/// What two plain methods say of a case, without the rules of a diagnosis.
struct BaselineAnswers {
  /// Forward selection by AICc (Burnham & Anderson 2002, section 6.9): of the catalogue, the
  /// mechanism whose addition lowers AICc most is added, and once more; empty: none lowers it.
  std::vector<std::string> stepwise;
  /// The discrepancy of the base model as a Gaussian process (Kennedy & O'Hagan 2001): the
  /// mechanism whose effect on e correlates most with it on the points; empty: there is no
  /// discrepancy.
  std::string correlated;
  RECOIL_FIELDS(stepwise, correlated)
};

/// The written case `fit`, fitted with `mechanisms`; not usable where the data cannot have them.
FitResult fit_with(const std::filesystem::path& fit, const std::vector<std::string>& mechanisms,
                   const std::vector<std::string>& freed = {});

/// Fits the base model, every mechanism, and every second one beside the best, all under the
/// weights of the base model and from the fit with one mechanism less.
BaselineAnswers baseline_answers(const Case& made);

/// The sd of a Gaussian process f with covariance s^2 exp(-|x - x'|^2 / 2) that makes residuals
/// r = f(x) + noise of unit variance most likely, x = (ln V, ln d), on a grid of s from 0.1 to 100;
/// 0 where 2 ln of the likelihood rises by no more than 2, the cost of a parameter in AIC.
/// @returns the mean of f at the points given r; empty where s is 0
std::vector<double> discrepancy_mean(const std::vector<double>& log_velocity,
                                     const std::vector<double>& log_diameter,
                                     const std::vector<double>& residuals);

}  // namespace recoil::hidden
