#pragma once

#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/fit.hpp"
#include "estimate/fit_spec.hpp"

namespace recoil {

/// One law of loss of the dry contact, as the points have it.
struct LossFit {
  std::string id;           ///< as `[model] loss` names it
  double delta_aicc = 0.0;  ///< AICc above that of the best law
};

/// -2 ln likelihood of the points at the fit, but for a constant that all fits to them share: the
/// sum of squared residuals r, and -2 sum ln |dr / de| for their unit, which the weights set.
double minus_two_log_likelihood(const FitResult& fitted);

/// A fit whose loss is decided.
struct LossChoice {
  FitSpec spec;
  std::vector<LossFit> laws;  ///< the best first; empty where nothing was to be chosen
};

/// Where `spec` leaves the loss to the points, fits every law and takes the one with the smallest
/// AICc (Burnham & Anderson 2002, Model Selection and Multimodel Inference, section 2.4); of equal
/// ones the first of `dry_losses`. A law that cannot act, or to which no point is sensitive, is no
/// candidate. Where the noise is unknown, or no law has a fit, C_H stays.
LossChoice choose_loss(const FitSpec& spec, const std::vector<Dataset>& datasets);

}  // namespace recoil
