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
  std::optional<double> value;           ///< [m/s]; none where nothing or everything comes back
  std::optional<double> std_error = {};  ///< to first order [m/s]
};

/// The same fit under one law of adhesion.
struct LawFit {
  AdhesionLaw law = AdhesionLaw::ring;
  FitSpec spec;
  std::optional<FitResult> fitted;      ///< none where a mechanism of the fit refuses the law
  std::string refused;                  ///< by which, and why
  std::optional<double> held_out_rmse;  ///< of e, at the diameters that the fit has not seen [1]
  std::vector<LawCapture> captures;
};

/// `spec` with another law: the dampings as they are stated, W for f0 (and f0 for W) by equations 9
/// and 10 where a start or a fixed value is stated.
/// @param datasets those of the fit
FitSpec under_law(const FitSpec& spec, AdhesionLaw law, const std::vector<Dataset>& datasets);

/// The fit under its own law, and under the others that are fast to fit.
std::vector<LawFit> fit_under_every_law(const FitSpec& spec, const std::vector<Dataset>& datasets,
                                        const FitResult& own);

}  // namespace recoil
