#include "diagnosis/predicted_spread.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/discrepancy.hpp"
#include "diagnosis/elsewhere.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/predictor.hpp"

namespace recoil {
namespace {

constexpr double least_restitution = 0.05;  // below it e^2 says nothing of e to first order

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The points of `base` and after them the possible impacts, as if each had been made once and read
/// as predicted.
Observations with_possible(const Observations& data, const PossibleImpacts& possible,
                           const std::vector<double>& restitution) {
  Observations all = data;
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
    point.weights.sd = possible.sd[i];
    all.points.push_back(point);
  }
  return all;
}

/// The weighted residuals of all points, and their slopes in what is not known: the moving
/// parameters, then the errors of the laws.
struct Linearised {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd slopes;
  Eigen::Index parameters = 0;  ///< the first columns
};

/// What the points tell of the impacts that could be made: by how much they move the residuals, and
/// a root R of the covariance, R'R, of what is then predicted.
struct Told {
  Eigen::VectorXd moved;
  Eigen::MatrixXd reduced;
};

/// @param there the slopes of the impacts, in the place that they have in `here.slopes`
/// @param precisions of the moving parameters, known before any point; empty: nothing is
std::optional<Told> what_is_told(const Linearised& here, const Eigen::MatrixXd& there,
                                 std::size_t points, std::size_t impacts,
                                 const std::vector<double>& precisions) {
  const auto n = static_cast<Eigen::Index>(points);
  const auto g = static_cast<Eigen::Index>(impacts);
  const Eigen::Index rows = here.slopes.rows();
  const Eigen::Index p = here.parameters;
  const Eigen::Index errors = here.slopes.cols() - p;
  // The points, and behind them the constants of the materials with what is stated of them.
  const auto without_possible = [&](const auto& of_all) {
    std::decay_t<decltype(of_all)> rest(rows - g, of_all.cols());
    rest << of_all.topRows(n), of_all.bottomRows(rows - n - g);
    return rest;
  };
  Eigen::MatrixXd known = without_possible(here.slopes);
  const Eigen::VectorXd residuals = without_possible(here.residuals);
  Eigen::MatrixXd asked = there.middleRows(n, g);
  Eigen::VectorXd before = Eigen::VectorXd::Zero(p + errors);
  if (!precisions.empty()) before.head(p) = Eigen::Map<const Eigen::VectorXd>(precisions.data(), p);
  // Columns of unit length: the units of the parameters lie twenty decades apart.
  for (Eigen::Index k = 0; k < p; ++k) {
    const double length = std::sqrt(known.col(k).squaredNorm() + before(k));
    if (!(length > 0.0)) return std::nullopt;
    known.col(k) /= length;
    asked.col(k) /= length;
    before(k) /= length * length;
  }
  before.head(p).array() += 1e-12;
  before.tail(errors).array() += 1.0;
  Eigen::MatrixXd information = known.transpose() * known;
  information.diagonal() += before;
  const Eigen::LLT<Eigen::MatrixXd> factor(information);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd likeliest = -factor.solve(known.transpose() * residuals);
  return Told{asked * likeliest, factor.matrixL().solve(asked.transpose())};
}

/// Empty without an answer.
std::optional<Linearised> linearised_at(const CandidateResult& rival, const Observations& all,
                                        const std::vector<double>& theta, const LawErrors& laws) {
  const ImpactModel& model = rival.candidate.model;
  const LeastSquaresProblem problem = impact_problem(model, all);
  std::vector<double> residuals(problem.residual_count);
  std::vector<double> jacobian(problem.residual_count * theta.size());
  if (!problem.evaluate(theta, residuals, jacobian)) return std::nullopt;
  const auto columns = law_error_columns(rival.candidate, all, theta, laws);
  if (!columns) return std::nullopt;
  const auto rows = static_cast<Eigen::Index>(problem.residual_count);
  const Eigen::Map<const RowMajor> J(jacobian.data(), rows,
                                     static_cast<Eigen::Index>(theta.size()));
  std::vector<Eigen::Index> moving;
  for (std::size_t j = 0; j < rival.refit.moving.size(); ++j) {
    if (rival.refit.moving[j]) moving.push_back(static_cast<Eigen::Index>(j));
  }
  const auto p = static_cast<Eigen::Index>(moving.size());
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(rows, p + columns->cols());
  for (Eigen::Index k = 0; k < p; ++k) both.col(k) = J.col(moving[static_cast<std::size_t>(k)]);
  both.topRightCorner(columns->rows(), columns->cols()) = *columns;
  return Linearised{Eigen::Map<Eigen::VectorXd>(residuals.data(), rows), std::move(both), p};
}

}  // namespace

