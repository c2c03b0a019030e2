#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "core/units.hpp"
#include "validation/recipe/recipe.hpp"
#include "validation/truth/falling_sphere.hpp"

namespace recoil {
namespace {

double square(double x) { return x * x; }

/// Variance of one observed event about a true restitution `e`.
double event_variance(const ImpactNoise& noise, double e) {
  return square(noise.relative * e) + square(noise.floor);
}

/// Whether a rebound with restitution `e` comes back to the measuring plane.
bool seen(const SizeDistribution& sizes, double e, double velocity) {
  return e > 0.0 && e * velocity > sizes.slowest_seen();
}

void average_over_sizes(const Recipe& recipe, PlannedPoint& point) {
  const SizeDistribution& sizes = *recipe.sizes;
  double part = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (std::size_t i = 0; i < sizes.diameters.size(); ++i) {
    const double e = true_restitution(recipe.truth, sizes.diameters[i], point.velocity);
    point.by_size.push_back(e);
    if (!seen(sizes, e, point.velocity)) continue;
    part += sizes.weights[i];
    first += sizes.weights[i] * e;
    second += sizes.weights[i] * (e * e + event_variance(recipe.noise, e));
  }
  if (part < 0.01) {
    throw InputError(
        {recipe.file.string()},
        fmt::format("at {:g} m/s fewer than one impact in a hundred rebounds", point.velocity),
        "a mean of rebounds would take too many impacts", "raise the lowest velocity");
  }
  point.seen = part;
  point.restitution = first / part;
  const double variance = second / part - square(point.restitution);
  point.restitution_sd = std::sqrt(variance / recipe.noise.events);
}

/// Half to even would make the last digit depend on binary dust; the text decides instead.
double rounded(double value, int decimals) {
  return std::stod(fmt::format("{:.{}f}", value, decimals));
}

double draw_mean(const Recipe& recipe, const PlannedPoint& point, RandomStream& stream) {
  const ImpactNoise& noise = recipe.noise;
  double sum = 0.0;
  for (int event = 0; event < noise.events; ++event) {
    double e = point.restitution;
    if (recipe.sizes) {
      const SizeDistribution& sizes = *recipe.sizes;
      do {
        double left = stream.uniform();
        std::size_t i = 0;
        while (i + 1 < sizes.weights.size() && left >= sizes.weights[i]) left -= sizes.weights[i++];
        e = point.by_size[i];
      } while (!seen(sizes, e, point.velocity));
    }
    sum += e + std::sqrt(event_variance(noise, e)) * stream.normal();
  }
  return sum / noise.events;
}

constexpr std::uint64_t spheres_of_a_height = 1'000'000;
constexpr std::uint64_t first_stream = 1000;

struct SeriesCrossing : Crossing {
  std::size_t series = 0;
};

/// A sphere of random size that hits the surface first at the time `hits` [s].
void drop_sphere(const Recipe& recipe, const PlannedPoint& point, double hits, RandomStream random,
                 std::vector<SeriesCrossing>& passages) {
  const SizeDistribution& sizes = *recipe.sizes;
  const PassageDesign& design = *recipe.passages;
  std::size_t size = 0;
  double left = random.uniform();
  while (size + 1 < sizes.weights.size() && left >= sizes.weights[size]) {
    left -= sizes.weights[size++];
  }
  const double diameter = sizes.diameters[size];
  const Instrument instrument = {sizes.probe_height, sizes.probe_height, design.volume_sd,
                                 design.velocity_sd, design.diameter_sd, design.angle_sd,
                                 design.seen,        design.seen,        design.return_time};
  double e = point.by_size[size];  // of the first impact
  bool first = true;
  follow_sphere(
      instrument, diameter, hits, point.velocity, random,
      [&](double speed) {
        if (!first) e = true_restitution(recipe.truth, diameter, speed);
        first = false;
        const double seen = e * (1.0 + recipe.noise.relative * random.normal());
        return e > 0.0 ? std::max(seen, 0.0) : 0.0;
      },
      [&](const FallenImpact& impact) {
        for (const auto& crossing : {impact.down, impact.up}) {
          if (crossing) passages.push_back({*crossing, point.series});
        }
      });
}

}  // namespace

std::vector<PlannedPoint> make_plan(const Recipe& recipe) {
  std::vector<PlannedPoint> plan;
  for (std::size_t series = 0; series < recipe.series.size(); ++series) {
    for (const double velocity : recipe.series[series].velocities) {
      PlannedPoint point;
      point.series = series;
      point.diameter = recipe.series[series].diameter;
      point.velocity = velocity;
      if (recipe.sizes) {
        average_over_sizes(recipe, point);
      } else {
        point.restitution = true_restitution(recipe.truth, point.diameter, velocity);
        point.restitution_sd =
            std::sqrt(event_variance(recipe.noise, point.restitution) / recipe.noise.events);
      }
      plan.push_back(std::move(point));
    }
  }
  return plan;
}

std::vector<GeneratedPoint> draw_points(const Recipe& recipe, std::uint64_t seed) {
  std::vector<GeneratedPoint> points;
  points.reserve(recipe.plan.size());
  for (std::size_t i = 0; i < recipe.plan.size(); ++i) {
    const PlannedPoint& planned = recipe.plan[i];
    RandomStream stream(seed, RandomPurpose::reconstruction, i);
    GeneratedPoint point;
    point.series = planned.series;
    point.diameter = planned.diameter;
    point.velocity = planned.velocity;
    point.restitution = rounded(draw_mean(recipe, planned, stream), recipe.noise.decimals);
    point.restitution_sd = rounded(planned.restitution_sd, recipe.noise.decimals + 1);
    point.events = recipe.noise.events;
    points.push_back(point);
  }
  return points;
}

std::string to_csv(const Recipe& recipe, const std::vector<GeneratedPoint>& points) {
  std::string text = "series,diameter,incident_velocity,restitution,restitution_sd,events\n";
  for (const GeneratedPoint& point : points) {
    text += fmt::format("{},{:.6g},{:.6g},{:.{}f},{:.{}f},{}\n", recipe.series[point.series].name,
                        point.diameter / units::um, point.velocity, point.restitution,
                        recipe.noise.decimals, point.restitution_sd, recipe.noise.decimals + 1,
                        point.events);
  }
  return text;
}

std::string draw_passages(const Recipe& recipe, std::uint64_t seed, int times) {
  if (!recipe.passages || !recipe.sizes) {
    throw InputError({recipe.file.string()}, "the recipe has no table [passages]",
                     "without it nothing says what an instrument would record",
                     "add it, and [sizes]");
  }
  const PassageDesign& design = *recipe.passages;
  std::vector<SeriesCrossing> passages;
  double now = 1.0;
  for (std::size_t k = 0; k < recipe.plan.size(); ++k) {
    const PlannedPoint& point = recipe.plan[k];
    const double both = point.seen * design.seen * design.seen;
    const auto spheres = static_cast<std::uint64_t>(std::ceil(times * recipe.noise.events / both));
    const std::uint64_t stream = (first_stream + k) * spheres_of_a_height;
    for (std::uint64_t i = 0; i < spheres; ++i) {
      RandomStream random(seed, RandomPurpose::reconstruction, stream + i);
      now -= std::log(random.uniform()) / design.rate;
      drop_sphere(recipe, point, now, random, passages);
    }
    now += 10.0;  // the dispenser is moved; nothing is in the air any more
  }
  std::stable_sort(passages.begin(), passages.end(),
                   [](const Crossing& a, const Crossing& b) { return a.time < b.time; });
  std::string text = "series,time,velocity,tangential_velocity,diameter\n";
  for (const SeriesCrossing& passage : passages) {
    text += fmt::format("{},{:.6f},{:.5f},{:.5f},{:.2f}\n", recipe.series[passage.series].name,
                        passage.time, passage.velocity, passage.tangential,
                        passage.diameter / units::um);
  }
  return text;
}

}  // namespace recoil
