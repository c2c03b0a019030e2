#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "data/contact.hpp"
#include "data/dataset.hpp"

namespace recoil {

/// A material constant that is known with an error: a parameter of the fit on which the stated
/// value is one more observation. Positive ones scatter by a factor: the stated value is the median
/// of a lognormal with sd of the logarithm sqrt(ln(1 + (sd / value)^2)); Poisson's ratio is normal.
struct UncertainConstant {
  Body body = Body::particle;
  Constant constant = Constant::density;
  double stated = 0.0;                ///< in its own unit
  double sd = 0.0;                    ///< of its logarithm, or of itself where it is not positive
  std::vector<std::size_t> datasets;  ///< that share it: the same body, stated alike

  /// (its value - the stated one) in standard deviations.
  double deviation(double value, double stated_value) const;
  /// Where it lies `by` standard deviations above `value`: the inverse of `deviation`.
  double moved(double value, double by) const;
  /// d deviation / d value.
  double deviation_slope(double value) const;
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

/// How the materials of one dataset follow from the constants: eqs 6, 7, 9 to 11 of
/// `derive_contact`, and `half_space_mobility`, at any values of those that are uncertain.
class MaterialLaw {
 public:
  /// Which of the constants of `all` act on `dataset`.
  MaterialLaw(const ImpactSystem& system, const ContactProperties& contact,
              const std::vector<UncertainConstant>& all, std::size_t dataset);

  /// Does none act?
  bool exact() const { return acting_.empty(); }
  /// @param values of all constants, in their order
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
  double mobility_ = 0.0;                 // as stated
  std::array<double, 2> radiation_ = {};  // of ln c(nu), half_space_radiation: first two
};

/// The constants of `datasets` that are known with an error. One of a body is shared by all
/// datasets with this body (in the same role, of the same name) that state it alike.
std::vector<UncertainConstant> uncertain_constants(const std::vector<Dataset>& datasets);

/// Standard deviation of the logarithm for a stated one of the value.
double logarithmic_sd(double value, double sd);

}  // namespace recoil
