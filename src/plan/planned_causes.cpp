#include "plan/planned_causes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "diagnosis/candidate.hpp"
#include "diagnosis/next_experiments.hpp"
#include "plan/possible_causes.hpp"

namespace recoil {
namespace {

constexpr double unknown_precision = 1e-10;  // of a free parameter, in the points' own
constexpr double most_more_impacts = 1e4;
constexpr double worth_sharing = 3.0;  // times the least effort, for a step that does more
constexpr int rounds_of_amplitude = 3;

/// What is true, seen by one who takes the effect `rival` for it; null: by the base model.
class Comparison {
 public:
  Comparison(const PlanGround& ground, double law_error, const Effect& truth, const Effect* rival,
             double least, double most)
      : ground_(ground), law_error_(law_error), truth_(truth), rival_(rival) {
    if (rival != nullptr) k_ = std::clamp(amplitude(ground, truth, *rival), least, most);
    lay_out();
    for (int round = 0; rival != nullptr && round < rounds_of_amplitude; ++round) {
      const Eigen::VectorXd z = rival->change.head(ground.settings);
      const double zz = product(z, z);
      if (!(zz > 0.0)) break;
      const double next =
          std::clamp(product(truth_.change.head(ground.settings), z) / zz, least, most);
      if (std::abs(next - k_) < 1e-3 * std::abs(next)) break;
      k_ = next;
      lay_out();
    }
    const Eigen::VectorXd y = left();
    chi2_ = std::max(0.0, product(y, y));
    found_ = factor_.solve(columns_.topRows(ground.settings).transpose() * y);
  }

  double log_odds() const { return 0.5 * chi2_; }

  /// Impacts at place `i` for expected odds of 99 to 1, where a condition may have taken away the
  /// truth or the rival.
  std::optional<int> impacts_for(Eigen::Index i, bool no_truth, bool no_rival) const {
    Eigen::VectorXd row = columns_.row(i).transpose();
    double y = 0.0;
    if (!no_truth) y += truth_.change(i);
    if (!no_rival && rival_ != nullptr) y -= k_ * rival_->change(i);
    if (no_truth) row.segment(of_truth_, functions()).setZero();
    if (no_rival && rival_ != nullptr) row.tail(row.size() - of_rival_).setZero();
    row *= ground_.once(i);
    const double apart = ground_.once(i) * y - row.dot(found_);
    const double spread = row.dot(factor_.solve(row));
    const double lacking = 2.0 * planned_log_odds - chi2_;
    const double room = apart * apart / lacking - spread;  // for 1 / n
    if (!(room * most_more_impacts > 1.0)) return std::nullopt;
    return std::max(1, static_cast<int>(std::ceil(1.0 / room)));
  }

 private:
  Eigen::Index functions() const { return ground_.functions.cols(); }

  /// Everything that could make up for the effect: parameters, errors of the laws.
  void lay_out() {
    const Eigen::Index p = ground_.slopes.cols();
    const Eigen::Index r = functions();
    const Eigen::Index released = rival_ != nullptr ? rival_->released.cols() : 0;
    of_truth_ = p + r;
    of_rival_ = p + 2 * r;
    columns_.resize(ground_.slopes.rows(), of_rival_ + (rival_ != nullptr ? r + released : 0));
    columns_.leftCols(p) = ground_.slopes;
    columns_.middleCols(p, r) = ground_.errors;
    columns_.middleCols(of_truth_, r) =
        (law_error_ * truth_.change).asDiagonal() * ground_.functions;
    if (rival_ != nullptr) {
      columns_.middleCols(of_rival_, r) =
          (law_error_ * k_ * rival_->change).asDiagonal() * ground_.functions;
      columns_.rightCols(released) = k_ * rival_->released;
    }
    const auto made = columns_.topRows(ground_.settings);
    Eigen::MatrixXd information = made.transpose() * made;
    for (Eigen::Index j = 0; j < information.rows(); ++j) {
      const double prior = j >= p ? 1.0 : ground_.known(j);
      information(j, j) += prior > 0.0 ? prior : unknown_precision * information(j, j) + 1e-300;
    }
    factor_.compute(information);
  }

  /// What the rival leaves of the effect before anything else makes up for it.
  Eigen::VectorXd left() const {
    Eigen::VectorXd y = truth_.change.head(ground_.settings);
    if (rival_ != nullptr) y -= k_ * rival_->change.head(ground_.settings);
    return y;
  }

  /// a' S^-1 b, S the covariance of the settings with all of `columns_`.
  double product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    const auto made = columns_.topRows(ground_.settings);
    return a.dot(b) - (made.transpose() * a).dot(factor_.solve(made.transpose() * b));
  }

  const PlanGround& ground_;
  double law_error_;
  const Effect& truth_;
  const Effect* rival_;
  double k_ = 0.0;
  Eigen::Index of_truth_ = 0, of_rival_ = 0;
  Eigen::MatrixXd columns_;
  Eigen::LDLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd found_;
  double chi2_ = 0.0;
};

/// More impacts at a place, under a condition that takes something away or as they are (null).
using Option = std::pair<const TakenAway*, std::size_t>;
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
  }

  PlannedCauses examined() {
    PlannedCauses found;
    for (const PossibleCause& cause : all_) found.causes.push_back(examine(cause));
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
          null + (found.strength - null) * std::sqrt(planned_log_odds / found.log_odds);
    }
    if (!found.seen()) found.remedy = remedy(with_base, cause, nullptr);
    for (const PossibleCause& rival : all_) {
      if (one_cause(cause, rival)) continue;
      ++found.rivals;
      if (!found.seen()) continue;
      std::optional<Comparison> closest;
      const auto compare = [&](const Effect& effect) {
        const double scale = amplitude(ground_, effect, rival.typical);
        if (!(std::abs(scale) > 0.0)) return;
        const double least = std::min(rival.least / scale, rival.most / scale);
        const double most = std::max(rival.least / scale, rival.most / scale);
        Comparison with(ground_, law_error_, cause.typical, &effect, least, most);
        if (!closest || with.log_odds() < closest->log_odds()) closest.emplace(std::move(with));
      };
      compare(rival.typical);
      for (const Effect& other : rival.others) compare(other);
      if (!closest || closest->log_odds() >= planned_log_odds) continue;
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

  int effort(const Option& option, int impacts) const {
    return impacts + (option.first != nullptr ? effort_of_a_change : 0);
  }

  /// The impacts of everything that would tell `rival` (none: the base model) from `cause`.
  Options options_for(const Comparison& comparison, const PossibleCause& cause,
                      const PossibleCause* rival) const {
    Options found;
    const auto look = [&](bool no_truth, bool no_rival, const TakenAway* away) {
      for (std::size_t i = 0; i < ground_.at.size(); ++i) {
        const auto impacts =
            comparison.impacts_for(static_cast<Eigen::Index>(i), no_truth, no_rival);
        if (impacts) found[{away, i}] = whole(*impacts);
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
    return found;
  }

  PlanRemedy remedy_of(const Option& option, int impacts) const {
    const auto& [away, place] = option;
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

  int least_effort(const Options& options) const {
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
  std::map<CausePair, Options> needs_;  // what the plan lacks
};

}  // namespace

PlannedCauses planned_causes(const FitSpec& spec, const ExperimentPlan& plan) {
  return Causes(spec, plan).examined();
}

}  // namespace recoil
