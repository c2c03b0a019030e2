#pragma once

#include <cstddef>
#include <vector>

#include "core/names.hpp"
#include "estimate/fit.hpp"

namespace recoil {

/// A quantity that must be small, or large, for the equations of an impact to be valid.
enum class ValidityQuantity {
  /// a_max / R, with a of the adhesion law, or of the yielded contact. Hertz' theory assumes small
  /// strains and a paraboloid: limit 0.3.
  contact_radius,
  /// p_0 / E*, with p_0 the largest pressure of the contact: 2 E* a_max / (pi R) for a^2 = R n, or
  /// the yield pressure if it yields. No solid resists a shear stress above about a tenth of its
  /// modulus (Frenkel 1926, Z. Phys. 37, 572-609), and a contact flows at 2.8 times the yield
  /// stress (Tabor 1951, The Hardness of Metals): limit 0.3.
  pressure_modulus,
  /// p_0 over the pressure at which the weaker of the two bodies begins to yield, 1.6 Y (Johnson
  /// 1985, section 6.1). Y is 1 / 2.8 of `Material::yield_pressure`, or, as an estimate, of 0.03 E
  /// if no strength is stated (ammonium fluorescein has 35.3 MPa for E = 1.2 GPa, polystyrene about
  /// 100 MPa for 2.56 GPa, metals a third of this ratio or less). Omitted if a mechanism of the fit
  /// lets the contact yield. Limit 1.
  pressure_yield,
  /// mu = (R W^2 / (E*^2 z_0^3))^(1/3), z_0 = 0.4 nm, with W from f0 by eq. 12 (Tabor 1977).
  /// Adhesion acts inside the contact (JKR) above about 5 and around it (DMT) below 0.1 (Johnson &
  /// Greenwood 1997, J. Colloid Interface Sci. 192, 326-333). The base model has the JKR
  /// equilibrium: at least 5.
  tabor,
  /// t_c c / d, with c = (E / rho)^(1/2) of the sphere: the number of times a wave crosses the
  /// sphere during contact. The period of its slowest vibration is about 1.9 crossings (Lamb 1882,
  /// nu = 0.3); a quasi-static contact lasts several periods: at least 5.
  wave_transits,
};

constexpr auto names_of_values(ValidityQuantity) {
  return name_list("contact_radius_over_sphere_radius", "peak_pressure_over_modulus",
                   "peak_pressure_over_yield_pressure", "tabor_parameter",
                   "contact_time_over_wave_transit");
}

/// One quantity at one impact, with the limit of the equations.
struct Validity {
  ValidityQuantity quantity = ValidityQuantity::contact_radius;
  double value = 0.0;  ///< [1]
  double limit = 0.0;  ///< [1]: the largest valid value, or the smallest one
  std::size_t dataset = 0;
  double diameter = 0.0;        ///< diameter of the sphere [m]
  double velocity = 0.0;        ///< [m/s]
  double yield_pressure = 0.0;  ///< of first yield, used for `pressure_yield` [Pa]
  bool yield_stated = false;    ///< true: from the stated hardness or yield strength of the body

  /// Must the value be above the limit (true) or below it (false)?
  bool limit_is_least() const {
    return quantity == ValidityQuantity::tabor || quantity == ValidityQuantity::wave_transits;
  }
  bool exceeded() const { return limit_is_least() ? value < limit : value > limit; }
};

/// Every quantity for one impact of a measured sphere. Quantities that do not apply are omitted:
/// the Tabor parameter without adhesion, the yield pressure if the model yields, and the contact
/// time if the contact yields, as the model does not compute it.
/// @param theta [slots]
/// @return empty if the impact cannot be solved
std::vector<Validity> impact_validity(const ImpactModel& model, const ImpactSystem& system,
                                      std::span<const double> theta, const PointConditions& point);

/// Inserts `one` into `worst`, replacing a less extreme value of the same quantity.
void keep_worst(const Validity& one, std::vector<Validity>& worst);

/// The most extreme case of each quantity over the points of each dataset, at the estimate.
/// @pre fitted.usable
std::vector<Validity> fit_validity(const FitResult& fitted, const std::vector<Dataset>& datasets);

}  // namespace recoil