PredictedSpread predicted_spread(const SearchBase& base, const CandidateResult& rival,
                                 const PossibleImpacts& possible, const Mechanism* without) {
  const ImpactModel& model = rival.candidate.model;
  const std::vector<double>& theta = rival.refit.theta;
  const std::vector<double> changed =
      without == nullptr ? theta : without_mechanism(model, theta, *without);
  PredictedSpread found;
  for (const Prediction& at : predict(model, changed, possible.at, false)) {
    found.restitution.push_back(at.usable() ? at.restitution() : NAN);
  }
  found.variance.assign(possible.at.size(), NAN);
  const Observations& data = base.fitted.data;
  const Observations all = with_possible(data, possible, found.restitution);
  LawErrors laws = base.laws;
  laws.functions = smooth_functions(all);
  const auto here = linearised_at(rival, all, theta, laws);
  const auto there = without == nullptr ? here : linearised_at(rival, all, changed, laws);
  if (!here || !there) return found;
  const auto g = static_cast<Eigen::Index>(possible.at.size());
  const auto told = what_is_told(*here, there->slopes, data.points.size(), possible.at.size(), {});
  if (!told) return found;
  for (Eigen::Index i = 0; i < g; ++i) {
    const auto k = static_cast<std::size_t>(i);
    found.variance[k] = told->reduced.col(i).squaredNorm();
    found.restitution[k] = std::max(0.0, found.restitution[k] - possible.sd[k] * told->moved(i));
  }
  return found;
}

RivalElsewhere::RivalElsewhere(const SearchBase& base, const CandidateResult& rival,
                               const Dataset& target, std::size_t like)
    : base_(base) {
  Elsewhere there = carried_elsewhere(base.spec, base.datasets, target, like, rival.candidate,
                                      rival.refit.theta, rival.refit.moving);
  rival_.candidate = std::move(there.candidate);
  rival_.refit.usable = true;
  rival_.refit.theta = std::move(there.theta);
  rival_.refit.moving = std::move(there.moving);
  precisions_ = std::move(there.precisions);
}

std::vector<double> RivalElsewhere::restitution(const std::vector<PointConditions>& at) const {
  std::vector<double> found;
  for (const Prediction& there : predict(rival_.candidate.model, rival_.refit.theta, at, false)) {
    found.push_back(there.usable() ? there.restitution() : NAN);
  }
  return found;
}

PredictedTogether RivalElsewhere::predicted(const PossibleImpacts& possible) const {
  const std::vector<double> expected = restitution(possible.at);
  PredictedTogether found;
  found.restitution = Eigen::Map<const Eigen::VectorXd>(expected.data(),
                                                        static_cast<Eigen::Index>(expected.size()));
  if (!found.restitution.allFinite()) return found;
  const Observations& data = base_.fitted.data;
  const Observations all = with_possible(data, possible, expected);
  LawErrors laws = base_.laws;
  laws.functions = smooth_functions(all);
  const auto here = linearised_at(rival_, all, rival_.refit.theta, laws);
  if (!here) return found;
  std::vector<double> known;
  for (std::size_t j = 0; j < rival_.refit.moving.size(); ++j) {
    if (rival_.refit.moving[j]) known.push_back(precisions_(static_cast<Eigen::Index>(j)));
  }
  const auto told =
      what_is_told(*here, here->slopes, data.points.size(), possible.at.size(), known);
  if (!told) return found;
  const Eigen::Map<const Eigen::VectorXd> sd(possible.sd.data(), found.restitution.size());
  found.restitution = (found.restitution - sd.cwiseProduct(told->moved)).cwiseMax(0.0);
  found.covariance = told->reduced.transpose() * told->reduced;
  return found;
}

}  // namespace recoil
