#pragma once

#include <vector>

#include "impact/impact.hpp"

namespace recoil {

/// Integrates one impact from touch to release or to the first outer turning point.
///
/// Reference solver: SUNDIALS CVODES (Adams, variable order) with forward sensitivities, on the
/// field made polynomial by q = sqrt(x), dt = 2 q dsigma:
///   dq/dsigma = u,   du/dsigma = 2 q^2 [beta (1 + gamma S) - q^2 (1 + alpha u)].
/// The square roots of the force law make the right-hand side in (x, t) only Hoelder-1/2 at touch
/// and release; in (q, sigma) the release is a transversal crossing of q = 0.
/// @param history when not null, receives every step of the integrator.
ImpactResult simulate_impact(const ImpactGroups& groups, const ImpactOptions& options = {},
                             std::vector<ImpactMoment>* history = nullptr);

}  // namespace recoil
