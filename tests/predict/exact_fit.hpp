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
    return true_restitution(synthetic::truth_of(design), diameter, velocity);
  }
};

}  // namespace recoil
