#pragma once

#include <span>
#include <vector>

#include "mechanism/encounter.hpp"
#include "mechanism/parameter.hpp"

namespace recoil {

/// The values of one parameter that matter, or a careful experiment, can have in given impacts.
struct AllowedValues {
  double lower = 0.0;  ///< in the parameter's unit
  double upper = 0.0;
  bool lower_by_limit = false;  ///< set by `Parameter::limit`, not by `Parameter::plausible`
  bool upper_by_limit = false;
  double quantity = 0.0;  ///< that is limited, at the value in `own` [1]; 0 where nothing is
};

/// `parameter.plausible`, narrowed to where the largest value that its limit's quantity takes among
/// `spheres` lies within the limit. Where no value does, lower equals upper.
/// @param k the place of `parameter` among `own`, the parameters of its mechanism
AllowedValues allowed_values(const Parameter& parameter, std::size_t k, std::span<const double> own,
                             std::span<const Encounter<double>> spheres);

/// A sphere that arrives as the dataset has it, with the adhesion and damping left out.
Encounter<double> plain_sphere(const Surroundings& at, double diameter, double velocity,
                               std::size_t series);

}  // namespace recoil
