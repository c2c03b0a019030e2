#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "impact/contact.hpp"
#include "impact/impact.hpp"

namespace recoil {

/// Which integrator answers: the fast fixed-order one (which hands over to the reference by itself
/// outside the region where it is certified) or CVODES throughout.
enum class Solver { fast, reference };

/// One entry of the parameter vector theta.
struct ParameterSlot {
  std::string name;     ///< of the catalogue: "C_H"
  std::string unit;     ///< [s/m], [N/m]
  std::string dataset;  ///< id when the parameter is `per = "dataset"`, else empty
  double initial = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  bool free = true;
  bool log_scale = false;

  /// "C_A" or "C_A[wall1990-mica]".
  std::string label() const;
};

/// The model applied to the datasets of one fit: what the parameters are and how they enter.
struct ImpactModel {
  AdhesionDampingPhase phase = AdhesionDampingPhase::rebound;
  Solver solver = Solver::fast;
  std::vector<ParameterSlot> slots;
  std::vector<ContactProperties> contacts;               ///< per dataset
  std::vector<std::size_t> slot_C_H, slot_C_A, slot_f0;  ///< per dataset: index into `slots`

  std::vector<double> initial() const;
};

/// Lays out theta for `spec`. f0 that is not free, or has no stated start, takes the value of eq.
/// 12 for its dataset.
ImpactModel make_model(const FitSpec& spec, const std::vector<Dataset>& datasets);

/// A model's answer for one (diameter, velocity).
struct Prediction {
  ImpactOutcome outcome = ImpactOutcome::integration_failure;
  double restitution_squared = 0.0;  ///< continued below zero for a capture, see ImpactResult
  std::vector<double> gradient;      ///< d e^2 / d theta, one per slot; empty unless asked for

  bool usable() const {
    return outcome == ImpactOutcome::rebound || outcome == ImpactOutcome::captured;
  }
  /// e [1]: 0 when captured.
  double restitution() const;
};

/// SI conditions of an impact under `theta`. @pre theta.size() == model.slots.size()
ImpactConditions conditions_at(const ImpactModel& model, std::span<const double> theta,
                               std::size_t dataset, double diameter, double velocity);

/// Simulates one impact under `theta`.
Prediction predict(const ImpactModel& model, std::span<const double> theta, std::size_t dataset,
                   double diameter, double velocity, bool gradient);

/// A velocity below which spheres are captured, with its gradient.
struct CaptureVelocity {
  bool found = false;
  double value = 0.0;            ///< V* [m/s]; 0 without adhesion (nothing is captured)
  std::vector<double> gradient;  ///< d V* / d theta
};

/// Solves e^2(V) = 0 for the largest V at which capture turns into rebound.
/// @param guess [m/s] where to look first; 0 uses the law for small damping.
CaptureVelocity capture_velocity(const ImpactModel& model, std::span<const double> theta,
                                 std::size_t dataset, double diameter, double guess = 0.0);

}  // namespace recoil
