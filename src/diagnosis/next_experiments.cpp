#include "diagnosis/next_experiments.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "core/random.hpp"
#include "diagnosis/discrepancy.hpp"
#include "diagnosis/search.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/predictor.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_compared = 4;              // largest number of compared rivals
constexpr int grid_velocities = 24;                   // velocities in the grid of each diameter
constexpr double smallest_sd = 1e-3;                  // least sd of e of one impact
constexpr double least_restitution = 0.05;            // below it e^2 is not linear in e
constexpr double most_impacts = 1e6;                  // largest number of impacts of an experiment
constexpr Eigen::Index draws = 32;                    // of the unknowns of a rival
constexpr int effort_of_a_change = 100;               // effort of changing a condition, in impacts
constexpr double wanted_log_odds = 4.59511985013459;  // ln 99

/// The impacts to choose from, see `next_experiments`, and the standard deviation of e of one [1].
struct PossibleImpacts {
  std::vector<PointConditions> at;
  std::vector<double> sd;
};

/// The nearest diameter in which balls and microspheres are sold [m]: 1, 1.2, 1.5, ... in each
/// decade.
double sold_size(double diameter) {
  constexpr std::array sold = {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0};
  const int decade = static_cast<int>(std::floor(std::log10(diameter)));
  const double unit = decade < 0 ? 1.0 / std::pow(10.0, -decade) : std::pow(10.0, decade);
  const auto away = [&](double size) { return std::abs(std::log(size * unit / diameter)); };
  return unit * *std::ranges::min_element(sold, {}, away);
}

PossibleImpacts possible_impacts(const FitResult& base) {
  const std::vector<Observation>& points = base.data.points;
  const auto [slow, fast] = std::ranges::minmax_element(points, {}, &Observation::velocity);
  const double slowest = 0.7 * slow->velocity;
  const double fastest = 1.5 * fast->velocity;
  std::set<std::pair<std::size_t, double>> sizes;
  for (const Observation& point : points) sizes.insert({point.dataset, point.diameter});
  std::set<std::pair<std::size_t, double>> wider = sizes;
  for (const auto& [dataset, diameter] : sizes) {
    const auto of_dataset = [d = dataset](const auto& size) { return size.first == d; };
    const auto first = std::ranges::find_if(sizes, of_dataset);
    const auto last = std::find_if(sizes.rbegin(), sizes.rend(), of_dataset);
    wider.insert({dataset, sold_size(0.6 * first->second)});
    wider.insert({dataset, sold_size(1.6 * last->second)});
  }
  PossibleImpacts possible;
  for (const auto& [dataset, diameter] : wider) {
    for (int k = 0; k < grid_velocities; ++k) {
      const double share = static_cast<double>(k) / (grid_velocities - 1);
      const double velocity = slowest * std::pow(fastest / slowest, share);
      possible.at.push_back({dataset, diameter, velocity});
      possible.sd.push_back(scatter_of_one_event(base, dataset, velocity));
    }
  }
  return possible;
}

/// The measured points, followed by one observation of each possible impact with the predicted e.
WeightedData with_possible(const FitResult& fitted, const PossibleImpacts& possible,
                           const std::vector<double>& restitution) {
  WeightedData all{fitted.data, fitted.weights};
  Weights& weights = all.weights;
  for (std::size_t i = 0; i < possible.at.size(); ++i) {
    const PointConditions& at = possible.at[i];
    Observation point;
    point.dataset = at.dataset;
    point.diameter = at.diameter;
    point.velocity = at.velocity;
    point.series = at.series;
    point.events = 1;
    point.restitution = std::isnan(restitution[i]) ? least_restitution
                                                   : std::max(restitution[i], least_restitution);
    point.sd = possible.sd[i];
    weights.points.emplace_back().sd = point.sd;
    if (!weights.predicted.empty()) {
      weights.predicted.push_back(point.restitution * point.restitution);
    }
    for (std::vector<double>& effect : weights.effects) effect.push_back(0.0);
    all.data.points.push_back(point);
  }
  return all;
}

/// Weighted residuals of measured points, possible impacts and constants, in this order, and their
/// slopes in the unknowns: first the moving parameters, then the errors of the laws.
struct Linearised {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd slopes;
  Eigen::Index parameters = 0;
};

