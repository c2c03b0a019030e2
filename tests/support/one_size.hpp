#pragma once

#include <cmath>

#include "estimate/fit.hpp"
#include "support/synthetic.hpp"

namespace recoil::one_size {

inline constexpr double diameter = 4.9e-6;

inline Truth truth() {
  Truth truth;
  truth.density = 1350.0;
  truth.stiffness = 1.789e9;
  truth.adhesion_force = 8.9;
  truth.reference_diameter = diameter;
  truth.C_H = 3e-3;
  truth.C_A = 0.03;
  return truth;
}

/// `count` velocities from 1.15 to 57 times the capture velocity, without noise or stated sd.
inline Dataset design(int count) {
  const double capture = true_capture_velocity(truth(), diameter);
  synthetic::Design design;
  design.diameters = {diameter};
  design.velocities.clear();
  for (int i = 0; i < count; ++i) {
    design.velocities.push_back(1.15 * capture * std::pow(50.0, i / (count - 1.0)));
  }
  Dataset data = synthetic::dataset(design);
  for (ImpactPoint& point : data.points) point.restitution_sd.reset();
  return data;
}

inline FitResult fit_to(const Dataset& data, const NoiseSpec& spec = {}) {
  FitOptions options;
  options.several_starts = false;
  const std::vector<Dataset> datasets = {data};
  return fit(make_model(synthetic::spec(), datasets), gather(datasets, spec), options);
}

}  // namespace recoil::one_size
