#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "data/contact.hpp"
#include "data/dataset.hpp"

namespace recoil {

/// A constant with a stated error: of the materials, or a coefficient of the error of the laws
/// (`LawError`), whose stated value is 0 and whose sd is 1. It is a parameter of the fit, and its
/// stated value is one more observation. Positive constants are lognormal: the stated value is the
/// median, and the logarithm has the sd sqrt(ln(1 + (sd / value)^2)). The others are normal.
struct UncertainConstant {
  Body body = Body::particle;
  Constant constant = Constant::density;
  double stated = 0.0;  ///< in its own unit
  double sd = 0.0;      ///< sd of its logarithm if it is positive, else of the constant itself
  /// Datasets that share it: the same body with the same stated value.
  std::vector<std::size_t> datasets = {};
  bool of_laws = false;  ///< a coefficient of the error of the laws, of no body

  /// (`value` - `stated_value`) in standard deviations.
  double deviation(double value, double stated_value) const;
  /// The value that lies `by` standard deviations above `value`: the inverse of `deviation`.
  double moved(double value, double by) const;
  /// d deviation / d value.
  double deviation_slope(double value) const;

 private:
  bool positive() const { return !of_laws && is_positive(constant); }
};

/// The materials of one dataset at given values of their constants, in SI units.
struct MaterialState {
  double density = 0.0;
  double stiffness = 0.0;        ///< K
  double adhesion_force = 0.0;   ///< f0 at the reference diameter, derived or stated
  double adhesion_energy = 0.0;  ///< W_A
  double wave_mobility = 0.0;    ///< of Surroundings
};

/// d ln (member of MaterialState) / d (constant `index`) [1 / unit of the constant].
struct MaterialSlope {
  std::size_t index = 0;
  double density = 0.0, stiffness = 0.0, adhesion_force = 0.0, adhesion_energy = 0.0,
         wave_mobility = 0.0;
};

/// Computes the materials of one dataset from the constants by eqs 6, 7, 9 to 11 of
/// `derive_contact` and by `half_space_mobility`, for any values of the uncertain constants.
class MaterialLaw {
 public:
  /// Selects the constants of `all` that act on `dataset`.
  MaterialLaw(const ImpactSystem& system, const ContactProperties& contact,
              const std::vector<UncertainConstant>& all, std::size_t dataset);

  /// Does no uncertain constant act?
  bool exact() const { return acting_.empty(); }
  /// @param values values of all constants, in their order
  MaterialState at(std::span<const double> values) const;
  std::vector<MaterialSlope> slopes(std::span<const double> values) const;

 private:
  struct Acting {
    std::size_t index;
    Body body;
    Constant constant;
  };
  ImpactSystem with(std::span<const double> values, std::array<double, 2>& gilman) const;

  ImpactSystem system_;
  double relative_radius_;  // at the reference diameter [m]
  std::vector<Acting> acting_;
  double mobility_ = 0.0;                 // at the stated constants
  std::array<double, 2> radiation_ = {};  // first two derivatives of ln c(nu), half_space_radiation
};

/// The constants of `datasets` that have a stated error. Datasets share a constant if they have the
/// same body (same role, same name) and state the same value and error.
std::vector<UncertainConstant> uncertain_constants(const std::vector<Dataset>& datasets);

/// Standard deviation of the logarithm, given that of the value: sqrt(ln(1 + (sd / value)^2)).
double logarithmic_sd(double value, double sd);

}  // namespace recoil