/// @return nullopt if an impact cannot be solved
std::optional<Linearised> linearised_at(const CandidateResult& rival, const WeightedData& all,
                                        const std::vector<double>& theta, const LawErrors& laws) {
  const LeastSquaresProblem problem = impact_problem(rival.candidate.model, all.data, all.weights);
  std::vector<double> residuals(problem.residual_count);
  std::vector<double> jacobian(problem.residual_count * theta.size());
  if (!problem.evaluate(theta, residuals, jacobian)) return std::nullopt;
  const auto columns =
      law_error_columns(rival.candidate, all.data, all.weights, theta, laws, rival.refit.law_error);
  if (!columns) return std::nullopt;
  const auto rows = static_cast<Eigen::Index>(problem.residual_count);
  const Eigen::Map<const RowMajor> J(jacobian.data(), rows,
                                     static_cast<Eigen::Index>(theta.size()));
  const std::vector<std::size_t> moving = rival.refit.moving_slots();
  const auto p = static_cast<Eigen::Index>(moving.size());
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(rows, p + columns->cols());
  both.leftCols(p) = J(Eigen::all, moving);
  both.topRightCorner(columns->rows(), columns->cols()) = *columns;
  return Linearised{Eigen::Map<Eigen::VectorXd>(residuals.data(), rows), std::move(both), p};
}

/// The prediction of a rival for each possible impact.
struct PredictedImpacts {
  std::vector<double> restitution;  ///< mean e, 0 for a capture; NaN if the impact cannot be solved
  std::vector<double> variance;     ///< variance of that mean over the variance of one impact
  std::vector<bool> rebounds;       ///< at the likeliest parameters and with exact laws
};

/// e of the possible impacts, 0 for a capture; NaN if an impact cannot be solved.
Eigen::ArrayXd restitutions(const ImpactModel& model, const std::vector<double>& theta,
                            const PossibleImpacts& possible, const Mechanism* removed) {
  const std::vector<double> changed =
      removed == nullptr ? theta : without_mechanism(model, theta, *removed);
  Eigen::ArrayXd found(static_cast<Eigen::Index>(possible.at.size()));
  Eigen::Index i = 0;
  for (const Prediction& at : predict(model, changed, possible.at, false)) {
    found(i++) = at.usable() ? at.restitution() : NAN;
  }
  return found;
}

/// The normal distribution of the unknowns of a rival given the measured points, and what they do
/// to the possible impacts.
struct Unknowns {
  Eigen::VectorXd likeliest;                ///< [parameters, then errors of the laws]
  Eigen::LLT<Eigen::MatrixXd> information;  ///< the inverse of their covariance
  Eigen::VectorXd length;                   ///< of the parameters' columns: their scale
  Eigen::MatrixXd by_laws;                  ///< d residual / d error of a law [possible x errors]
};

/// @return nullopt if they cannot be computed
std::optional<Unknowns> unknowns_of(const SearchBase& base, const CandidateResult& rival,
                                    const PossibleImpacts& possible, const Mechanism* removed) {
  const ImpactModel& model = rival.candidate.model;
  const std::vector<double>& theta = rival.refit.theta;
  const std::vector<double> changed =
      removed == nullptr ? theta : without_mechanism(model, theta, *removed);
  const Eigen::ArrayXd expected = restitutions(model, theta, possible, removed);
  const WeightedData all =
      with_possible(base.fitted, possible, {expected.data(), expected.data() + expected.size()});
  LawErrors laws = base.laws;
  laws.functions = smooth_functions(all.data);
  const auto here = linearised_at(rival, all, theta, laws);
  const auto there = removed == nullptr ? here : linearised_at(rival, all, changed, laws);
  if (!here || !there) return std::nullopt;
  const auto n = static_cast<Eigen::Index>(base.fitted.data.points.size());
  const auto g = static_cast<Eigen::Index>(possible.at.size());
  std::vector<Eigen::Index> measured;  // and constants
  for (Eigen::Index i = 0; i < here->slopes.rows(); ++i) {
    if (i < n || i >= n + g) measured.push_back(i);
  }
  Eigen::MatrixXd known = here->slopes(measured, Eigen::all);
  // Columns of unit length: the units of the parameters differ by twenty orders of magnitude.
  const Eigen::Index p = here->parameters;
  Unknowns found;
  found.length = known.leftCols(p).colwise().norm();
  if (p > 0 && !(found.length.minCoeff() > 0.0)) return std::nullopt;
  known.leftCols(p) *= found.length.cwiseInverse().asDiagonal();
  Eigen::VectorXd prior = Eigen::VectorXd::Ones(known.cols());
  prior.head(p).setConstant(1e-12);
  Eigen::MatrixXd information = known.transpose() * known;
  information.diagonal() += prior;
  found.information.compute(information);
  if (found.information.info() != Eigen::Success) return std::nullopt;
  found.likeliest = -found.information.solve(known.transpose() * here->residuals(measured));
  found.by_laws = there->slopes.middleRows(n, g).rightCols(known.cols() - p);
  return found;
}

