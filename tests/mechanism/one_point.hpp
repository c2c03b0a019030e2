#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "impact/impact.hpp"
#include "mechanism/extended_impacts.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil::one_point {

/// Ammonium fluorescein on molybdenum, as in the README's table.
inline ImpactSystem fluorescein() {
  ImpactSystem system;
  system.particle = {"ammonium fluorescein", 1350.0, 1.2e9, 0.33, {}};
  system.surface = {"molybdenum", 10200.0, 320e9, 0.31, {}};
  system.adhesion_force_f0 = 8.9;
  system.reference_diameter = 4.9e-6;
  return system;
}

/// 316 stainless steel on steel.
inline ImpactSystem steel() {
  ImpactSystem system;
  system.particle = {"steel", 7900.0, 193e9, 0.25, {}};
  system.surface = {"steel", 7900.0, 193e9, 0.25, {}};
  system.adhesion_force_f0 = 300.0;
  system.reference_diameter = 49e-6;
  return system;
}

inline Surroundings around(const ImpactSystem& system) {
  return surroundings_of(system, derive_contact(system, *system.reference_diameter));
}

inline const Surroundings kSoft = around(fluorescein());
constexpr double kDiameter = 4.9e-6;
/// W_A of these two by Gilman's estimate: 2 sqrt(E1 E2) (1.3e-10 m / pi)^2 / 2e-10 m [J/m2].
constexpr double kSoftWork = 0.33554639048;

/// C_H, C_A and f0 of the base model.
struct Base {
  double C_H = 0.0, C_A = 0.0, f0 = 0.0;
};
constexpr Base kBase{3e-3, 0.05, 8.9};

/// e^2 and its derivatives in V, D, C_H, C_A, f0 and the mechanisms' parameters.
struct Answer {
  bool usable = false;
  double square = 0.0;
  std::vector<double> slopes;
  long handed_over = 0;  ///< impacts that the reference solver solved
};

inline Answer ask(const Surroundings& at, const std::vector<std::string>& ids,
                  const std::vector<double>& own, double diameter, double velocity,
                  const Base& base = {}, bool gradient = true) {
  ExtendedImpacts impacts(chain_of(ids), {{&at, diameter, velocity}});
  std::vector<double> values = {base.C_H, base.C_A, base.f0};
  values.insert(values.end(), own.begin(), own.end());
  if (values.size() != impacts.value_count())
    throw std::invalid_argument("values of the mechanisms");
  ImpactOptions options;
  options.adhesion = at.adhesion;
  options.phase = at.phase;
  options.gradient = gradient;
  Answer answer;
  answer.handed_over = impacts.evaluate(values, options, simulate_impacts_fast);
  const ImpactOutcome outcome = impacts.at(0).outcome;
  answer.usable = outcome == ImpactOutcome::rebound || outcome == ImpactOutcome::captured;
  answer.square = impacts.at(0).restitution_squared;
  if (gradient) answer.slopes.assign(impacts.slopes(0).begin(), impacts.slopes(0).end());
  return answer;
}

/// e^2 alone, without derivatives.
inline double square(const Surroundings& at, const std::vector<std::string>& ids,
                     const std::vector<double>& own, double diameter, double velocity,
                     const Base& base = {}) {
  return ask(at, ids, own, diameter, velocity, base, false).square;
}

/// e of the Hunt-Crossley contact at x = C_H V, by bisection.
inline double hunt_crossley(double x) {
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 200; ++i) {
    const double e = 0.5 * (low + high);
    (x * (1.0 + e) < std::log1p(x) - std::log1p(-e * x) ? high : low) = e;
  }
  return 0.5 * (low + high);
}

}  // namespace recoil::one_point
