#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "core/units.hpp"
#include "validation/recipe/recipe.hpp"
#include "validation/truth/falling_sphere.hpp"

namespace recoil {
namespace {

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