/// The distribution of the possible impacts given the measured points, see `next_experiments`.
/// @param removed a mechanism that a changed condition removes from the possible impacts, or null
PredictedImpacts predicted_impacts(const SearchBase& base, const CandidateResult& rival,
                                   const PossibleImpacts& possible, const Mechanism* removed) {
  const auto g = static_cast<Eigen::Index>(possible.at.size());
  PredictedImpacts found;
  found.restitution.assign(possible.at.size(), NAN);
  found.variance.assign(possible.at.size(), NAN);
  const Eigen::ArrayXd likeliest =
      restitutions(rival.candidate.model, rival.refit.theta, possible, removed);
  for (const double e : likeliest) found.rebounds.push_back(e > 0.0);
  const auto unknowns = unknowns_of(base, rival, possible, removed);
  if (!unknowns) return found;
  const ImpactModel& model = rival.candidate.model;
  const std::vector<std::size_t> moving = rival.refit.moving_slots();
  const Eigen::Index p = unknowns->length.size();
  const Eigen::Index count = unknowns->likeliest.size();
  const Eigen::Map<const Eigen::ArrayXd> sd(possible.sd.data(), g);
  Eigen::ArrayXXd drawn(g, draws);
  RandomStream random(base.options.seed, RandomPurpose::experiments, 0);
  Eigen::VectorXd normal(count);
  for (Eigen::Index k = 0; k < draws; ++k) {
    // Every second draw is the mirror image of the one before it.
    for (double& one : normal) one = k % 2 == 0 ? random.normal() : -one;
    Eigen::VectorXd x = unknowns->likeliest;
    if (count > 0) x += unknowns->information.matrixU().solve(normal);
    std::vector<double> theta = rival.refit.theta;
    for (Eigen::Index j = 0; j < p; ++j) {
      const std::size_t slot = moving[static_cast<std::size_t>(j)];
      theta[slot] = std::clamp(theta[slot] + x(j) / unknowns->length(j), model.slots[slot].lower,
                               model.slots[slot].upper);
    }
    const Eigen::ArrayXd by_laws = (unknowns->by_laws * x.tail(count - p)).array();
    const auto or_capture = [](double e) { return e < 0.0 ? 0.0 : e; };
    drawn.col(k) =
        (restitutions(model, theta, possible, removed) - sd * by_laws).unaryExpr(or_capture);
  }
  const Eigen::ArrayXd mean = drawn.rowwise().mean();
  const Eigen::ArrayXd variance = (drawn.colwise() - mean).square().rowwise().mean();
  for (Eigen::Index i = 0; i < g; ++i) {
    found.restitution[static_cast<std::size_t>(i)] = mean(i);
    found.variance[static_cast<std::size_t>(i)] = variance(i) / (sd(i) * sd(i));
  }
  return found;
}

std::string name_of(const CandidateResult& rival) {
  return rival.candidate.added.empty() ? std::string(law_error_as_rival) : rival.candidate.name();
}

/// The probabilities that `rivals` act, of which one does.
std::vector<double> probabilities(std::span<const CandidateResult* const> rivals) {
  std::vector<double> all;
  double sum = 0.0;
  for (const CandidateResult* rival : rivals) {
    all.push_back(std::exp(-0.5 * (rival->delta_aicc - rivals.front()->delta_aicc)));
    sum += all.back();
  }
  for (double& one : all) one /= sum;
  return all;
}

/// A rival with its probability and its predictions of the possible impacts.
struct Forecast {
  const CandidateResult* rival = nullptr;
  double probability = 0.0;
  PredictedImpacts impacts;
};

