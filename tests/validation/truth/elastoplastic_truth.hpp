#pragma once

namespace recoil {

/// An adhesive sphere that yields against an elastic wall: the energy balance of Thornton & Ning
/// (1998), Powder Technol. 99, 154-162, with the adhesion of Johnson, Kendall & Roberts (1971),
/// Proc. R. Soc. A 324, 301-313, at work throughout. With E = E*, and the contact radius a as the
/// coordinate:
///
/// Loading follows alpha = a^2 / r - (2 pi w a / E)^(1/2) from alpha = 0 on. The pressure
///   p(rho) = (2 E a / (pi r)) s - (2 w E / (pi a))^(1/2) / s,  s = (1 - rho^2 / a^2)^(1/2),
/// is nowhere above the yield pressure p_Y; the force P is its integral. The turning point
/// (a*, P*) is where the work of P along alpha equals m V^2 / 2. Unloading is JKR with the
/// flattened radius
///   R_p = 4 E a*^3 / (3 (P* + (8 pi w E a*^3)^(1/2))),
/// gives back U(a*) - U(a_0) at alpha = 0, with U = (8/15) E a^5 / R_p^2 - (4/3) (2 pi w E)^(1/2)
/// a^(7/2) / R_p + pi w a^2 and a_0^3 = 2 pi w R_p^2 / E, and takes from there
///   7.0922 (w^5 R_p^4 / E^2)^(1/3) + dw pi a*^2 :
/// what a JKR contact of radius R_p costs to pull apart, so that flattening makes adhesion stronger
/// (Thornton & Ning; Johnson & Pollock 1994, J. Adhes. Sci. Technol. 8, 1323), and what the contact
/// area costs because parting takes dw more work than meeting gave (adhesion hysteresis). e^2 =
/// what is left over m V^2 / 2; below zero the sphere stays.
///
/// Limits that are exact: no adhesion (Thornton & Ning's closed form of e), no yield and dw = 0
/// (e^2 = 1 - (V_s / V)^2 with the JKR V_s). For ammonium fluorescein of 4.9 um on silicon (w = 0.2
/// J/m2, p_Y = 35.3 MPa) V* = 1.46 m/s. What the pressure lacks of JKR's is integrated by
/// Gauss's rule, good to 1e-11; the rest are closed forms.
///
/// Left out: elastic waves (below 0.2 % of the energy here), viscosity of the bulk, and the finite
/// strain at contact radii above a third of the sphere's.
struct ElastoplasticContact {
  double reduced_modulus = 0.0;  ///< E* [Pa], 1/E* = sum (1 - nu^2) / E
  double radius = 0.0;           ///< r [m]
  double mass = 0.0;             ///< m [kg]
  double adhesion_energy = 0.0;  ///< w [J/m2], >= 0
  double hysteresis = 0.0;       ///< dw [J/m2], >= 0
  double yield_pressure = 0.0;   ///< p_Y [Pa]; infinity: never yields
};

struct ElastoplasticImpact {
  bool rebounded = false;
  double restitution = 0.0;          ///< e [1]; 0 when captured
  double restitution_squared = 0.0;  ///< e^2 [1]; negative when captured
  double contact_radius = 0.0;       ///< a* [m]
  double unloading_radius = 0.0;     ///< R_p [m]; r when nothing yielded
  double plastic_share = 0.0;        ///< part of the incident energy that is gone at alpha = 0 [1]
};

/// Work that a JKR contact takes between its making at zero approach and its tear at fixed grips
/// [J]: 7.0922 (w^5 R^4 / E^2)^(1/3).
double jkr_parting_work(double adhesion_energy, double radius, double reduced_modulus);

/// One impact at `velocity` [m/s] > 0.
/// @throws ComputationError where nothing stops the sphere: for a size, say, that is none.
ElastoplasticImpact elastoplastic_impact(const ElastoplasticContact& contact, double velocity);

}  // namespace recoil
