#pragma once

#include <numbers>
#include <string>
#include <string_view>

namespace recoil {

/// The range of accepted values of a quantity, in SI units.
struct Range {
  double lower = 0.0;
  double upper = 0.0;
  std::string_view unit = "1";
  std::string_view hint = "correct it";  ///< suggestion for a value outside
  std::string_view hint_below = "";      ///< suggestion for a value below `lower`, if different

  constexpr bool contains(double value) const { return value >= lower && value <= upper; }
  /// "it has to lie between 1e-09 and 1 m"; angles in degrees
  std::string sentence() const;
  /// The suggestion for `value`, which is outside.
  std::string hint_for(double value) const;
};

/// These limits are far beyond the validity of the Hertz model. They catch values in a wrong unit.
namespace limits {

/// From a nanometre, below which there is no continuum, to a metre.
inline constexpr Range diameter{1e-9, 1.0, "m", "the unit is probably um",
                                "the unit is probably m"};
/// A larger diameter is kept with a warning: microspheres are smaller [m].
inline constexpr double unusual_diameter = 1e-3;
/// One standard deviation; the lower end is a thousandth of the smallest diameter.
inline constexpr Range diameter_sd{1e-12, 1.0, "m", "the unit is probably um",
                                   "leave the cell empty when it is not known"};

/// Hertz contact is quasi-static: impacts are slower than sound in solids, 1e3 to 1.2e4 m/s.
inline constexpr Range velocity{1e-7, 1e4, "m/s", "check the unit"};
/// One standard deviation; the lower end is a thousandth of the slowest velocity.
inline constexpr Range velocity_sd{1e-10, 1e4, "m/s", "check the unit",
                                   "leave the cell empty when it is not known"};

/// Noise can bring a restitution above 1, but not beyond 1.2.
inline constexpr Range restitution{0.0, 1.2, "1",
                                   "correct it; a restitution in per cent has the unit %"};
/// One standard deviation; the lower end is far below the rounding of e.
inline constexpr Range restitution_sd{1e-12, 1.0, "1", "a deviation in per cent has the unit %",
                                      "leave the cell empty when it is not known"};

/// From the normal, below a right angle (the number before pi / 2).
inline constexpr Range incidence_angle{
    0.0, 1.5707963267948963, "rad",
    "it is measured from the normal, below 90 deg; subtract an angle to the surface from 90 deg"};
/// Li, Dunn & Brach (1999) kept to 8 degrees of the normal. A larger angle is kept with a warning
/// [rad].
inline constexpr double usual_incidence_angle = 8.0 * std::numbers::pi / 180.0;
/// A solid sphere without spin that rolls off keeps 5/7, and 3/7 if its contact point goes back as
/// fast as it came (an ideal superball: Cross 2002, Am. J. Phys. 70, 1093-1102). Spin before the
/// impact adds 2/7 of its surface speed to the first: with backspin e_t can be negative.
inline constexpr Range tangential_restitution{
    -1.0, 1.2, "1", "it is a ratio of tangential velocities; in per cent its unit is %"};

/// Impacts averaged in one point.
inline constexpr Range events{1.0, 1e9, "impacts", "split the point", "count the impacts"};

/// Light foams to osmium (22590 kg/m3).
inline constexpr Range density{25.0, 3e4, "kg/m3", "give it in kg/m3: 1 g/cm3 is 1000 kg/m3"};
/// Soft gels (about 1 kPa) to diamond (1.2 TPa).
inline constexpr Range youngs_modulus{1e3, 2e12, "Pa", "give it in Pa: 1 GPa is 1e9 Pa"};
/// Tungsten has about 4 J/m2, cleaved diamond about 10.
inline constexpr Range surface_energy{0.0, 20.0, "J/m2", "give it in J/m2: 1 mJ/m2 is 1e-3 J/m2"};
/// Hardness or yield strength, from soft gels to diamond (100 GPa).
inline constexpr Range strength{1.0, 2e11, "Pa",
                                "give it in Pa: 1 GPa is 1e9 Pa, HV 100 is 0.98 GPa"};
/// Solids have 1.1 (foams) to some 1e4 (ferroelectrics).
inline constexpr Range permittivity{1.0, 1e6, "1", "silicon has 11.7; leave it out for a metal"};
/// W_A = 2 sqrt(gamma1 gamma2).
inline constexpr Range adhesion_energy{
    0.0, 40.0, "J/m2", "give it in J/m2: 1 mJ/m2 is 1e-3 J/m2; 0 means no adhesion"};
/// K = (4/3) E* of two equal bodies is at most (2/3) E / (1 - nu^2) < E.
inline constexpr Range stiffness_K{1e3, 2e12, "Pa", "give it in Pa: 1 GPa is 1e9 Pa"};
/// Table 1 of Li, Dunn & Brach (1999) has f0 from 5.7 to 310 N/m.
inline constexpr Range adhesion_force_f0{0.0, 1e6, "N/m", "give it in N/m; 0 means no adhesion"};
inline constexpr Range reference_diameter{1e-9, 1.0, "m", "give it in m: 1 um is 1e-6 m"};

/// From vacuum to a hundred atmospheres.
inline constexpr Range pressure{0.0, 1e7, "Pa", "give it in Pa: 1 atm is 101325 Pa, 0 is vacuum"};
inline constexpr Range temperature{50.0, 2000.0, "K", "give it in K: 20 degrees Celsius is 293 K"};
/// Heights of measuring planes and thicknesses of plates.
inline constexpr Range height{0.0, 10.0, "m", "give it in m: 1 mm is 1e-3 m"};
inline constexpr Range thickness{1e-9, 10.0, "m", "give it in m: 1 mm is 1e-3 m"};
inline constexpr Range roughness{0.0, 1e-3, "m", "give it in m: 1 nm is 1e-9 m"};
inline constexpr Range film{0.0, 0.1, "m", "give it in m: 1 um is 1e-6 m", "0 means dry"};
inline constexpr Range humidity{0.0, 1.0, "1", "50 % is written 0.5"};

}  // namespace limits
}  // namespace recoil