/// Expected ln odds for the right one of two rivals.
struct LogOdds {
  double average = 0.0;  ///< over which one is right
  double worst = 0.0;    ///< for the less favourable one
};

/// The expected ln odds after `count` impacts.
/// @param apart difference of the predicted means, over the standard deviation of one impact
/// @param one,other variances of the predictions, over the variance of one impact
/// @param first probability that the first is right, if one of the two is
LogOdds expected_log_odds(double apart, double one, double other, double first, double count) {
  const double a = one + 1.0 / count;
  const double b = other + 1.0 / count;
  const auto divergence = [&](double from, double to) {
    return 0.5 * (from / to - 1.0 - std::log(from / to) + apart * apart / to);
  };
  const double if_first = divergence(a, b);
  const double if_second = divergence(b, a);
  return {first * if_first + (1.0 - first) * if_second, std::min(if_first, if_second)};
}

/// The smallest number of impacts whose `log_odds(count)`, an increasing function, reaches ln 99;
/// nullopt if `most_impacts` are not enough.
template <class LogOdds>
std::optional<int> fewest_impacts(const LogOdds& log_odds) {
  const auto enough = [&](double count) { return log_odds(count) >= wanted_log_odds; };
  if (!enough(most_impacts)) return std::nullopt;
  double few = 0.5;
  double many = most_impacts;
  while (many > 1.001 * few && std::ceil(few) < std::ceil(many)) {
    const double middle = std::sqrt(few * many);
    (enough(middle) ? many : few) = middle;
  }
  return std::max(1, static_cast<int>(std::ceil(many)));
}

/// Writes into `experiment` the impact that distinguishes two predictions with the fewest events.
/// @param first probability that `a` is right, if one of the two is
/// @return false if there is none
bool find_impact(const PossibleImpacts& possible, const PredictedImpacts& a,
                 const PredictedImpacts& b, double first, NextExperiment& experiment) {
  std::optional<int> fewest;
  for (std::size_t i = 0; i < possible.at.size(); ++i) {
    const double difference = a.restitution[i] - b.restitution[i];
    const double apart = difference / possible.sd[i];
    if (!std::isfinite(apart + a.variance[i] + b.variance[i])) continue;
    // Where all spheres stick, there is no e, however wrong the laws may be.
    if (!a.rebounds[i] && !b.rebounds[i]) continue;
    const auto odds = [&](double count) {
      return expected_log_odds(apart, a.variance[i], b.variance[i], first, count);
    };
    const auto count = fewest_impacts([&](double n) { return odds(n).worst; });
    if (!count || (fewest && *count >= *fewest)) continue;
    fewest = count;
    experiment.dataset = possible.at[i].dataset;
    experiment.diameter = possible.at[i].diameter;
    experiment.velocity = possible.at[i].velocity;
    experiment.difference = difference;
    experiment.events = *count;
    experiment.log_odds = odds(*count).average;
    experiment.worst_log_odds = odds(*count).worst;
  }
  return fewest.has_value();
}

/// Largest difference in e of two predictions [1].
double largest_difference(const PredictedImpacts& a, const PredictedImpacts& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.restitution.size(); ++i) {
    const double here = std::abs(a.restitution[i] - b.restitution[i]);
    if (here > largest) largest = here;
  }
  return largest;
}

/// Were some impacts of this dataset measured under a condition that removes the mechanism?
bool was_taken_away(const Candidate& candidate, const Mechanism& mechanism, std::size_t dataset) {
  return std::ranges::any_of(candidate.impacts, [&](const PointConditions& at) {
    return at.dataset == dataset && is_taken_away(candidate.model, mechanism, at);
  });
}

/// The series whose impacts are most similar to `experiment`: in ln d first, then in ln V.
std::size_t most_similar_series(const Observations& data, const NextExperiment& experiment) {
  std::size_t series = 0;
  double least = INFINITY;
  for (const Observation& point : data.points) {
    if (point.dataset != experiment.dataset) continue;
    const double away = 10.0 * std::abs(std::log(point.diameter / experiment.diameter)) +
                        std::abs(std::log(point.velocity / experiment.velocity));
    if (away < least) series = point.series;
    least = std::min(least, away);
  }
  return series;
}

