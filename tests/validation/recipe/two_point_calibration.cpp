#include "validation/recipe/two_point_calibration.hpp"

#include <cmath>

#include "core/numerics.hpp"

namespace recoil {
namespace {

constexpr double settled = 1e-6;  // relative change; points carry 1e-3 at best
constexpr int max_rounds = 50;

/// The damping `coefficient` of the model that gives `point`; negative when none >= 0 does.
double damping_for(RingAdhesionTruth model, double RingAdhesionTruth::*coefficient, double diameter,
                   const CalibrationPoint& point) {
  const auto excess = [&](double value) {
    model.*coefficient = value;
    return true_restitution(model, diameter, point.velocity) - point.restitution;
  };
  if (excess(0.0) < 0.0) return -1.0;
  double upper = 0.01;
  while (excess(upper) > 0.0) {
    upper *= 2.0;
    if (upper > 1000.0) return -1.0;
  }
  return find_root(excess, 0.0, upper, 1e-9);
}

}  // namespace

TwoPointCalibration calibrate_by_two_points(RingAdhesionTruth model, double diameter,
                                            const CalibrationPoint& low,
                                            const CalibrationPoint& high) {
  TwoPointCalibration result;
  model.C_H = 0.0;
  model.C_A = 0.0;
  for (int round = 0; round < max_rounds; ++round) {
    const double C_H = damping_for(model, &RingAdhesionTruth::C_H, diameter, high);
    if (C_H < 0.0) {
      result.why = "adhesion alone costs more than was lost at the highest velocity";
      return result;
    }
    model.C_H = C_H;
    const double before = model.C_A;
    const double C_A = damping_for(model, &RingAdhesionTruth::C_A, diameter, low);
    if (C_A < 0.0) {
      result.why = "no adhesion damping gives the restitution of the lowest velocity";
      return result;
    }
    model.C_A = C_A;
    if (std::abs(C_A - before) <= settled * C_A) {
      result.found = true;
      result.model = model;
      return result;
    }
  }
  result.why = "the iteration did not settle";
  return result;
}

}  // namespace recoil
