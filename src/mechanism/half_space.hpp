#pragma once

namespace recoil {

/// An elastic half-space that is pressed at a point by a force F(t), slow against the time that a
/// wave takes across the contact, radiates the power D F'(t)^2. This is D [m s / N]:
///   D = c(nu) / (2 pi mu c_T),   mu = E / (2 (1 + nu)),   c_T = sqrt(mu / rho),
/// with c the imaginary part of the compliance at the point (longitudinal, transverse and Rayleigh
/// waves; c(1/4) = 0.931). Miller, G. F. & Pursey, H. (1955), Proc. R. Soc. A 233, 55-69; used for
/// impacts by Hunter, S. C. (1957), J. Mech. Phys. Solids 5, 162-171.
double half_space_mobility(double youngs_modulus, double poisson_ratio, double density);

/// c(nu) of above, -1 < nu <= 0.5.
double half_space_radiation(double poisson_ratio);

}  // namespace recoil
