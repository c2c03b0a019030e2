#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/json.hpp"
#include "data/dataset.hpp"
#include "validation/truth/truth.hpp"

namespace recoil {

/// A number that reading refuses unless it is above zero.
struct Positive {
  Positive(double stated = 0.0) : value(stated) {}
  double value;
  operator double() const { return value; }
};

/// A number that reading refuses below zero.
struct NotNegative {
  NotNegative(double stated = 0.0) : value(stated) {}
  double value;
  operator double() const { return value; }
};

/// A whole number that reading refuses below `lowest`.
template <int lowest>
struct AtLeast {
  int value = lowest;
  operator int() const { return value; }
};

/// One series of the design: a size and the velocities at which it was thrown.
struct RecipeSeries {
  std::string name;
  double diameter = 0.0;           ///< as written into the points [m]; the d10 of mixed sizes
  std::vector<double> velocities;  ///< [m/s], ascending
};

/// What one observed impact adds to the truth, and how many make a point.
struct ImpactNoise {
  NotNegative relative;  ///< standard deviation of one event's e, as a part of e [1]
  NotNegative floor;     ///< a constant one, added in quadrature [1]
  AtLeast<1> events;     ///< events that rebounded, per point
  AtLeast<1> decimals;   ///< of e in points.csv; its standard deviation carries one more
  Location where;
  RECOIL_FIELDS(relative, floor, events, decimals)
};

/// Sizes drawn anew for every impact: a log-normal distribution, cut at both ends, on whole
/// micrometres. Only impacts that rebound, fast enough to climb back to the measuring plane, count.
struct SizeDistribution {
  Positive lower;                 ///< [m]
  Positive upper;                 ///< [m]
  Positive median;                ///< of the uncut distribution [m]
  Positive log_sd;                ///< standard deviation of ln d [1]
  NotNegative probe_height;       ///< of the measuring plane above the surface [m]
  std::vector<double> diameters;  ///< the whole micrometres [m]
  std::vector<double> weights;    ///< their probabilities, sum 1
  Location where;
  RECOIL_FIELDS(lower, upper, median, log_sd, probe_height)

