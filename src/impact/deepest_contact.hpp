#pragma once

#include "impact/impact.hpp"

namespace recoil {

/// The contact at the deepest point of an undamped impact, under jkr, dmt or maugis.
struct DeepestContact {
  struct Quantity {
    double value = 0.0;
    double by_beta = 0.0;   ///< derivative in the group beta
    double by_range = 0.0;  ///< in the group `range`
  };
  Quantity square;  ///< a^2 / (r n_c) [1]
  Quantity stored;  ///< elastic energy of the bodies, without that of the surfaces [m V^2]
};

/// @pre law is not the ring's
DeepestContact deepest_contact(AdhesionLaw law, double beta, double range);

}  // namespace recoil
