#include "plan/planned_causes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "core/progress.hpp"
#include "diagnosis/candidate.hpp"
#include "diagnosis/elsewhere.hpp"
#include "diagnosis/next_experiments.hpp"
#include "plan/comparison.hpp"
#include "plan/planned_target.hpp"
#include "plan/possible_causes.hpp"

namespace recoil {
namespace {

constexpr double worth_sharing = 3.0;  // times the least effort, for a step that does more

/// More impacts: at a place, under a condition that takes something away or as they are (null), or
/// on another target.
struct Option {
  std::optional<std::size_t> target;  ///< of those that are examined
  const TakenAway* away = nullptr;
  std::size_t place = 0;

  bool operator<(const Option& other) const {
    return std::tie(target, away, place) < std::tie(other.target, other.away, other.place);
  }
};
using Options = std::map<Option, int>;  ///< and how many

class Causes {
 public:
  Causes(const FitSpec& spec, const ExperimentPlan& plan)
      : plan_(plan), law_error_(spec.law_error), ground_(ground_of(spec, plan)) {
    for (const Mechanism* mechanism : mechanisms_that_may_act(spec, plan.model)) {
      if (mechanism->info.kind == MechanismKind::description || mechanism->is_batch()) continue;
      if (mechanism->spreads() && plan.options.spread > 0.0) continue;
      if (auto cause = possible_cause(spec, plan, ground_, *mechanism)) {
        all_.push_back(std::move(*cause));
      }
    }
    for (const TargetMaterial& material : other_targets(plan.datasets[fullest(plan.datasets)])) {
      targets_.emplace_back(spec, plan, all_, material);
    }
  }

  PlannedCauses examined() {
    PlannedCauses found;
    Progress progress("causes told apart", all_.size());
    for (const PossibleCause& cause : all_) {
      found.causes.push_back(examine(cause));
      progress.advance();
    }
    std::stable_sort(
        found.causes.begin(), found.causes.end(),
        [](const PlannedCause& a, const PlannedCause& b) { return a.log_odds > b.log_odds; });
    choose_steps(found);
    return found;
  }

 private:
  static bool one_cause(const PossibleCause& a, const PossibleCause& b) {
    const std::string_view cause = a.mechanism->info.cause;
    return a.mechanism == b.mechanism || (!cause.empty() && cause == b.mechanism->info.cause);
  }

  PlannedCause examine(const PossibleCause& cause) {
    PlannedCause found;
    found.id = cause.mechanism->info.id;
    found.kind = cause.mechanism->info.kind;
    found.parameter = cause.parameter->name;
    found.unit = cause.parameter->unit;
    found.strength = cause.typical.strength;
    found.lower = cause.lower;
    found.upper = cause.upper;
    found.stated = cause.stated;
    found.change = cause.typical.largest;
    const Comparison with_base(ground_, law_error_, cause.typical, nullptr, 0.0, 0.0);
    found.log_odds = with_base.log_odds();
    if (!cause.parameter->log_scale && !cause.stated && found.log_odds > 0.0) {
      const double null = cause.parameter->null_value;
      found.seen_from =
          null + (found.strength - null) * std::sqrt(wanted_log_odds / found.log_odds);
    }
    if (!found.seen()) found.remedy = remedy(with_base, cause, nullptr);
    for (const PossibleCause& rival : all_) {
      if (one_cause(cause, rival)) continue;
      ++found.rivals;
      if (!found.seen()) continue;
      const auto closest = closest_comparison(ground_, law_error_, cause, rival);
      if (!closest || closest->log_odds() >= wanted_log_odds) continue;
      found.confused.push_back({std::string(rival.mechanism->info.id), closest->log_odds(),
                                remedy(*closest, cause, &rival)});
    }
    return found;
  }

  static bool goes(const PossibleCause& cause, Condition condition) {
    const auto& away = cause.mechanism->info.taken_away;
    return away && away->condition == condition;
  }

  /// Whole points.
  int whole(int impacts) const {
    const int events = plan_.options.events;
    return (impacts + events - 1) / events * events;
  }

  static int effort(const Option& option, int impacts) {
    if (option.target) return impacts + effort_of_a_target;
    return impacts + (option.away != nullptr ? effort_of_a_change : 0);
  }