  double mean() const;  ///< d10 [m]
  /// Slowest rebound that is seen: sqrt(2 g h) [m/s].
  double slowest_seen() const;
};

/// What an instrument records of each impact, see `draw_passages`.
struct PassageDesign {
  Positive rate;            ///< spheres released per second, at random times
  NotNegative velocity_sd;  ///< of one passage, relative [1]
  NotNegative diameter_sd;  ///< of one passage, relative [1]
  NotNegative volume_sd;    ///< of the height at which a passage is timed [m]
  NotNegative angle_sd;     ///< of the incidence to the normal [rad]
  Positive seen;            ///< part of the passages that is recorded [1]
  Positive return_time;     ///< a rebound comes back through the volume with exp(-t / this) [s]
  Location where;
  RECOIL_FIELDS(rate, velocity_sd, diameter_sd, volume_sd, angle_sd, seen, return_time)
};

/// How points are made from these passages, as `recoil pair` understands it.
struct PairingDesign {
  Positive height;     ///< first estimate of the measuring plane's height [m]
  Positive angle;      ///< rebounds within this of the normal are used [rad]
  AtLeast<2> per_bin;  ///< impacts of one point, about
  Location where;
  RECOIL_FIELDS(height, angle, per_bin)
};

/// A published fact that the reconstruction has to show, with the numbers that decide.
struct FactSpec {
  std::string id;  ///< which check of `check_facts` decides
  std::string statement;
  std::string source;
  std::map<std::string, double> limits;  ///< thresholds, SI
  Location where;
  RECOIL_FIELDS(id, statement, source, limits)
};

/// One point of the design with its noiseless truth; what regenerating costs is only the noise.
struct PlannedPoint {
  std::size_t series = 0;
  double diameter = 0.0;        ///< [m]
  double velocity = 0.0;        ///< [m/s]
  double restitution = 0.0;     ///< what the mean of the events tends to [1]
  double restitution_sd = 0.0;  ///< standard error of that mean [1]
  double seen = 1.0;            ///< part of the impacts that is seen to rebound [1]
  std::vector<double> by_size;  ///< e of each size of the distribution; empty for one size
};

/// recipe.toml, validated, with the noiseless truth of every point.
struct Recipe {
  std::filesystem::path folder;
  std::filesystem::path file;
  std::string id;  ///< the folder's name
  std::uint64_t seed = 0;
  Material particle;
  Material surface;
  Truth truth;
  std::vector<RecipeSeries> series;
  ImpactNoise noise;
  std::optional<SizeDistribution> sizes;
  std::optional<PassageDesign> passages;
  std::optional<PairingDesign> pairing;  ///< points come from the passages; else means are drawn
  std::vector<FactSpec> facts;
  std::vector<std::string> assumptions;  ///< what is ours and not published, a sentence each
  std::vector<std::string> siblings;     ///< ids of recipes beside this one, for shared facts
  std::vector<PlannedPoint> plan;        ///< in the order of points.csv
};

/// Reads `folder`/`name` and computes the truth of its points. Unknown keys are errors.
/// @throws InputError with file, line and column.
Recipe load_recipe(const std::filesystem::path& folder, const std::string& name = recipe_name);

/// The noiseless truth of every point of the recipe's design, in the order of points.csv.
/// For mixed sizes, e is the mean over the impacts that are seen to rebound, weighted by the size
/// distribution, and its standard deviation holds the scatter of the sizes as well as the noise.
/// @throws InputError when fewer than one impact in a hundred would be seen at some point.
std::vector<PlannedPoint> make_plan(const Recipe& recipe);

/// One point as it stands in points.csv: rounded.
struct GeneratedPoint {
  std::size_t series = 0;
  double diameter = 0.0;        ///< [m]
  double velocity = 0.0;        ///< [m/s]
  double restitution = 0.0;     ///< mean of the events that rebounded [1]
  double restitution_sd = 0.0;  ///< standard error that the recipe implies [1]
  int events = 0;
};

/// Draws the events of every point from the stream (seed, reconstruction, point number), averages
/// and rounds.
std::vector<GeneratedPoint> draw_points(const Recipe& recipe, std::uint64_t seed);

/// points.csv, diameters in um, velocities in m/s.
std::string to_csv(const Recipe& recipe, const std::vector<GeneratedPoint>& points);

/// One fact, evaluated.
struct FactCheck {
  std::string id;
  std::string statement;
  std::string source;
  bool holds = false;
  std::string found;  ///< the number or range that was found, with its limits
};

/// @throws InputError at the fact when its id is not in the catalogue, or its limits are not those
/// that the check takes.
void require_known_fact(const FactSpec& fact);

/// Evaluates every fact of the recipe on `points` and on the noiseless truth; loads the siblings.
std::vector<FactCheck> check_facts(const Recipe& recipe, const std::vector<GeneratedPoint>& points);

/// What a phase Doppler instrument would have recorded of the recipe's experiment: one row per
/// passage through the measuring plane, `series,time,velocity,tangential_velocity,diameter` in s,
/// m/s and um, in the order of time; for `recoil pair`.
///
/// One drop height after the other, so many spheres each that the recipe's number of events is
/// expected to be seen with both passages. A sphere of random size falls freely, is captured or
/// rebounds with the truth's e at its own size and velocity, with the recipe's scatter of one
/// event; leaves rolling, with 5/7 of its tangential velocity, so that tan(angle out) = (5/7)
/// tan(angle in) / e; passes the plane again where it is fast enough; may come back through the
/// volume for a second impact, and so on. Sphere i of height k draws from the stream (seed,
/// reconstruction, 10^6 (k + 1000) + i): the points' own streams have smaller numbers.
/// @param times as many spheres as the recipe asks for.
/// @throws InputError when the recipe has no table [passages] or no [sizes].
std::string draw_passages(const Recipe& recipe, std::uint64_t seed, int times = 1);

}  // namespace recoil
