#include "plan/possible_causes.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/candidate.hpp"
#include "diagnosis/discrepancy.hpp"
#include "diagnosis/law_errors.hpp"
#include "estimate/predictor.hpp"
#include "plan/possible_points.hpp"

namespace recoil {
namespace {

constexpr int beyond_velocities = 24;  // of one size
constexpr double slower = 0.7, faster = 1.5, smaller = 0.6, larger = 1.6;

std::vector<PointConditions> places_to_look(const ExperimentPlan& plan) {
  std::vector<PointConditions> at = settings_of(plan);
  const std::vector<double>& sizes = plan.options.diameters;
  std::vector<double> beyond = sizes;
  beyond.push_back(smaller * sizes.front());
  beyond.push_back(larger * sizes.back());
  const double slowest = slower * plan.options.slowest;
  const double fastest = faster * plan.options.fastest;
  for (std::size_t d = 0; d < plan.datasets.size(); ++d) {
    if (plan.datasets[d].series.empty()) continue;
    for (const double diameter : beyond) {
      for (int k = 0; k < beyond_velocities; ++k) {
        const double share = static_cast<double>(k) / (beyond_velocities - 1);
        at.push_back({d, diameter, slowest * std::pow(fastest / slowest, share)});
      }
    }
  }
  return at;
}

Eigen::MatrixXd smooth_functions_at(const std::vector<PointConditions>& places) {
  Observations data;
  for (const PointConditions& at : places) {
    Observation point;
    point.diameter = at.diameter;
    point.velocity = at.velocity;
    data.points.push_back(point);
  }
  return smooth_functions(data);
}

/// e^2 everywhere; NaN where there is no answer.
Eigen::VectorXd squares_at(PointPredictor& predictor, const std::vector<double>& theta,
                           bool gradient) {
  predictor.evaluate(theta, gradient);
  Eigen::VectorXd found(static_cast<Eigen::Index>(predictor.size()));
  for (std::size_t i = 0; i < predictor.size(); ++i) {
    found(static_cast<Eigen::Index>(i)) =
        predictor.at(i).usable() ? predictor.at(i).restitution_squared : NAN;
  }
  return found;
}

/// A parameter of a mechanism, and how far it can be from where it is.
struct NotKnown {
  std::size_t slot = 0;
  double sd = 0.0;
};

/// One mechanism under the plan.
class Examined {
 public:
  Examined(const ExperimentPlan& plan, const PlanGround& ground, const Candidate& candidate,
           const Mechanism& mechanism)
      : ground_(ground),
        candidate_(candidate),
        mechanism_(mechanism),
        theta_(carried_over(plan.model, plan.theta, candidate.model, CarriedTo::all)),
        predictor_(candidate.model, ground.at),
        without_(
            squares_at(predictor_, without_mechanism(candidate.model, theta_, mechanism), false)) {}

  Effect effect(double strength) {
    std::vector<double> theta = theta_;
    std::vector<NotKnown> not_known;
    for (std::size_t j = 0; j < theta.size(); ++j) {
      const ParameterSlot& slot = candidate_.model.slots[j];
      if (slot.mechanism() != &mechanism_ || slot.stated) continue;
      if (slot.parameter == &mechanism_.info.parameters.front()) {
        theta[j] = strength;
      } else if (slot.free || slot.parameter->searched) {
        const PlausibleRange& range = slot.parameter->plausible;
        not_known.push_back({j, 0.5 * (range.upper - range.lower)});
      }
    }
    if (own_strength_) not_known.push_back({*own_strength_, std::abs(strength)});
    Effect found;
    found.strength = strength;
    const Eigen::VectorXd with = squares_at(predictor_, theta, true);
    found.change = (with - without_).cwiseProduct(ground_.weight);
    found.released.resize(with.size(), static_cast<Eigen::Index>(not_known.size()));
    std::vector<double> row(theta.size());
    for (Eigen::Index i = 0; i < with.size(); ++i) {
      predictor_.gradient_row(static_cast<std::size_t>(i), ground_.weight(i), row);
      for (std::size_t k = 0; k < not_known.size(); ++k) {
        const double slope = row[not_known[k].slot] * not_known[k].sd;
        const bool known = std::isfinite(with(i)) && std::isfinite(slope);
        found.released(i, static_cast<Eigen::Index>(k)) = known ? slope : 0.0;
      }
      if (!std::isfinite(found.change(i))) found.change(i) = 0.0;
      if (i >= ground_.settings || !std::isfinite(with(i) + without_(i))) continue;
      const double change =
          std::sqrt(std::max(with(i), 0.0)) - std::sqrt(std::max(without_(i), 0.0));
      if (std::abs(change) > std::abs(found.largest)) found.largest = change;
    }
    return found;
  }

  /// Its strength in the last dataset is not known where it is one for each dataset.
  void forget_the_last_strength() {
    const auto& own = candidate_.model.slot_own[first_parameter(candidate_.model, mechanism_)];
    const std::size_t slot = own.back().front();
    const ParameterSlot& its = candidate_.model.slots[slot];
    if (its.stated || its.parameter->per_series || slot == own.front().front()) return;
    own_strength_ = slot;
  }

  const std::vector<double>& theta() const { return theta_; }

