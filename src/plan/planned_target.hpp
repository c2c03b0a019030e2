#pragma once

#include <optional>
#include <vector>

#include "diagnosis/other_target.hpp"
#include "plan/possible_causes.hpp"

namespace recoil {

/// The plan and, on top of it, impacts of the same spheres on another target, at the places of
/// `places_elsewhere`, as often at each. What damps and holds them there is known as little as
/// `carried_elsewhere` says.
class PlannedTarget {
 public:
  /// @param causes whose effects on both targets are compared
  PlannedTarget(const FitSpec& spec, const ExperimentPlan& plan,
                const std::vector<PossibleCause>& causes, const TargetMaterial& material);

  /// Impacts for expected odds of 99 to 1 for a cause against another one, by their places; whole
  /// points at every place. None where `most_more_impacts` would not do.
  /// @param rival none: against the base model
  std::optional<int> impacts_for(std::size_t cause, std::optional<std::size_t> rival) const;

  /// What to do, with so many impacts.
  PlanRemedy remedy(int impacts) const;

 private:
  double log_odds(std::size_t cause, std::optional<std::size_t> rival, int points) const;

  double law_error_;
  int events_;
  std::size_t like_;
  TargetMaterial material_;
  std::vector<PointConditions> places_;
  PlanGround ground_;                  ///< the settings of the plan, then one point at each place
  std::vector<PossibleCause> causes_;  ///< there
};

}  // namespace recoil
