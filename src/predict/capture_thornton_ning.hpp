#pragma once

#include "predict/capture_contact.hpp"

namespace recoil {

/// Thornton, C. & Ning, Z. (1998), Powder Technology 99, 154-162: what sticks, of adhesive spheres
/// that are elastic, or elastic and perfectly plastic.

/// The elastic one in their numbers, V_s = 1.84 ((w / R)^5 / (rho^3 E*^2))^(1/6) [m/s]. It is
/// `jkr_capture_velocity` with its factor rounded to three digits.
double thornton_ning_elastic_velocity(const CaptureContact& contact);

/// The sticking velocity with yield [m/s], with adhesion at work throughout (their sections 4 and
/// 5): the pressure of the JKR contact, p(r) = (2 E* a / (pi R)) s - (2 w E* / (pi a))^(1/2) / s
/// with s = (1 - r^2 / a^2)^(1/2), is cut off at p_Y on loading; unloading follows JKR with the
/// flattened radius R_p = 4 E* a*^3 / (3 (F* + (8 pi w E* a*^3)^(1/2))). A sphere sticks below the
/// velocity whose work of loading leaves a contact that gives back just what its parting takes.
/// Where adhesion alone makes the contact yield it does so at touch. p_Y does not harden.
/// @return the JKR velocity where the sphere does not yield; 0 without adhesion; NaN where it would
/// have to be flattened altogether
double thornton_ning_plastic_velocity(const CaptureContact& contact, double yield_pressure);

}  // namespace recoil
