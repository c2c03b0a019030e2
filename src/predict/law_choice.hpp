#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/fit.hpp"
#include "estimate/fit_spec.hpp"

namespace recoil {

/// V* of one diameter under one law.
struct LawCapture {
  std::size_t dataset = 0;
  double diameter = 0.0;                 ///< [m]
  std::optional<double> value;           ///< [m/s]; nullopt if all or no spheres rebound
  std::optional<double> std_error = {};  ///< standard error to first order [m/s]
};

/// The same fit under one law of adhesion.
struct LawFit {
  AdhesionLaw law = AdhesionLaw::ring;
  FitSpec spec;
  std::optional<FitResult> fitted;      ///< nullopt if a mechanism of the fit refuses the law
  std::string refused;                  ///< the mechanism that refuses the law, and why
  std::optional<double> held_out_rmse;  ///< root mean square error of e at held-out diameters [1]
  std::vector<LawCapture> captures;
};

/// `spec` with another law: the dampings as stated, and W instead of f0 (or f0 instead of W),
/// converted by equations 9 and 10 if a start or a fixed value is stated.
/// @param datasets the datasets of the fit
FitSpec under_law(const FitSpec& spec, AdhesionLaw law, const std::vector<Dataset>& datasets);

/// The fit under its own law, and under the other laws that are fast to fit.
std::vector<LawFit> fit_under_every_law(const FitSpec& spec, const std::vector<Dataset>& datasets,
                                        const FitResult& own);

}  // namespace recoil
