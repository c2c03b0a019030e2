#include "validation/synthetic/event_stream.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "validation/truth/falling_sphere.hpp"

namespace stream {
namespace {

using recoil::RandomPurpose;
using recoil::RandomStream;

constexpr double g = recoil::standard_gravity;

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
/// @returns the time from the passage down to the one up of the first impact; 0 without one.
double drop_sphere(const Design& design, std::uint32_t number, double released, double drop,
                   std::vector<Passage>& out) {
  RandomStream random(design.seed, RandomPurpose::reconstruction, number);
  double diameter = 0.0;
  do {
    diameter = design.median * std::exp(design.log_sd * random.normal());
  } while (diameter < design.smallest || diameter > design.largest);
  const double capture =
      design.capture_at_20um * std::pow(diameter / 20e-6, -design.capture_exponent);
  const auto restitution = [&](double speed) {
    const double scatter = 1.0 + design.restitution_sd * random.normal();
    if (speed <= capture) return 0.0;
    const double ratio = capture / speed;
    return std::min(1.0, design.top_restitution * std::sqrt(1.0 - ratio * ratio) * scatter);
  };
  const auto time_from_plane = [&](double speed) {
    return (speed - std::sqrt(speed * speed - 2.0 * g * design.probe_height)) / g;
  };
  double first_flight = 0.0;
  const auto visit = [&](const recoil::FallenImpact& impact) {
    Fate fate = impact.rebound > 0.0 ? Fate::too_slow : Fate::captured;
    if (impact.climbs) fate = impact.up ? Fate::rebound_seen : Fate::rebound_unseen;
    if (impact.climbs && impact.number == 1) {
      first_flight = time_from_plane(impact.speed) + time_from_plane(impact.rebound);
    }
    for (const auto& seen : {impact.down, impact.up}) {
      if (!seen) continue;
      const double time = std::round(seen->time / design.clock) * design.clock;
      const bool down = seen->velocity > 0.0;
      out.push_back({time,
                     fmt::format("{:.6f},{:.5f},{:.5f},{:.3f}", time, seen->velocity,
                                 seen->tangential, seen->diameter * 1e6),
                     {number, impact.number, down, true},
                     down ? fate : Fate::captured});
    }
  };
  const recoil::Instrument instrument = {design.probe_height,
                                         design.probe_height + 4.0 * design.volume_sd,
                                         design.volume_sd,
                                         design.velocity_sd,
                                         design.diameter_noise * diameter_sd(diameter),
                                         design.angle_sd,
                                         design.seen,
                                         design.seen * design.rebound_seen,
                                         design.return_time};
  const double speed = std::sqrt(2.0 * g * drop);
  recoil::follow_sphere(instrument, diameter, released + speed / g, speed, random, restitution,
                        visit);
  return first_flight;
}

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
    const double flight = drop_sphere(design, static_cast<std::uint32_t>(i), now,
                                      design.drop_heights[height], passages);
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
