#pragma once

#include "predict/capture_contact.hpp"

namespace recoil {

/// Thornton, C. & Ning, Z. (1998), Powder Technology 99, 154-162: what sticks, of adhesive spheres
/// that are elastic, or elastic and perfectly plastic.

/// The elastic one in their numbers, V_s = 1.84 ((w / R)^5 / (rho^3 E*^2))^(1/6) [m/s]. It is
/// `jkr_capture_velocity` with its factor rounded to three digits.
double thornton_ning_elastic_velocity(const CaptureContact& contact);

/// The velocity at which a sphere begins to yield at the contact pressure p_Y [Pa]:
/// V_Y = (pi^2 / (2 sqrt(10))) (p_Y^5 / (E*^4 rho))^(1/2) = 1.56 (...)^(1/2) [m/s].
double yield_velocity(const CaptureContact& contact, double yield_pressure);

/// Restitution of the elastic, perfectly plastic sphere without adhesion [1]; 1 up to V_Y, above it
/// e = (6 sqrt(3) / 5)^(1/2) (1 - v^2/6)^(1/2) (v / (v + 2 sqrt((6 - v^2) / 5)))^(1/4), v = V_Y /
/// V.
double plastic_restitution(double velocity, double yield_velocity);

/// The sticking velocity with yield [m/s]: where what the yielded sphere gets back,
/// e(V)^2 m V^2 / 2, equals the JKR loss of a contact whose radius of curvature has grown by the
/// flattening to
///   R_p = (4 E* / (3 F)) ((2 F + F_Y) / (2 pi p_Y))^(3/2),
/// F being the largest force, F^2 = F_Y^2 + pi p_Y R m (V^2 - V_Y^2), and F_Y = pi^3 R^2 p_Y^3 /
/// (6 E*^2). That adhesion lets the sphere yield earlier is left out, so this is a lower estimate:
/// for ammonium fluorescein of 4.9 um on silicon (w = 0.2 J/m2, p_Y = 35.3 MPa) it gives 0.96 m/s
/// where a full simulation is quoted with 1.6 m/s (Pasha et al. 2014, doi
/// 10.1007/s10035-013-0476-y).
/// @return the JKR velocity where the sphere does not yield at it
double thornton_ning_plastic_velocity(const CaptureContact& contact, double yield_pressure);

}  // namespace recoil
