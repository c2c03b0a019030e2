#include "uncertainty/profile_end.hpp"

#include <algorithm>
#include <cmath>

namespace recoil {
namespace {

constexpr int most_evaluations = 120;
// Relative tolerance of the rise at the last evaluation before an interval's end. A secant from
// there leaves less than 1e-6 of the distance from the estimate.
constexpr double end_tolerance = 1e-4;
// Two values are close at this part of the distance from the estimate, or of the first step.
constexpr double close_by = 1e-6;

}  // namespace

std::optional<ProfileEnd> find_profile_end(const ProfileWalk& walk, double estimate, double bound,
                                           double stride,
                                           const std::function<double(double)>& allowed) {
  if (estimate == bound) return ProfileEnd{bound, true};
  // sqrt(rise) is nearly linear in the parameter, so regula falsi (Illinois) converges quickly. It
  // is written here because every evaluation is a fit that may fail or end in a worse minimum, and
  // convergence is judged by the rise, not by the position.
  const auto excess = [&](double rise, double value) {
    return std::sqrt(std::max(rise, 0.0)) - std::sqrt(allowed(value));
  };
  const double shortest = close_by * stride;
  const double direction = bound < estimate ? -1.0 : 1.0;
  double inside = estimate;
  double f_in = excess(0.0, inside);
  std::optional<double> outside;
  double f_out = 0.0;
  double part = 1.0;       // of a step, after failures
  double before = inside;  // the last evaluation
  double f_before = f_in;
  for (int i = 0; i < most_evaluations; ++i) {
    // `outside` may be excluded only by a worse minimum: ask again from close by.
    const bool again = outside && std::abs(*outside - inside) <=
                                      std::max(shortest, close_by * std::abs(inside - estimate));
    double next = again     ? *outside
                  : outside ? *outside - f_out * (*outside - inside) / (f_out - f_in)
                            : inside + direction * stride;
    if (direction * (next - bound) > 0.0) next = bound;
    if (part < 1.0) {
      next = inside + part * (next - inside);
      if (std::abs(next - inside) <= shortest) break;
    }
    const auto rise = walk.rise(next);
    if (!rise) {
      part *= 0.5;
      continue;
    }
    part = std::min(1.0, 2.0 * part);
    const double wanted = allowed(next);
    const double f = excess(*rise, next);
    if (outside && std::abs(*rise - wanted) <= end_tolerance * wanted) {
      const double slope = (f - f_before) / (next - before);
      const double end =
          slope * direction > 0.0
              ? std::clamp(next - f / slope, std::min(inside, *outside), std::max(inside, *outside))
              : next;
      if (std::abs(end - estimate) <= shortest) break;
      return ProfileEnd{end, false};
    }
    before = next;
    f_before = f;
    if (f > 0.0) {
      if (again && inside != estimate) return ProfileEnd{inside, false};
      if (again) break;
      if (outside) f_in *= 0.5;
      outside = next;
      f_out = f;
      continue;
    }
    if (next == bound) return ProfileEnd{bound, true};
    walk.keep();
    inside = next;
    f_in = f;
    if (again) {
      outside.reset();
    } else if (outside) {
      f_out *= 0.5;
    } else {
      stride *= 1.6;
    }
  }
  return std::nullopt;
}

}  // namespace recoil