/// The value of the condition that removes a mechanism from all impacts of a dataset.
double value_for(const SearchBase& base, const TakenAway& away, std::size_t dataset) {
  if (away.least == nullptr) return away.value;
  double largest = 0.0;
  for (const Observation& point : base.fitted.data.points) {
    if (point.dataset != dataset) continue;
    largest =
        std::max(largest, away.least(plain_sphere(base.fitted.model.surroundings[dataset],
                                                  point.diameter, point.velocity, point.series)));
  }
  return largest;
}

/// Adds the changes of a condition that remove a mechanism which `one` has and `other` lacks.
void add_changes(const SearchBase& base, const PossibleImpacts& possible, const Forecast& one,
                 const Forecast& other, std::vector<NextExperiment>& all) {
  for (const std::string& id : one.rival->candidate.added) {
    const Mechanism& mechanism = *find_mechanism(id);
    if (!mechanism.info.taken_away || other.rival->candidate.adds(id)) continue;
    NextExperiment change;
    change.kind = ExperimentKind::condition;
    change.one = name_of(*one.rival);
    change.other = name_of(*other.rival);
    const PredictedImpacts without = predicted_impacts(base, *one.rival, possible, &mechanism);
    const double first = one.probability / (one.probability + other.probability);
    if (!find_impact(possible, without, other.impacts, first, change)) continue;
    if (was_taken_away(one.rival->candidate, mechanism, change.dataset)) continue;
    change.condition = mechanism.info.taken_away->condition;
    change.value = value_for(base, *mechanism.info.taken_away, change.dataset);
    change.doing = mechanism.info.taken_away->doing;
    all.push_back(std::move(change));
  }
}

int effort(const NextExperiment& experiment) {
  return experiment.events +
         (experiment.kind == ExperimentKind::condition ? effort_of_a_change : 0);
}

}  // namespace

double scatter_of_one_event(const FitResult& base, std::size_t dataset, double velocity) {
  double nearest = INFINITY, sd = smallest_sd;
  for (std::size_t i = 0; i < base.data.points.size(); ++i) {
    const Observation& point = base.data.points[i];
    if (point.dataset != dataset || point.censored) continue;
    const double distance = std::abs(std::log(point.velocity / velocity));
    if (distance >= nearest) continue;
    nearest = distance;
    sd = base.weights.points[i].sd * std::sqrt(static_cast<double>(std::max(point.rebounds(), 1))) *
         base.noise_scale;
  }
  return std::max(sd, smallest_sd);
}

NextExperiments next_experiments(const SearchBase& base,
                                 const std::vector<const CandidateResult*>& rivals) {
  NextExperiments next;
  if (rivals.size() < 2) return next;
  const PossibleImpacts possible = possible_impacts(base.fitted);
  const std::span compared(rivals.data(), std::min(most_compared, rivals.size()));
  const std::vector<double> probability = probabilities(compared);
  std::vector<Forecast> forecasts;
  for (std::size_t k = 0; k < compared.size(); ++k) {
    forecasts.push_back(
        {compared[k], probability[k], predicted_impacts(base, *compared[k], possible, nullptr)});
  }
  std::vector<std::pair<double, NextExperiment>> found;  // with its effort for the probability
  for (std::size_t a = 0; a < forecasts.size(); ++a) {
    for (std::size_t b = a + 1; b < forecasts.size(); ++b) {
      const Forecast &one = forecasts[a], &other = forecasts[b];
      const double either = one.probability + other.probability;
      std::vector<NextExperiment> own;
      NextExperiment points;
      points.one = name_of(*one.rival);
      points.other = name_of(*other.rival);
      if (find_impact(possible, one.impacts, other.impacts, one.probability / either, points)) {
        own.push_back(points);
      }
      add_changes(base, possible, one, other, own);
      add_changes(base, possible, other, one, own);
      if (own.empty()) {
        next.inseparable.push_back(
            {points.one, points.other, largest_difference(one.impacts, other.impacts)});
      }
      for (NextExperiment& experiment : own) {
        experiment.series = most_similar_series(base.fitted.data, experiment);
        found.emplace_back(effort(experiment) / either, std::move(experiment));
      }
    }
  }
  std::ranges::stable_sort(found, {}, [](const auto& one) { return one.first; });
  for (auto& [effort, experiment] : found) next.list.push_back(std::move(experiment));
  return next;
}

}  // namespace recoil
