#pragma once

namespace recoil {

/// An adhesive elastic sphere that yields against an elastic wall, after Thornton & Ning (1998),
/// Powder Technol. 99, 154-162, doi 10.1016/S0032-5910(98)00099-0, with the adhesion of Johnson,
/// Kendall & Roberts (1971), Proc. R. Soc. A 324, 301-313, throughout.
///
/// With the contact radius a as the coordinate, E = E*, and w for the work of adhesion,
///   approach  alpha(a; R) = a^2 / R - sqrt(2 pi w a / E)                       [m]
///   force     P(a; R)     = 4 E a^3 / (3 R) - sqrt(8 pi w E a^3)               [N], > 0 repels.
/// Loading starts where the surfaces touch, alpha = 0, and follows R = r until the pressure in the
/// centre, 2 E a / (pi r) - sqrt(2 w E / (pi a)), reaches the yield pressure p_Y at a_Y; then
///   P = P_Y + pi p_Y (a^2 - a_Y^2)
/// on the same alpha(a; r). Without adhesion this is the straight line P_Y + pi p_Y r (alpha -
/// alpha_Y). Where adhesion alone yields a small sphere (a_Y inside the first contact), the line
/// holds from the first contact on (compare Maugis & Pollock 1984, Acta Metall. 32, 1323-1334).
/// Unloading is elastic from (a*, P*) with the flattened radius R_p that passes through that point,
///   1 / R_p = 3 (P* + sqrt(8 pi w E a*^3)) / (4 E a*^3),
/// down to where the contact tears at fixed grips, d alpha / d a = 0. What is lost in tearing grows
/// as R_p^(4/3), so that plastic flow makes adhesion stronger.
///
/// Every force is a sum of powers of a^(1/2), so the works are closed forms; the turning point
/// follows from m V^2 / 2 = work, solved to 1e-14, and e^2 = work recovered / (m V^2 / 2). No time
/// integration and no error but rounding (about 1e-12 in e^2, more within 1e-6 of capture).
///
/// Left out: elastic waves (below 0.2 % of the energy here), viscosity, rate effects of adhesion,
/// and the finite strain at contact radii above a third of the sphere's.
struct ElastoplasticContact {
  double reduced_modulus = 0.0;  ///< E* [Pa], 1/E* = sum (1 - nu^2) / E
  double radius = 0.0;           ///< r [m]
  double mass = 0.0;             ///< m [kg]
  double adhesion_energy = 0.0;  ///< w [J/m2], >= 0
  double yield_pressure = 0.0;   ///< p_Y [Pa]; infinity: never yields
};

struct ElastoplasticImpact {
  bool rebounded = false;
  double restitution = 0.0;          ///< e [1]; 0 when captured
  double restitution_squared = 0.0;  ///< recovered / incident energy [1]; negative when captured
  double contact_radius = 0.0;       ///< a* at the turning point [m]
  double unloading_radius = 0.0;     ///< R_p [m]; r when nothing yielded
  bool yielded = false;
};

/// One impact at `velocity` [m/s] > 0.
ElastoplasticImpact elastoplastic_impact(const ElastoplasticContact& contact, double velocity);

}  // namespace recoil
