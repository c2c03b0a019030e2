#include "uncertainty/two_point_comparison.hpp"

namespace recoil {
namespace {

/// Points of `data` that belong to `dataset`, split by whether their diameter is `diameter`.
struct Split {
  std::vector<std::size_t> all, seen, unseen;
};
Split split_by_diameter(const Observations& data, std::size_t dataset, double diameter) {
  Split split;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    if (data.points[i].dataset != dataset) continue;
    split.all.push_back(i);
    (data.points[i].diameter == diameter ? split.seen : split.unseen).push_back(i);
  }
  return split;
}

}  // namespace

TwoPointComparison compare_two_point(const FitResult& fitted, std::size_t dataset) {
  const Observations& data = fitted.data;
  TwoPointComparison comparison;
  comparison.dataset = dataset;
  const double diameter = fitted.model.contacts[dataset].reference_diameter;
  comparison.result = two_point(fitted.model, data, dataset, diameter);
  const Split split = split_by_diameter(data, dataset, comparison.result.diameter);
  comparison.full_rmse = root_mean_square(fitted.model, fitted.theta, data, split.all);
  const bool answered = comparison.result.status != TwoPointStatus::too_few_points;
  if (answered) {
    comparison.rmse = root_mean_square(fitted.model, comparison.result.theta, data, split.all);
  }
  if (split.unseen.empty()) {
    comparison.nothing_held_out = NothingHeldOut::single_diameter;
    return comparison;
  }
  if (answered) {
    comparison.held_out_rmse =
        root_mean_square(fitted.model, comparison.result.theta, data, split.unseen);
  }
  Observations seen = data;
  seen.points.clear();
  for (const std::size_t i : split.seen) seen.points.push_back(data.points[i]);
  // Parameters of other datasets stay out of this: only what this diameter can tell is refitted.
  ImpactModel alone = fitted.model;
  for (std::size_t j = 0; j < alone.slots.size(); ++j) {
    const bool used = j == alone.slot_C_H[dataset] || j == alone.slot_C_A[dataset] ||
                      j == alone.slot_adhesion[dataset];
    alone.slots[j].free = alone.slots[j].free && used;
  }
  const FitResult on_one = fit(alone, seen);
  if (on_one.usable) {
    comparison.full_held_out_rmse =
        root_mean_square(fitted.model, on_one.theta, data, split.unseen);
  } else {
    comparison.nothing_held_out = NothingHeldOut::refit_failed;
    comparison.refit_failure = on_one.failure;
  }
  return comparison;
}

}  // namespace recoil
