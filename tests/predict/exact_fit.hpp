#pragma once

#include <vector>

#include "estimate/observations.hpp"
#include "estimate/predictor.hpp"
#include "support/synthetic.hpp"
#include "uncertainty/bootstrap_result.hpp"

namespace recoil {

/// A fit that is exact: the synthetic truth with its own parameters.
struct ExactFit {
  synthetic::Design design;
  std::vector<Dataset> datasets{synthetic::dataset(design)};
  Observations data = gather(datasets);
  FitResult fitted;
  BootstrapResult bootstrap;

  ExactFit() {
    fitted.model = make_model(synthetic::spec(), datasets);
    fitted.theta = {design.C_H, design.C_A, design.f0};
    fitted.usable = true;
    fitted.data = data;
  }

  /// e of the other simulator [1].
  double truth(double diameter, double velocity) const {
    RingAdhesionTruth ring;
    ring.density = 1350.0;
    ring.stiffness = 1.789e9;
    ring.adhesion_force = design.f0;
    ring.reference_diameter = 4.9e-6;
    ring.C_H = design.C_H;
    ring.C_A = design.C_A;
    return true_restitution(ring, diameter, velocity);
  }
};

}  // namespace recoil
