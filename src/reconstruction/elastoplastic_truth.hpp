#pragma once

namespace recoil {

/// An adhesive sphere that yields against an elastic wall: the energy balance of Thornton & Ning
/// (1998), Powder Technol. 99, 154-162, with the adhesion of Johnson, Kendall & Roberts (1971),
/// Proc. R. Soc. A 324, 301-313. With E = E*, and the contact radius a as the coordinate:
///
/// Loading is Hertzian, P = 4 E a^3 / (3 r), alpha = a^2 / r, up to a_Y = pi r p_Y / (2 E), where
/// the pressure in the centre reaches the yield pressure p_Y; from there on
///   P = P_Y + pi p_Y (a^2 - a_Y^2),
/// which is the straight line P_Y + pi p_Y r (alpha - alpha_Y). The turning point (a*, P*) is where
/// the work done equals m V^2 / 2. Unloading is Hertzian with the flattened radius
///   R_p = 4 E a*^3 / (3 P*),   and gives back   8 E a*^5 / (15 R_p^2).
/// Adhesion takes from this
///   7.0922 (w^5 R_p^4 / E^2)^(1/3) + dw pi a*^2 :
/// what a JKR contact of radius R_p costs to pull apart from alpha = 0, so that flattening makes
/// adhesion stronger (Thornton & Ning; Johnson & Pollock 1994, J. Adhes. Sci. Technol. 8, 1323),
/// and what the contact area costs because parting takes dw more work than meeting gave (adhesion
/// hysteresis). e^2 = (recovered - taken) / (m V^2 / 2); below zero the sphere stays.
///
/// Limits that are exact: no adhesion (Thornton & Ning's closed form of e), no yield and dw = 0
/// (e^2 = 1 - (V_s / V)^2 with the JKR V_s). Between them the balance neglects that adhesion
/// deepens the contact and lowers the load at which it yields; for ammonium fluorescein of 4.9 um
/// on silicon (w = 0.2 J/m2, p_Y = 35.3 MPa) it gives V* = 0.96 m/s. All terms are closed forms:
/// the only numerical error is rounding.
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
  double plastic_share = 0.0;        ///< part of the incident energy that goes into flow [1]
};

/// One impact at `velocity` [m/s] > 0.
ElastoplasticImpact elastoplastic_impact(const ElastoplasticContact& contact, double velocity);

}  // namespace recoil
