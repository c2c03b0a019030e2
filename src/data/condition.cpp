#include "data/condition.hpp"

#include "data/limits.hpp"

namespace recoil {

const ConditionInfo& info_of(Condition condition) {
  static constexpr std::array<ConditionInfo, NamesOf<Condition>::names.size()> all = {{
      {"Pa", "pressure of the air around, 0 in vacuum", 0.0, limits::highest_pressure,
       "give it in Pa: 1 atm is 101325 Pa, 0 is vacuum"},
      {"1", "relative humidity of the air", 0.0, 1.0, "50 % is written 0.5"},
      {"K", "temperature of the air", limits::lowest_temperature, limits::highest_temperature,
       "give it in K: 20 degrees Celsius is 293 K"},
      {"m", "thickness of the target, where it is a plate", limits::smallest_diameter, 10.0,
       "give it in m: 1 mm is 1e-3 m"},
      {"m", "height of the measuring plane above the surface", 0.0, 10.0,
       "give it in m: 1 mm is 1e-3 m"},
      {"1", "1 where the charge of the spheres was taken off, else 0", 0.0, 1.0,
       "1 means neutralised, 0 that they were not", true},
      {"m", "root mean square roughness of the surface", 0.0, 1e-3, "give it in m: 1 nm is 1e-9 m"},
      {"1", "1 where what is read was checked against a known velocity or height, else 0", 0.0, 1.0,
       "1 means checked, 0 that it was not", true},
      {"1", "1 where the diameters were checked against a standard, else 0", 0.0, 1.0,
       "1 means checked, 0 that they were not", true},
  }};
  return all[static_cast<std::size_t>(condition)];
}

Conditions Conditions::or_else(const Conditions& others) const {
  Conditions both = *this;
  for (std::size_t k = 0; k < values_.size(); ++k) {
    if (!both.values_[k]) both.values_[k] = others.values_[k];
  }
  return both;
}

}  // namespace recoil
