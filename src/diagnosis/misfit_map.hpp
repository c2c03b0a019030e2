#pragma once

#include <vector>

#include "estimate/fit.hpp"

namespace recoil {

/// Where the fitted base model misses: one diameter, one band of velocities.
struct MisfitCell {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double slowest = 0.0;   ///< incident velocity [m/s]
  double fastest = 0.0;   ///< [m/s]
  int points = 0;
  double restitution = 0.0;   ///< mean of e - e_model [1]: positive where the model is too low
  double energy = 0.0;        ///< mean of m V^2 / 2 (e^2 - e_model^2) [J]
  double standardised = 0.0;  ///< mean of e - e_model over its standard error [1]
};

/// Every diameter of every dataset in four bands of equal width in ln V; empty bands are left out.
std::vector<MisfitCell> misfit_map(const FitResult& fitted);

}  // namespace recoil
