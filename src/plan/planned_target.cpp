#include "plan/planned_target.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/elsewhere.hpp"
#include "diagnosis/odds.hpp"
#include "estimate/predictor.hpp"
#include "plan/comparison.hpp"

namespace recoil {
namespace {

/// The model of the plan on the new target too, with all that it has to determine there.
Elsewhere planned_elsewhere(const FitSpec& spec, const ExperimentPlan& plan, const Dataset& target,
                            std::size_t like) {
  Candidate here;
  here.spec = spec;
  here.model = plan.model;
  std::vector<bool> moving;
  for (const ParameterSlot& slot : plan.model.slots) moving.push_back(slot.moves());
  Elsewhere there = carried_elsewhere(spec, plan.datasets, target, like, here, plan.theta, moving);
  for (std::size_t j = 0; j < there.moving.size(); ++j) {
    ParameterSlot& slot = there.candidate.model.slots[j];
    slot.free = there.moving[j] && !slot.is_constant();
  }
  return there;
}

/// `effect` with `points` points in the place of one at each place after the settings.
void repeat(Effect& effect, Eigen::Index settings, int points) {
  const Eigen::Index places = effect.change.size() - settings;
  effect.change.tail(places) *= std::sqrt(points);
  if (effect.released.cols() > 0) effect.released.bottomRows(places) *= std::sqrt(points);
}

PossibleCause repeated(PossibleCause cause, Eigen::Index settings, int points) {
  repeat(cause.typical, settings, points);
  for (Effect& other : cause.others) repeat(other, settings, points);
  return cause;
}

}  // namespace

PlannedTarget::PlannedTarget(const FitSpec& spec, const ExperimentPlan& plan,
                             const std::vector<PossibleCause>& causes,
                             const TargetMaterial& material)
    : law_error_(spec.law_error),
      events_(plan.options.events),
      like_(fullest(plan.datasets)),
      material_(material) {
  const Dataset target = on_target(plan.datasets[like_], material);
  const Elsewhere elsewhere = planned_elsewhere(spec, plan, target, like_);
  ExperimentPlan there = plan;
  there.datasets.push_back(target);
  there.model = elsewhere.candidate.model;
  there.theta = elsewhere.theta;
  const auto expected = [&](const std::vector<PointConditions>& at) {
    std::vector<double> found;
    for (const Prediction& answer : predict(there.model, there.theta, at, false)) {
      found.push_back(answer.usable() ? answer.restitution() : 0.0);
    }
    return found;
  };
  places_ = places_elsewhere(plan.datasets[like_], elsewhere.dataset, plan.options.slowest,
                             plan.options.fastest, expected);
  if (places_.empty()) return;
  std::vector<PointConditions> at = settings_of(plan);
  for (const PointConditions& place : places_) {
    at.push_back(place);
    there.settings.push_back({place.dataset, place.diameter, place.velocity, 1});
  }
  const PlannedParameters parameters = planned_parameters(there.model, there.theta);
  ground_ = ground_at(spec, there, parameters, std::move(at));
  for (std::size_t k = 0; k < parameters.slots.size(); ++k) {
    const auto slot = static_cast<Eigen::Index>(parameters.slots[k]);
    ground_.known(static_cast<Eigen::Index>(k)) +=
        elsewhere.precisions(slot) * parameters.unit[k] * parameters.unit[k];
  }
  for (const PossibleCause& cause : causes) {
    causes_.push_back(carried_to(cause, elsewhere.candidate.spec, there, ground_));
  }
}

double PlannedTarget::log_odds(std::size_t cause, std::optional<std::size_t> rival,
                               int points) const {
  const auto places = static_cast<Eigen::Index>(places_.size());
  const Eigen::Index settings = ground_.settings - places;
  PlanGround ground = ground_;
  ground.slopes.bottomRows(places) *= std::sqrt(points);
  ground.errors.bottomRows(places) *= std::sqrt(points);
  const PossibleCause truth = repeated(causes_[cause], settings, points);
  if (rival) {
    const PossibleCause other = repeated(causes_[*rival], settings, points);
    const auto closest = closest_comparison(ground, law_error_, truth, other);
    if (closest) return closest->log_odds();
  }
  return Comparison(ground, law_error_, truth.typical, nullptr, 0.0, 0.0).log_odds();
}

std::optional<int> PlannedTarget::impacts_for(std::size_t cause,
                                              std::optional<std::size_t> rival) const {
  if (places_.empty()) return std::nullopt;
  const int of_one = events_ * static_cast<int>(places_.size());
  const auto enough = [&](int points) { return log_odds(cause, rival, points) >= wanted_log_odds; };
  int many = most_more_impacts / of_one;
  if (many < 1 || !enough(many)) return std::nullopt;
  int few = 0;
  while (many - few > 1) {
    const int middle = few + (many - few) / 2;
    (enough(middle) ? many : few) = middle;
  }
  return many * of_one;
}

PlanRemedy PlannedTarget::remedy(int impacts) const {
  PlanRemedy remedy;
  remedy.kind = ExperimentKind::target;
  remedy.dataset = like_;
  remedy.diameter = places_.front().diameter;
  remedy.velocity = places_.front().velocity;
  remedy.impacts = impacts;
  remedy.material = material_;
  for (const PointConditions& place : places_) {
    const int events = impacts / static_cast<int>(places_.size());
    remedy.places.push_back({place.diameter, place.velocity, events});
  }
  return remedy;
}

}  // namespace recoil
