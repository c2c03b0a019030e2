#pragma once

#include <string>
#include <vector>

#include "validation/synthetic/design.hpp"

namespace hidden {

/// A thick, polished block that somebody takes for a target.
struct OtherTarget {
  std::string material;  ///< empty: none
  double modulus = 0.0;  ///< Young's [Pa]
  double ratio = 0.0;    ///< Poisson's
  double density = 0.0;  ///< [kg/m3]
};

/// So many impacts of one size at one velocity.
struct Place {
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  int events = 0;
};

/// What is measured on another target, and what is true there.
struct Elsewhere {
  OtherTarget target;
  Base expected;  ///< adhesion and stiffness as the materials say, damping as on the first target
  Base base;      ///< true
  Effects effects;
  std::vector<Point> points;
  std::vector<double> readings;
};

/// Spread of what nobody knows beforehand of another target: standard deviations of the logarithms
/// of C_H and C_A, and of W_A, f0 going with W_A^(2/3). The latter is what two surface energies
/// miss that are estimated as Gilman (1960) does.
inline constexpr double log_sd_of_damping = 0.4;
inline constexpr double log_sd_of_work = 0.33;

/// The same spheres on `target`, whose adhesion and damping are drawn by `seed`; nothing is
/// measured yet. What acts in the spheres, in the gas and in the instrument stays; works of
/// adhesion go with W_A; a plate that bends and asperities that are crushed were those of the first
/// target.
Elsewhere move_to(const OtherTarget& target, const Base& base, const Effects& effects,
                  std::uint64_t seed);

}  // namespace hidden