 private:
  const PlanGround& ground_;
  const Candidate& candidate_;
  const Mechanism& mechanism_;
  std::vector<double> theta_;
  PointPredictor predictor_;
  Eigen::VectorXd without_;
  std::optional<std::size_t> own_strength_;
};

}  // namespace

std::vector<PointConditions> settings_of(const ExperimentPlan& plan) {
  std::vector<PointConditions> at;
  for (std::size_t d = 0; d < plan.datasets.size(); ++d) {
    for (const ImpactPoint& point : plan.datasets[d].points) {
      at.push_back({d, point.diameter, point.incident_velocity, point.series});
    }
  }
  return at;
}

PlanGround ground_of(const FitSpec& spec, const ExperimentPlan& plan) {
  return ground_at(spec, plan, planned_parameters(plan.model, plan.theta), places_to_look(plan));
}

PlanGround ground_at(const FitSpec& spec, const ExperimentPlan& plan,
                     const PlannedParameters& parameters, std::vector<PointConditions> at) {
  PlanGround ground;
  ground.at = std::move(at);
  ground.settings = static_cast<Eigen::Index>(plan.settings.size());
  std::vector<PlannedScatter> scatter;
  for (const Dataset& dataset : plan.datasets) {
    scatter.push_back(planned_scatter(plan.options, spec.noise, dataset));
  }
  const PossiblePoints points =
      possible_points(plan.model, plan.theta, parameters, ground.at, scatter);
  const auto rows = static_cast<Eigen::Index>(ground.at.size());
  ground.weight.resize(rows);
  ground.once.resize(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double of_one = points.outlook[k].information / plan.options.events;
    const double impacts =
        i < ground.settings ? plan.settings[k].points * plan.options.events : 1.0;
    ground.weight(i) = std::sqrt(of_one * impacts);
    ground.once(i) = 1.0 / std::sqrt(impacts);
  }
  ground.square = Eigen::Map<const Eigen::VectorXd>(points.square.data(), rows);
  ground.slopes = ground.weight.asDiagonal() * points.slopes;
  ground.known = parameters.known.diagonal();
  ground.functions = smooth_functions_at(ground.at);
  const Eigen::VectorXd loss = (1.0 - ground.square.array()).max(0.0).min(1.0);
  ground.errors =
      (law_error_of_base * spec.law_error * ground.weight.cwiseProduct(loss)).asDiagonal() *
      ground.functions;
  return ground;
}

double amplitude(const PlanGround& ground, const Effect& effect, const Effect& of) {
  const auto a = effect.change.head(ground.settings);
  const auto b = of.change.head(ground.settings);
  const double square = b.squaredNorm();
  return square > 0.0 ? a.dot(b) / square : 0.0;
}

std::optional<PossibleCause> possible_cause(const FitSpec& spec, const ExperimentPlan& plan,
                                            const PlanGround& ground, const Mechanism& mechanism) {
  const Candidate candidate = make_candidate(spec, plan.datasets, {std::string(mechanism.info.id)});
  Examined examined(plan, ground, candidate, mechanism);
  PossibleCause cause;
  cause.mechanism = &mechanism;
  cause.parameter = &mechanism.info.parameters.front();
  std::optional<std::size_t> open;
  double stated = cause.parameter->null_value;
  for (std::size_t j = 0; j < candidate.model.slots.size(); ++j) {
    const ParameterSlot& slot = candidate.model.slots[j];
    if (slot.parameter != cause.parameter) continue;
    if (!slot.stated) open = j;
    if (slot.stated && slot.initial != slot.parameter->null_value) stated = slot.initial;
  }
  if (!open) {
    if (stated == cause.parameter->null_value) return std::nullopt;
    cause.stated = true;
    cause.lower = cause.upper = stated;
    cause.typical = examined.effect(stated);
    cause.least = cause.most = 1.0;
    return cause;
  }
  const AllowedValues allowed = allowed_values(candidate, examined.theta(), *open);
  if (!(allowed.lower < allowed.upper)) return std::nullopt;
  cause.lower = allowed.lower;
  cause.upper = allowed.upper;
  const double start = candidate.model.slots[*open].initial;
  const double null = cause.parameter->null_value;
  const double strength = std::clamp(start, allowed.lower, allowed.upper);
  if (!(std::abs(strength - null) > 1e-6 * std::abs(start - null))) return std::nullopt;
  cause.typical = examined.effect(strength);
  for (const double other : cause.parameter->starts) {
    if (other > allowed.lower && other < allowed.upper) {
      cause.others.push_back(examined.effect(other));
    }
  }
  for (const double end : {allowed.lower, allowed.upper}) {
    const double factor = amplitude(ground, examined.effect(end), cause.typical);
    cause.least = std::min(cause.least, factor);
    cause.most = std::max(cause.most, factor);
  }
  cause.most = std::max(cause.most, 1.0);
  return cause;
}

PossibleCause carried_to(const PossibleCause& cause, const FitSpec& spec,
                         const ExperimentPlan& plan, const PlanGround& ground) {
  const Candidate candidate =
      make_candidate(spec, plan.datasets, {std::string(cause.mechanism->info.id)});
  Examined examined(plan, ground, candidate, *cause.mechanism);
  examined.forget_the_last_strength();
  PossibleCause carried = cause;
  carried.typical = examined.effect(cause.typical.strength);
  for (Effect& other : carried.others) other = examined.effect(other.strength);
  return carried;
}

}  // namespace recoil
