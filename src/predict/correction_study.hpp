#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "experiment/averages.hpp"
#include "experiment/events.hpp"
#include "experiment/pairing.hpp"

namespace recoil {

/// A step of the way from events to points that can be left out.
enum class Correction {
  none_left_out,
  probe_plane,     ///< velocities taken at the measuring plane, not at the surface
  second_impacts,  ///< second and further impacts used like first ones
  survivors,       ///< the captured not counted: means of rebounds taken as means of all
  all_left_out
};

inline constexpr std::array all_ways = {Correction::none_left_out, Correction::probe_plane,
                                        Correction::second_impacts, Correction::survivors,
                                        Correction::all_left_out};

/// "probe_plane", ...
std::string to_string(Correction left_out);

/// "velocities taken at the measuring plane", ...: what is done instead, for people.
std::string words_of(Correction left_out);

/// Events of which the truth is known, because they were simulated.
struct KnownEvents {
  EventTable table;
  double rebounds_per_velocity = 0.0;  ///< as many spheres are seen to rebound per velocity
  std::vector<double> velocities;      ///< of the design [m/s], ascending
  double diameter = 0.0;               ///< the mean one, d10 [m]
  double C_H = 0.0;                    ///< [s/m]
  double C_A = 0.0;                    ///< [s/m]
  double capture_velocity = 0.0;       ///< at `diameter` [m/s]
  std::function<double(double diameter, double velocity)> restitution;  ///< [m], [m/s] -> e
};

/// The points and the fit when one correction is left out.
struct CorrectionRow {
  Correction left_out = Correction::none_left_out;
  std::size_t points = 0;
  std::size_t captured = 0;          ///< spheres that the points call captured
  std::optional<double> error_slow;  ///< mean over rebounds of e - truth at the point's own size
                                     ///< and velocity, below `slow_impacts` [1]
  std::optional<double> error_fast;  ///< the same above [1]
  std::vector<std::optional<double>> error;  ///< the same by velocity of the design [1]
  bool usable = false;                       ///< the fit has an answer
  double C_H = 0.0, C_H_sd = 0.0;            ///< [s/m]
  double C_A = 0.0, C_A_sd = 0.0;            ///< [s/m]
  double capture_velocity = 0.0;             ///< at d10 [m/s]
  double rmse = 0.0;                         ///< of e [1]
};

/// What each correction does to e and to the parameters, on one set of events.
struct CorrectionStudy {
  std::size_t passages = 0;
  double rebounds_per_velocity = 0.0;
  std::size_t size_classes = 1;
  std::vector<double> velocities;                       ///< [m/s]
  double diameter = 0.0;                                ///< d10 [m]
  double C_H = 0.0, C_A = 0.0, capture_velocity = 0.0;  ///< the truth [s/m, s/m, m/s]
  std::vector<CorrectionRow> rows;                      ///< in the order of `Correction`
};

/// Below it adhesion shows in the restitution of the paper's steel spheres [m/s].
inline constexpr double slow_impacts = 0.7;

/// Pairs and averages `events`, fits the points as `spec` says, and does the same again with each
/// correction left out. All rows rest on the same events, so their differences are those of the
/// correction and not of chance.
/// @param like the dataset whose materials the points get.
/// @param ways the rows that are wanted.
CorrectionStudy study_corrections(const FitSpec& spec, const Dataset& like,
                                  const KnownEvents& events, const PairOptions& pairing,
                                  const AverageOptions& averaging,
                                  std::span<const Correction> ways = all_ways);

}  // namespace recoil
