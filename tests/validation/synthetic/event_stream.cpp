#include "validation/synthetic/event_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace stream {
namespace {

using recoil::RandomPurpose;
using recoil::RandomStream;

constexpr double g = 9.80665;
/// A solid sphere that arrives without spin and leaves rolling has kept so much of its tangential
/// velocity: friction turns v_t into v_t - J / m and gives it the rim speed (5/2) J / m.
constexpr double rolling = 5.0 / 7.0;

/// The paper's size uncertainty, +-15 % at 2 um to +-1 % at 80 um, a power law between, as 2 sd.
double diameter_sd(double diameter) {
  const double um = std::clamp(diameter * 1e6, 2.0, 80.0);
  return 0.5 * 0.15 * std::pow(15.0, -std::log(um / 2.0) / std::log(40.0));
}

struct Passage {
  double time;
  std::string text;
  Row row;
  Fate fate = Fate::captured;
};

/// One sphere from the dispenser on.
class Sphere {
 public:
  Sphere(const Design& design, std::uint32_t number, double released, double drop,
         std::vector<Passage>& out)
      : design_(design),
        random_(design.seed, RandomPurpose::reconstruction, number),
        number_(number),
        released_(released),
        drop_(drop),
        out_(out) {
    do {
      diameter_ = design.median * std::exp(design.log_sd * random_.normal());
    } while (diameter_ < design.smallest || diameter_ > design.largest);
  }

  /// @returns the time from the passage down to the one up of the first impact; 0 without one.
  double fly() {
    double first_flight = 0.0;
    double impact_speed = std::sqrt(2.0 * g * drop_);
    double hits = released_ + impact_speed / g;
    double sideways = impact_speed * std::tan(design_.angle_sd * random_.normal());
    for (int impact = 1; impact < 50; ++impact) {
      // The path before the impact: height = impact_speed * s - g s^2 / 2 at the time hits - s.
      const std::size_t incoming = record(hits, impact_speed, impact, true, sideways);
      if (impact == 1) sideways *= rolling;  // it rolls from then on
      const double rebound = impact_speed * restitution(impact_speed);
      Fate fate = rebound > 0.0 ? Fate::too_slow : Fate::captured;
      bool comes_back = false;
      if (rebound * rebound > 2.0 * g * (design_.probe_height + 4.0 * design_.volume_sd)) {
        const std::size_t outgoing = record(hits, rebound, impact, false, sideways);
        fate = outgoing > 0 ? Fate::rebound_seen : Fate::rebound_unseen;
        const double up = std::sqrt(rebound * rebound - 2.0 * g * design_.probe_height);
        comes_back = random_.uniform() < std::exp(-2.0 * up / g / design_.return_time);
        if (impact == 1) first_flight = time_from_plane(impact_speed) + time_from_plane(rebound);
      } else if (rebound > 0.0) {
        comes_back = false;  // hops below the plane until it rests
      }
      if (incoming > 0) out_[incoming - 1].fate = fate;
      if (!comes_back) return first_flight;
      hits += 2.0 * rebound / g;
      impact_speed = rebound;
    }
    return first_flight;
  }

 private:
  double time_from_plane(double speed) const {
    return (speed - std::sqrt(speed * speed - 2.0 * g * design_.probe_height)) / g;
  }

  double restitution(double speed) {
    const double capture =
        design_.capture_at_20um * std::pow(diameter_ / 20e-6, -design_.capture_exponent);
    const double scatter = 1.0 + design_.restitution_sd * random_.normal();
    if (speed <= capture) return 0.0;
    const double ratio = capture / speed;
    return std::min(1.0, design_.top_restitution * std::sqrt(1.0 - ratio * ratio) * scatter);
  }

  /// Writes the passage at `speed` (at the surface) before or after the impact.
  /// @returns its place in the output plus one; 0 when the instrument missed it.
  std::size_t record(double hits, double speed, int impact, bool down, double sideways) {
    const double height = design_.probe_height + design_.volume_sd * random_.normal();
    const double at_plane = std::sqrt(std::max(speed * speed - 2.0 * g * height, 1e-12));
    const double apart = (speed - at_plane) / g;
    const double time =
        std::round((down ? hits - apart : hits + apart) / design_.clock) * design_.clock;
    const double velocity = at_plane * (1.0 + design_.velocity_sd * random_.normal());
    const double size =
        diameter_ * (1.0 + design_.diameter_noise * diameter_sd(diameter_) * random_.normal());
    const double seen = design_.seen * (down ? 1.0 : design_.rebound_seen);
    if (random_.uniform() > seen) return 0;
    out_.push_back({time,
                    fmt::format("{:.6f},{:.5f},{:.5f},{:.3f}", time, down ? velocity : -velocity,
                                sideways, size * 1e6),
                    {number_, impact, down, true}});
    return out_.size();
  }

  const Design& design_;
  RandomStream random_;
  std::uint32_t number_;
  double released_;
  double drop_;
  std::vector<Passage>& out_;
  double diameter_ = 0.0;
};

void spoil(const Design& design, std::vector<Passage>& passages, Stream& result) {
  RandomStream random(design.seed, RandomPurpose::coverage, 0);
  const std::size_t honest = passages.size();
  for (std::size_t i = 0; i < honest; ++i) {
    if (random.uniform() < design.damaged) {
      const char* const damage[] = {"nan,", "", "#,#,#,#", "12.5,0.4", "1,2,3,4,5,6"};
      passages[i].text = damage[random.below(5)];
      if (passages[i].text.empty()) passages[i].text = "0.1,,0,49";
      passages[i].row.usable = false;
      ++result.damaged;
    } else if (random.uniform() < design.duplicated) {
      Passage again = passages[i];
      again.row.usable = false;
      passages.push_back(std::move(again));
      ++result.duplicated;
    }
  }
  for (std::size_t i = 0; i < passages.size(); ++i) {
    if (random.uniform() < design.displaced) passages[i].time += 0.3 * random.uniform();
  }
}

}  // namespace

Stream simulate(const Design& design) {
  Stream result;
  std::vector<Passage> passages;
  RandomStream arrivals(design.seed, RandomPurpose::bootstrap, 0);
  double now = 1.0;
  double flights = 0.0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < design.spheres; ++i) {
    now -= std::log(arrivals.uniform()) / design.rate;
    const std::size_t height = i * design.drop_heights.size() / design.spheres;
    Sphere sphere(design, static_cast<std::uint32_t>(i), now, design.drop_heights[height],
                  passages);
    const double flight = sphere.fly();
    if (flight > 0.0) {
      flights += flight;
      ++counted;
    }
  }
  result.crowding = counted > 0 ? design.rate * flights / static_cast<double>(counted) : 0.0;
  spoil(design, passages, result);
  std::stable_sort(passages.begin(), passages.end(),
                   [](const Passage& a, const Passage& b) { return a.time < b.time; });
  result.csv = "time,velocity,tangential_velocity,diameter\n";
  result.rows.resize(2);
  result.fate.resize(2, Fate::captured);
  for (const Passage& passage : passages) {
    result.csv += passage.text;
    result.csv += '\n';
    result.rows.push_back(passage.row);
    result.fate.push_back(passage.fate);
  }
  return result;
}

}  // namespace stream
