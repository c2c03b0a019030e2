#include <algorithm>
#include <cmath>

#include "estimate/error_source.hpp"
#include "estimate/observations.hpp"

namespace recoil {
namespace {

/// The errors of the instants t at which successive bounces of a launch were timed. In
///   e_k = (t_(k+2) - t_(k+1)) / (t_(k+1) - t_k)
/// the errors of t_k, t_(k+1) and t_(k+2), independent and of equal size, have coefficients in the
/// ratio 1 : -(1 + 1/e_k) : 1/e_k. They are the whole scatter of e_k, whose standard deviation is
/// stated. Their effect on V is neglected: V de/dV is small compared with e for a ball.
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
