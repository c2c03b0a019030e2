#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "mechanism/dual.hpp"

namespace recoil {

/// A rate and its derivative by the integrated quantity.
struct RateOfLoss {
  double value, slope;
};

/// The place s of a node. Each step has three.
inline double radau_place(int node, int steps) {
  const double root = std::sqrt(6.0);
  const double within = node % 3 == 0   ? 0.1 * (4.0 - root)
                        : node % 3 == 1 ? 0.1 * (4.0 + root)
                                        : 1.0;
  const int step = node / 3;
  return (step + within) / steps;
}

/// y(1) of dy/ds = rate(s, y), y(0) = 0, by Radau IIA of order 5 (Hairer & Wanner 1996, Solving
/// Ordinary Differential Equations II, table 5.6) in equal steps. The method is L-stable, because
/// strong losses make the problem stiff.
/// @param rate (node, y) -> RateOfLoss, at s = radau_place(node, steps)
/// @param sloped (node, y) -> T, the rate with its slopes at a fixed y; not called if T is double
template <class T, int steps, class Rate, class Sloped>
T integrate_loss(const Rate& rate, const Sloped& sloped) {
  using Stages = Eigen::Vector3d;
  const double root = std::sqrt(6.0);
  Eigen::Matrix3d couplings;
  couplings << (88.0 - 7.0 * root) / 360.0, (296.0 - 169.0 * root) / 1800.0,
      (-2.0 + 3.0 * root) / 225.0,  //
      (296.0 + 169.0 * root) / 1800.0, (88.0 + 7.0 * root) / 360.0,
      (-2.0 - 3.0 * root) / 225.0,  //
      (16.0 - root) / 36.0, (16.0 + root) / 36.0, 1.0 / 9.0;
  couplings /= steps;
  T lost(0.0);
  double last_rate = 0.0;
  for (int step = 0; step < steps; ++step) {
    Stages slopes;
    const auto miss_at = [&](const Stages& trial) {
      Stages rates;
      for (int j = 0; j < 3; ++j) {
        const RateOfLoss found = rate(3 * step + j, trial(j));
        rates(j) = found.value;
        slopes(j) = found.slope;
      }
      last_rate = rates(2);
      return Stages(trial - Stages::Constant(value_of(lost)) - couplings * rates);
    };
    // Starts with the last rate.
    Stages at;
    for (int j = 0; j < 3; ++j) at(j) = value_of(lost) + radau_place(j, steps) * last_rate;
    Stages miss = miss_at(at);
    Eigen::Matrix3d inverse;
    bool done = false;
    for (int newton = 0; newton < 40 && !done; ++newton) {
      inverse = (Eigen::Matrix3d::Identity() - couplings * slopes.asDiagonal()).inverse();
      Stages change = inverse * miss;
      // The next one is of the order of its square, over the 1e-4 on which the rates are smooth.
      done = change.cwiseAbs().maxCoeff() < 1e-8;
      // Halves the step while the error grows.
      Stages next = miss_at(at - change);
      for (int half = 0; half < 12 && !done && !(next.squaredNorm() < miss.squaredNorm()); ++half) {
        change *= 0.5;
        next = miss_at(at - change);
      }
      at -= change;
      miss = next;
    }
    T next(at(2));
    if constexpr (!std::is_same_v<T, double>) {
      inverse = (Eigen::Matrix3d::Identity() - couplings * slopes.asDiagonal()).inverse();
      add_slopes(next, inverse.row(2).sum(), lost);
      const Eigen::RowVector3d counted = inverse.row(2) * couplings;
      for (int j = 0; j < 3; ++j) add_slopes(next, counted(j), sloped(3 * step + j, at(j)));
    }
    lost = next;
  }
  return lost;
}

}  // namespace recoil
