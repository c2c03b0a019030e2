#include "report/words_two_point.hpp"

namespace recoil {
namespace {

Sentence point_words(const MeasuredPoint& point) {
  return say("{e} = {:.4g} at {V} = {:.4g} m/s", point.restitution, point.velocity);
}

}  // namespace

Sentence two_point_words(const FitResult& fitted, std::size_t dataset,
                         const TwoPointResult& result) {
  if (result.status == TwoPointStatus::too_few_points) {
    return "the diameter has fewer than two velocities at which spheres rebounded";
  }
  const ImpactModel& model = fitted.model;
  const Sentence low = point_words(fitted.data.points[result.low_point]);
  const Sentence high = point_words(fitted.data.points[result.high_point]);
  const double C_H = result.theta[model.slot_C_H[dataset]];
  const double C_A = result.theta[model.slot_C_A[dataset]];
  switch (result.status) {
    case TwoPointStatus::no_hertz_damping:
      return say(
          "no {C_H} >= 0 gives {}: the adhesion that the lowest velocity requires ({C_A} = {:.4g} "
          "s/m) already costs more there",
          high, C_A);
    case TwoPointStatus::no_adhesion_damping:
      return say("no {C_A} in [0, {:.4g}] s/m gives {} with {C_H} = {:.4g} s/m",
                 model.slots[model.slot_C_A[dataset]].upper, low, C_H);
    case TwoPointStatus::converged:
      return say("from {} and {}", low, high);
    case TwoPointStatus::not_converging:
      return say("{C_H} and {C_A} still change after {} iterations on {} and {}", result.iterations,
                 low, high);
    case TwoPointStatus::too_few_points:
      break;
  }
  return {};
}

}  // namespace recoil
