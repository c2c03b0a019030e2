#include "validation/recipe/passages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "core/units.hpp"
#include "validation/recipe/plan.hpp"

namespace recoil {
namespace {

constexpr double g = standard_gravity;
/// Of the tangential velocity, what friction leaves of it in the contact: a sphere that came
/// without spin leaves rolling, v_t' = v_t / (1 + m r^2 / I) with I = (2/5) m r^2 (Brach 1991,
/// Mechanical Impact Dynamics). Friction is enough for that near the normal: mu > (2/7) tan(theta)
/// / (1 + e).
constexpr double rolling_share = 5.0 / 7.0;
constexpr std::uint64_t spheres_of_a_height = 1'000'000;
constexpr std::uint64_t first_stream = 1000;

struct Crossing {
  double time = 0.0;
  double velocity = 0.0;
  double tangential = 0.0;
  double diameter = 0.0;
  std::size_t series = 0;
};

/// One sphere from its release on.
class FallingSphere {
 public:
  FallingSphere(const Recipe& recipe, const PlannedPoint& point, RandomStream random,
                std::vector<Crossing>& passages)
      : recipe_(recipe),
        design_(*recipe.passages),
        height_(recipe.sizes->probe_height),
        point_(point),
        random_(random),
        passages_(passages) {
    double left = random_.uniform();
    while (size_ + 1 < recipe.sizes->weights.size() && left >= recipe.sizes->weights[size_]) {
      left -= recipe.sizes->weights[size_++];
    }
    diameter_ = recipe.sizes->diameters[size_];
  }

  /// @param hits the time of the first impact [s].
  void fly(double hits) {
    double speed = point_.velocity;
    double sideways = speed * std::tan(design_.angle_sd * random_.normal());
    double kept = rolling_share;  // a sphere that rolls already keeps all
    double e = point_.by_size[size_];
    while (true) {
      pass(hits, speed, sideways, true);
      const double seen = e * (1.0 + recipe_.noise.relative * random_.normal());
      const double rebound = e > 0.0 ? std::max(seen, 0.0) * speed : 0.0;
      if (rebound * rebound <= 2.0 * g * height_) return;
      sideways *= kept;
      kept = 1.0;
      pass(hits, rebound, sideways, false);
      const double above = 2.0 / g * std::sqrt(rebound * rebound - 2.0 * g * height_);
      if (random_.uniform() > std::exp(-above / design_.return_time)) return;
      hits += 2.0 * rebound / g;
      speed = rebound;
      e = true_restitution(recipe_.truth, diameter_, speed);
    }
  }

 private:
  void pass(double hits, double speed, double sideways, bool down) {
    const double at = height_ + design_.volume_sd * random_.normal();
    const double plane = std::sqrt(std::max(speed * speed - 2.0 * g * at, 0.0));
    const double velocity = plane * (1.0 + design_.velocity_sd * random_.normal());
    const double diameter = diameter_ * (1.0 + design_.diameter_sd * random_.normal());
    if (random_.uniform() > design_.seen || !(velocity > 1e-4)) return;
    const double apart = (speed - plane) / g;
    passages_.push_back({down ? hits - apart : hits + apart, down ? velocity : -velocity, sideways,
                         diameter, point_.series});
  }

  const Recipe& recipe_;
  const PassageDesign& design_;
  double height_;
  const PlannedPoint& point_;
  RandomStream random_;
  std::vector<Crossing>& passages_;
  std::size_t size_ = 0;
  double diameter_ = 0.0;
};

}  // namespace

std::string draw_passages(const Recipe& recipe, std::uint64_t seed, int times) {
  if (!recipe.passages || !recipe.sizes) {
    throw InputError({recipe.file.string()}, "the recipe has no table [passages]",
                     "without it nothing says what an instrument would record",
                     "add it, and [sizes]");
  }
  const PassageDesign& design = *recipe.passages;
  std::vector<Crossing> passages;
  double now = 1.0;
  for (std::size_t k = 0; k < recipe.plan.size(); ++k) {
    const PlannedPoint& point = recipe.plan[k];
    const double both = point.seen * design.seen * design.seen;
    const auto spheres = static_cast<std::uint64_t>(std::ceil(times * recipe.noise.events / both));
    const std::uint64_t stream = (first_stream + k) * spheres_of_a_height;
    for (std::uint64_t i = 0; i < spheres; ++i) {
      RandomStream random(seed, RandomPurpose::reconstruction, stream + i);
      now -= std::log(random.uniform()) / design.rate;
      FallingSphere(recipe, point, random, passages).fly(now);
    }
    now += 10.0;  // the dispenser is moved; nothing is in the air any more
  }
  std::stable_sort(passages.begin(), passages.end(),
                   [](const Crossing& a, const Crossing& b) { return a.time < b.time; });
  std::string text = "series,time,velocity,tangential_velocity,diameter\n";
  for (const Crossing& passage : passages) {
    text += fmt::format("{},{:.6f},{:.5f},{:.5f},{:.2f}\n", recipe.series[passage.series].name,
                        passage.time, passage.velocity, passage.tangential,
                        passage.diameter / units::um);
  }
  return text;
}

}  // namespace recoil
