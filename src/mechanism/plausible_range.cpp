#include "mechanism/plausible_range.hpp"

#include <algorithm>
#include <limits>

namespace recoil {
namespace {

/// Where `rises`, false at `lower` and true at `upper`, changes: halving down to neighbouring
/// numbers, in a range that may span eighteen decades.
template <class Rises>
double change(const Rises& rises, double lower, double upper) {
  constexpr int halvings = 1100;  // more than the exponents of double have
  for (int i = 0; i < halvings; ++i) {
    const double middle = lower + 0.5 * (upper - lower);
    if (middle <= lower || middle >= upper) break;
    (rises(middle) ? upper : lower) = middle;
  }
  return upper;
}

/// The largest value of the limit's quantity.
double largest_of(const PlausibleLimit& limit, std::span<const double> own,
                  std::span<const Encounter<double>> spheres) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Encounter<double>& sphere : spheres)
    largest = std::max(largest, limit.of(sphere, own));
  return largest;
}

}  // namespace

Encounter<double> plain_sphere(const Surroundings& at, double diameter, double velocity,
                               std::size_t series) {
  Encounter<double> e{};
  e.at = &at;
  e.series = series;
  e.take_materials();
  e.measured_velocity = velocity;
  e.diameter = diameter;
  e.contact_radius = e.radius();
  e.velocity = velocity;
  return e;
}

AllowedValues allowed_values(const Parameter& parameter, std::size_t k, std::span<const double> own,
                             std::span<const Encounter<double>> spheres) {
  AllowedValues allowed{parameter.plausible.lower, parameter.plausible.upper};
  const PlausibleLimit& limit = parameter.limit;
  if (limit.of == nullptr || spheres.empty()) return allowed;
  std::vector<double> values(own.begin(), own.end());
  const auto quantity = [&](double value) {
    values[k] = value;
    return largest_of(limit, values, spheres);
  };
  allowed.quantity = quantity(own[k]);
  const double lower = allowed.lower;
  const double upper = allowed.upper;
  if (quantity(upper) > limit.upper) {
    allowed.upper_by_limit = true;
    allowed.upper = change([&](double v) { return quantity(v) > limit.upper; }, lower, upper);
  }
  if (quantity(lower) < limit.lower) {
    allowed.lower_by_limit = true;
    allowed.lower =
        quantity(upper) < limit.lower
            ? upper
            : change([&](double v) { return quantity(v) >= limit.lower; }, lower, upper);
    allowed.lower = std::min(allowed.lower, allowed.upper);
  }
  return allowed;
}

}  // namespace recoil
