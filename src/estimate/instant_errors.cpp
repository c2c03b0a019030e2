#include "estimate/instant_errors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "estimate/observations.hpp"

namespace recoil {
namespace {

class InstantError : public ErrorSource {
 public:
  InstantError() : ErrorSource({"scatter", "launch", "scatter of the points"}, SharedBy::launch) {}

  bool acts(const Observations& data) const override {
    return std::any_of(data.points.begin(), data.points.end(), [](const Observation& point) {
      return point.launch != Observation::no_launch;
    });
  }
  double effect(const Observation& point, const Local& at, const Noise&) const override {
    return 2.0 * std::sqrt(std::max(at.value, 0.0)) * point.sd;
  }
  std::vector<ErrorPart> parts(const Observation& point) const override {
    if (point.launch == Observation::no_launch) return {};
    const std::array<double, 3> part = instant_coefficients(point.restitution);
    constexpr std::uint64_t most_bounces = std::uint64_t{1} << 32;
    const std::uint64_t first = point.launch * most_bounces + point.bounce;
    return {{first, part[0]}, {first + 1, part[1]}, {first + 2, part[2]}};
  }
  bool is_scatter() const override { return true; }
};

}  // namespace

const ErrorSource& instant_error() {
  static const InstantError source;
  return source;
}

std::array<double, 3> instant_coefficients(double restitution) {
  const double back = 1.0 / restitution;
  const double length = std::sqrt(1.0 + (1.0 + back) * (1.0 + back) + back * back);
  return {1.0 / length, -(1.0 + back) / length, back / length};
}

std::vector<LinkedBounce> linked_bounces(const Dataset& dataset) {
  constexpr double drag = 0.02;  // a relative loss of speed in flight that is never a missed bounce
  std::vector<LinkedBounce> found(dataset.points.size());
  std::map<std::pair<std::size_t, std::string_view>, std::size_t> last;  // point of each launch
  std::size_t runs = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const ImpactPoint& p = dataset.points[k];
    if (p.launch.empty() || !p.restitution_sd || !(p.restitution > 0.0)) continue;
    const auto [before, is_first] = last.try_emplace({p.series, p.launch}, k);
    const std::size_t from = std::exchange(before->second, k);
    if (is_first) continue;
    const ImpactPoint& previous = dataset.points[from];
    const double change =
        std::log(p.incident_velocity / (previous.restitution * previous.incident_velocity));
    // The loss of a missed bounce is near ln e.
    const double loss = std::max(drag, -0.5 * std::log(p.restitution));
    if (change > drag || change < -loss) continue;
    if (found[from].launch == Observation::no_launch) found[from].launch = runs++;
    found[k] = {found[from].launch, found[from].bounce + 1};
  }
  return found;
}

}  // namespace recoil
