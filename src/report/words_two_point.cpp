#include "report/words_two_point.hpp"

#include <fmt/format.h>

namespace recoil {
namespace {

std::string point_words(const MeasuredPoint& point) {
  return fmt::format("e = {:.4g} at V = {:.4g} m/s", point.restitution, point.velocity);
}

}  // namespace

std::string two_point_words(const FitResult& fitted, std::size_t dataset,
                            const TwoPointResult& result) {
  if (result.status == TwoPointStatus::too_few_points) {
    return "the diameter has fewer than two velocities at which spheres rebounded";
  }
  const ImpactModel& model = fitted.model;
  const std::string low = point_words(fitted.data.points[result.low_point]);
  const std::string high = point_words(fitted.data.points[result.high_point]);
  const double C_H = result.theta[model.slot_C_H[dataset]];
  const double C_A = result.theta[model.slot_C_A[dataset]];
  switch (result.status) {
    case TwoPointStatus::no_hertz_damping:
      return fmt::format(
          "no C_H >= 0 gives {}: the adhesion that the lowest velocity requires (C_A = {:.4g} s/m) "
          "already costs more there",
          high, C_A);
    case TwoPointStatus::no_adhesion_damping:
      return fmt::format("no C_A in [0, {:.4g}] s/m gives {} with C_H = {:.4g} s/m",
                         model.slots[model.slot_C_A[dataset]].upper, low, C_H);
    case TwoPointStatus::converged:
      return fmt::format("from {} and {}", low, high);
    case TwoPointStatus::not_converging:
      return fmt::format("C_H and C_A still change after {} iterations on {} and {}",
                         result.iterations, low, high);
    case TwoPointStatus::too_few_points:
      break;
  }
  return "";
}

}  // namespace recoil
