#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "validation/truth/truth.hpp"

namespace recoil::synthetic {

/// Ammonium fluorescein on molybdenum, without noise, from the simulator of the reconstructions
/// (which shares no code with the fitter).
struct Design {
  std::vector<double> diameters = {2.58e-6, 4.9e-6};
  std::vector<double> velocities = {2.5, 4.0, 6.5, 12.0, 25.0, 50.0, 90.0};
  double C_H = 3e-3;
  double C_A = 0.03;
  double f0 = 8.9;  // at 4.9 um
  double sd = 0.01;
};

/// What the other simulator is given for it.
inline Truth truth_of(const Design& design) {
  Truth truth;
  truth.density = 1350.0;
  truth.stiffness = 1.789e9;
  truth.adhesion_force = design.f0;
  truth.reference_diameter = 4.9e-6;
  truth.C_H = design.C_H;
  truth.C_A = design.C_A;
  return truth;
}

inline Dataset dataset(const Design& design) {
  Dataset data;
  data.id = "synthetic";
  data.provenance = Provenance::synthetic;
  data.system.particle = {"ammonium fluorescein", 1350.0, 1.2e9, 0.33, std::nullopt};
  data.system.surface = {"molybdenum", 0.0, 320e9, 0.31, std::nullopt};
  data.system.reference_diameter = 4.9e-6;
  data.system.stiffness_K = 1.789e9;
  data.system.adhesion_force_f0 = 8.9;
  const Truth truth = truth_of(design);
  for (std::size_t s = 0; s < design.diameters.size(); ++s) {
    data.series.push_back(std::to_string(s));
    for (const double v : design.velocities) {
      ImpactPoint point;
      point.series = s;
      point.diameter = design.diameters[s];
      point.incident_velocity = v;
      point.restitution = true_restitution(truth, point.diameter, v);
      if (point.restitution == 0.0) point.captured = 1;
      point.restitution_sd = design.sd;
      data.points.push_back(point);
    }
  }
  return data;
}

/// The catalogue's parameters with their defaults; f0 free when asked for.
inline FitSpec spec(bool f0_free = false) {
  FitSpec made;
  made.id = "synthetic";
  for (const Parameter& parameter : base_parameters()) {
    made.parameters.push_back(default_of(parameter));
  }
  made.parameters.back().free = f0_free;
  return made;
}

}  // namespace recoil::synthetic
