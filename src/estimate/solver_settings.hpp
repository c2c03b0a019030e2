#pragma once

#include <array>
#include <string_view>

#include "core/names.hpp"

namespace recoil {

/// Which integrator answers: the fast fixed-order one (which hands over to the reference by itself
/// outside the region where it is certified) or CVODES throughout.
enum class Solver { fast, reference };

template <>
struct NamesOf<Solver> {
  static constexpr std::array<std::string_view, 2> names = {"fast", "reference"};
};

/// How the impacts of a model are solved; nothing of it is physics.
struct SolverSettings {
  Solver kind = Solver::fast;
  double tolerance_factor = 1.0;  ///< the solver's tolerance is its own times this
};

}  // namespace recoil
