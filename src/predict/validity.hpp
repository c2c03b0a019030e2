#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "estimate/fit.hpp"

namespace recoil {

/// What has to be small, or large, for the equations of an impact to hold.
enum class ValidityQuantity {
  /// a_max / R, a of the law of adhesion, or of the contact that has yielded. Hertz' theory takes
  /// the strains as small and the sphere as a parabola: good to about 0.3.
  contact_radius,
  /// p_0 / E*, p_0 the largest pressure of the contact: 2 E* a_max / (pi R) where a^2 = R n, and
  /// where it yields the pressure at which it does. No solid resists a
  /// shear of more than about a tenth of its modulus (Frenkel 1926, Z. Phys. 37, 572-609), and a
  /// contact flows at 2.8 times the yield stress (Tabor 1951, The Hardness of Metals): limit 0.3.
  pressure_modulus,
  /// p_0 over the pressure at which the first of the two bodies yields, `Material::yield_pressure`
  /// or, where its strength is not stated, 0.03 E: ammonium fluorescein has 35.3 MPa of 1.2 GPa,
  /// polystyrene some 100 MPa of 2.56 GPa, metals a third of it or less. Not where a mechanism of
  /// the fit has the contact yield. Limit 1.
  pressure_yield,
  /// mu = (R W^2 / (E*^2 z_0^3))^(1/3), z_0 = 0.4 nm, W of f0 by eq. 12 (Tabor 1977). Adhesion acts
  /// inside the contact (JKR) from about 5 on and around it (DMT) below 0.1 (Johnson & Greenwood
  /// 1997, J. Colloid Interface Sci. 192, 326-333). The base model has JKR's equilibrium: least 5.
  tabor,
  /// t_c c / d, c = (E / rho)^(1/2) of the sphere: how often a wave crosses it in one contact. Its
  /// slowest vibration takes about 1.9 crossings (Lamb 1882, nu = 0.3); quasi-static means several
  /// of them: least 5.
  wave_transits,
};

template <>
struct NamesOf<ValidityQuantity> {
  static constexpr std::array<std::string_view, 5> names = {
      "contact_radius_over_sphere_radius", "peak_pressure_over_modulus",
      "peak_pressure_over_yield_pressure", "tabor_parameter", "contact_time_over_wave_transit"};
};

/// One quantity at one impact, and where the equations stop to hold.
struct Validity {
  ValidityQuantity quantity = ValidityQuantity::contact_radius;
  double value = 0.0;  ///< [1]
  double limit = 0.0;  ///< [1]: the largest good value, or the least one
  std::size_t dataset = 0;
  double diameter = 0.0;        ///< of the impact [m]
  double velocity = 0.0;        ///< [m/s]
  double yield_pressure = 0.0;  ///< of `pressure_yield`: what is taken for it [Pa]
  bool yield_stated = false;    ///< by the body's hardness or yield strength

  /// Has the value to stay above the limit? For the others it has to stay below.
  bool limit_is_least() const {
    return quantity == ValidityQuantity::tabor || quantity == ValidityQuantity::wave_transits;
  }
  bool exceeded() const { return limit_is_least() ? value < limit : value > limit; }
};

/// Every quantity for one impact of a sphere as measured. Quantities that do not apply are left
/// out: the Tabor parameter without adhesion, the yield pressure where the model yields, and the
/// time of a contact that yields, which the model does not know.
/// @param theta [slots]
/// @return empty when the impact has no answer
std::vector<Validity> impact_validity(const ImpactModel& model, const ImpactSystem& system,
                                      std::span<const double> theta, const PointConditions& point);

/// Puts `one` into `worst` in place of a less bad one of the same quantity.
void keep_worst(const Validity& one, std::vector<Validity>& worst);

/// The worst case of each over the points of each dataset, at the fit's answer.
/// @pre fitted.usable
std::vector<Validity> fit_validity(const FitResult& fitted, const std::vector<Dataset>& datasets);

}  // namespace recoil
