#pragma once

#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/fit.hpp"
#include "estimate/fit_spec.hpp"

namespace recoil {

/// A law of loss of the dry contact, and how well it fits the points.
struct LossFit {
  std::string id;           ///< as `[model] loss` names it
  double delta_aicc = 0.0;  ///< AICc above that of the best law
};

/// A fit specification with a definite loss.
struct LossChoice {
  FitSpec spec;
  std::vector<LossFit> laws;  ///< the best first; empty if no choice was made
};

/// If `spec` leaves the loss to the points, fits every law and selects the smallest AICc (Burnham &
/// Anderson 2002, Model Selection and Multimodel Inference, section 2.4); among equal ones the
/// first of `dry_losses`. A law that cannot act, or that affects no point, is not a candidate. C_H
/// is kept if the noise is unknown, if the residuals have no likelihood, or if no law can be
/// fitted.
LossChoice choose_loss(const FitSpec& spec, const std::vector<Dataset>& datasets);

}  // namespace recoil
