#include "estimate/instant_errors.hpp"

#include <algorithm>
#include <cmath>

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
    const double back = 1.0 / point.restitution;
    const double length = std::sqrt(1.0 + (1.0 + back) * (1.0 + back) + back * back);
    constexpr std::size_t most_bounces = std::size_t{1} << 32;
    const std::size_t first = point.launch * most_bounces + point.bounce;
    return {{first, 1.0 / length}, {first + 1, -(1.0 + back) / length}, {first + 2, back / length}};
  }
  bool is_scatter() const override { return true; }
};

}  // namespace

const ErrorSource& instant_error() {
  static const InstantError source;
  return source;
}

}  // namespace recoil
