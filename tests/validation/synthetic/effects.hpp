#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/random.hpp"
#include "validation/synthetic/sphere.hpp"

namespace recoil::hidden {

/// Streams of random numbers that no command of recoil draws from.
inline constexpr auto hidden_purpose = static_cast<RandomPurpose>(1000);

/// A smooth random factor: how wrong a law may be. One plus a sum of three plane waves in
/// (ln V, ln d) of equal height, whose lengths lie between 5 and 20 in these logarithms.
struct Bend {
  struct Wave {
    double per_log_velocity = 0.0, per_log_diameter = 0.0, phase = 0.0;
  };
  double size = 0.0;  ///< standard deviation of the factor [1]; 0: it is 1 everywhere
  std::array<Wave, 3> waves;

  double factor(double velocity, double diameter) const;
};

/// @param which of the bends of this draw
Bend draw_bend(double size, std::uint64_t seed, std::uint64_t which);

/// A factor on e that no known cause has.
enum class Oddity { none, dip, kink, wave };

/// All that can be hidden. Zero: absent.
struct Effects {
  ContactExtras contact;
  double jkr_work = 0.0;              ///< W [J/m2]
  double bridge_length = 0.0;         ///< of water [m]
  double asperity_energy = 0.0;       ///< [J]
  double gas_pressure = 0.0;          ///< [Pa]
  double gas_distance = 2e-5;         ///< from the measuring plane [m]
  double surface_field = 0.0;         ///< of the charge, at the reference diameter [V/m]
  double charge_exponent = 2.0;       ///< of the charge with the diameter
  double hamaker_constant = 0.0;      ///< [J]
  double flight_pressure = 0.0;       ///< of the air in which dropped spheres fly [Pa]
  bool flights_timed = false;         ///< velocities stand for times of flight, not for heights
  double height_error = 0.0;          ///< read too much in the height of the rebound [m]
  double plane_height = 0.0;          ///< [m]
  double velocity_error = 0.0;        ///< read too much [m/s]
  double rebound_error_sign = 1.0;    ///< -1: the rebound reads as much too little
  double diameter_error = 0.0;        ///< true diameter over stated one, less 1
  double size_spread = 0.0;           ///< sd of ln d
  double adhesion_spread = 0.0;       ///< sd of ln f0 from impact to impact
  double slowest_rebound = 0.0;       ///< that is seen [m/s]
  double outlier_share = 0.0;         ///< of the pairs
  std::vector<double> series_offset;  ///< on e, one for each series
  double velocity_scatter = 0.0;  ///< sd of the printed velocity of a point, not stated, relative
  double height_scatter = 0.0;    ///< relative sd of the height of a setting, not stated
  double odd_share = 0.0;         ///< of the points: misread by 6 to 15 standard deviations
  double deviations_short = 0.0;  ///< true standard deviation over the stated one, less 1
  Oddity oddity = Oddity::none;
  double oddity_size = 0.0;    ///< on ln e
  double oddity_centre = 1.0;  ///< [m/s]
  double oddity_width = 1.0;   ///< in ln V
  bool other_laws = false;     ///< second published laws, where there are any
  Bend bend_of_laws;           ///< a factor on what the effects do to e^2
  Bend bend_of_base;           ///< a factor on 1 - e^2 of the base model
};

/// Root mean square of the offsets of the series on e; 0 without any.
double size_of_offsets(const Effects& effects);

/// (v_out / V)^2 of one sphere on its way from the measuring plane to the surface and back; below
/// zero when it does not come back. @param velocity as read [m/s] @param diameter as stated [m]
/// @param size_factor, adhesion_factor how this sphere differs from the typical one
double square_of_restitution(const Base& base, const Effects& effects, double velocity,
                             double diameter, double size_factor = 1.0,
                             double adhesion_factor = 1.0);

/// Diameter over the stated one of the sphere at z standard deviations of ln d: the stated one is
/// the mean of all, not their median.
double size_of(double spread, double z);

/// How single readings of e scatter: (relative e)^2 + floor^2 + (slope (1 - e^2) / e)^2; the last
/// is a scatter of the velocity, which counts where e rises steeply.
struct Scatter {
  double relative = 0.10;
  double floor = 0.01;
  double slope = 0.01;
  double of(double e) const;
};

/// What one point shows on average over very many impacts.
struct Expected {
  double restitution = 0.0;  ///< mean of what is seen; 0: nothing is seen
  double event_sd = 0.0;     ///< of single readings
};
Expected expected_point(const Base& base, const Effects& effects, const Scatter& scatter,
                        double velocity, double diameter, std::size_t series);

/// What one impact leaves behind.
struct Reading {
  bool captured = false;
  bool seen = false;         ///< it came back, and fast enough
  double restitution = 0.0;  ///< as read, where it is seen
};

/// One impact by itself. `typical` is the square of the restitution that all impacts of the point
/// share; nothing where the spheres differ. Draws the same numbers whatever becomes of it.
Reading read_impact(const Base& base, const Effects& effects, const Scatter& scatter,
                    double velocity, double diameter, std::optional<double> typical,
                    RandomStream& random);

/// The square of the restitution that all impacts share; nothing where the spheres differ.
std::optional<double> shared_square(const Base& base, const Effects& effects, double velocity,
                                    double diameter);

/// The mean of `events` rebounds.
double observed_mean(const Base& base, const Effects& effects, const Scatter& scatter,
                     double velocity, double diameter, std::size_t series, int events,
                     RandomStream& random);

}  // namespace recoil::hidden