  /// The impacts of everything that would tell `rival` (none: the base model) from `cause`.
  Options options_for(const Comparison& comparison, const PossibleCause& cause,
                      const PossibleCause* rival) const {
    Options found;
    const auto look = [&](bool no_truth, bool no_rival, const TakenAway* away) {
      for (std::size_t i = 0; i < ground_.at.size(); ++i) {
        const auto impacts =
            comparison.impacts_for(static_cast<Eigen::Index>(i), no_truth, no_rival);
        if (impacts) found[{std::nullopt, away, i}] = whole(*impacts);
      }
    };
    look(false, false, nullptr);
    for (const PossibleCause* one : {&cause, rival}) {
      if (one == nullptr || !one->mechanism->info.taken_away) continue;
      const TakenAway& away = *one->mechanism->info.taken_away;
      const bool no_truth = goes(cause, away.condition);
      const bool no_rival = rival != nullptr && goes(*rival, away.condition);
      if (!(no_truth && no_rival)) look(no_truth, no_rival, &away);
    }
    if (!found.empty() && least_effort(found) <= effort_of_a_target) return found;
    const auto place_of = [&](const PossibleCause& one) {
      return static_cast<std::size_t>(&one - all_.data());
    };
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      const auto other = rival != nullptr ? std::optional(place_of(*rival)) : std::nullopt;
      const auto impacts = targets_[t].impacts_for(place_of(cause), other);
      if (impacts) found[{t}] = *impacts;
    }
    return found;
  }

  PlanRemedy remedy_of(const Option& option, int impacts) const {
    if (option.target) return targets_[*option.target].remedy(impacts);
    const auto& [target, away, place] = option;
    PlanRemedy remedy;
    remedy.dataset = ground_.at[place].dataset;
    remedy.diameter = ground_.at[place].diameter;
    remedy.velocity = ground_.at[place].velocity;
    remedy.impacts = impacts;
    if (away == nullptr) return remedy;
    remedy.kind = ExperimentKind::condition;
    remedy.condition = away->condition;
    remedy.value = away->value;
    remedy.doing = away->doing;
    return remedy;
  }

  static int least_effort(const Options& options) {
    int least = std::numeric_limits<int>::max();
    for (const auto& [option, impacts] : options) {
      least = std::min(least, effort(option, impacts));
    }
    return least;
  }

  /// The cheapest; it is remembered what else would do, for either of the two as the truth.
  std::optional<PlanRemedy> remedy(const Comparison& comparison, const PossibleCause& cause,
                                   const PossibleCause* rival) {
    const Options options = options_for(comparison, cause, rival);
    const std::string one(cause.mechanism->info.id);
    const std::string other(rival != nullptr ? rival->mechanism->info.id : "");
    const CausePair pair =
        other.empty() || one < other ? CausePair(one, other) : CausePair(other, one);
    const auto [needed, added] = needs_.try_emplace(pair, options);
    if (!added) {
      Options both;
      for (const auto& [option, impacts] : needed->second) {
        const auto also = options.find(option);
        if (also != options.end()) both[option] = std::max(impacts, also->second);
      }
      needed->second = std::move(both);
    }
    const int least = least_effort(options);
    for (const auto& [option, impacts] : options) {
      if (effort(option, impacts) == least) return remedy_of(option, impacts);
    }
    return std::nullopt;
  }

  void choose_steps(PlannedCauses& found) const {
    std::map<CausePair, Options> left = needs_;
    std::map<CausePair, int> least;
    for (const auto& [pair, options] : needs_) {
      if (options.empty()) found.beyond.push_back(pair);
      least[pair] = least_effort(options);
    }
    std::erase_if(left, [](const auto& need) { return need.second.empty(); });
    while (!left.empty()) {
      std::map<Option, PlanStep> steps;
      for (const auto& [pair, options] : left) {
        for (const auto& [option, impacts] : options) {
          if (effort(option, impacts) > worth_sharing * least[pair]) continue;
          PlanStep& step = steps[option];
          step.tells.push_back(pair);
          step.remedy = remedy_of(option, std::max(step.remedy.impacts, impacts));
        }
      }
      const auto best =
          std::max_element(steps.begin(), steps.end(), [&](const auto& a, const auto& b) {
            if (a.second.tells.size() != b.second.tells.size()) {
              return a.second.tells.size() < b.second.tells.size();
            }
            return effort(a.first, a.second.remedy.impacts) >
                   effort(b.first, b.second.remedy.impacts);
          });
      for (const CausePair& pair : best->second.tells) left.erase(pair);
      found.steps.push_back(best->second);
    }
  }

  const ExperimentPlan& plan_;
  double law_error_;
  PlanGround ground_;
  std::vector<PossibleCause> all_;
  std::vector<PlannedTarget> targets_;
  std::map<CausePair, Options> needs_;  // what the plan lacks
};

}  // namespace

PlannedCauses planned_causes(const FitSpec& spec, const ExperimentPlan& plan) {
  return Causes(spec, plan).examined();
}

}  // namespace recoil
