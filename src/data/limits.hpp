#pragma once

namespace recoil::limits {

/// What a value of a dataset may be, in SI units. The limits are far outside of anything that the
/// Hertz model describes; their purpose is to catch values in the wrong unit at the door.

/// Diameters [m]: from a nanometre, where no continuum is left, to a metre.
inline constexpr double smallest_diameter = 1e-9;
inline constexpr double largest_diameter = 1.0;
/// Above this a diameter is kept with a question: microspheres are smaller [m].
inline constexpr double unusual_diameter = 1e-3;

/// Velocities [m/s]: Hertz contact is quasi-static, so impacts stay below the speed of sound in
/// solids, about 1e3 to 1.2e4 m/s.
inline constexpr double slowest_velocity = 1e-7;
inline constexpr double fastest_velocity = 1e4;
/// One standard deviation of a velocity [m/s]: a thousandth of the slowest velocity.
inline constexpr double slowest_velocity_sd = 1e-10;
/// One standard deviation of a diameter [m]: a thousandth of the smallest diameter.
inline constexpr double smallest_diameter_sd = 1e-12;

/// Above 1 a restitution can only be noise; beyond this it is a mistake [1].
inline constexpr double largest_restitution = 1.2;

/// One standard deviation of a restitution [1]. The lower end is where rounding of e begins.
inline constexpr double smallest_restitution_sd = 1e-12;
inline constexpr double largest_restitution_sd = 1.0;

/// Impacts averaged in one point.
inline constexpr double most_events = 1e9;

/// Mass densities [kg/m3]: light foams to osmium (22590). Below the lower end a number is more
/// likely in g/cm3.
inline constexpr double lowest_density = 25.0;
inline constexpr double highest_density = 3e4;

/// Young's moduli [Pa]: soft gels (about 1 kPa) to diamond (1.2 TPa).
inline constexpr double lowest_modulus = 1e3;
inline constexpr double highest_modulus = 2e12;

/// Surface energies [J/m2]: tungsten has about 4, cleaved diamond about 10.
inline constexpr double highest_surface_energy = 20.0;
/// W_A = 2 sqrt(gamma1 gamma2) [J/m2].
inline constexpr double highest_adhesion_energy = 2.0 * highest_surface_energy;

/// K = (4/3) E* of two equal bodies is at most (2/3) E / (1 - nu^2) < E [Pa].
inline constexpr double lowest_stiffness = 1e3;
inline constexpr double highest_stiffness = highest_modulus;

/// f0 [N/m]: Table 1 of Li, Dunn & Brach (1999) has 5.7 to 310.
inline constexpr double highest_adhesion_force = 1e6;

/// Ambient pressure [Pa], from vacuum (0) to a hundred atmospheres.
inline constexpr double highest_pressure = 1e7;
/// Temperatures [K]. Below the lower end a number is more likely in degrees Celsius.
inline constexpr double lowest_temperature = 50.0;
inline constexpr double highest_temperature = 2000.0;

}  // namespace recoil::limits
