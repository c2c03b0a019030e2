#include "diagnosis/law_errors.hpp"

#include <memory>
#include <numeric>

#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"

namespace recoil {
namespace {

/// Rounds in which the covariance is recomputed at the parameters: the second changes a criterion
/// by less than 0.1.
constexpr int rounds = 2;
constexpr double most_loss = 1.0;  // largest loss of e^2: all the energy

/// e^2 of every point, below zero for a capture; nullopt if an impact cannot be solved.
std::optional<Eigen::VectorXd> squares(PointPredictor& predictor, std::span<const double> theta) {
  predictor.evaluate(theta, false);
  Eigen::VectorXd found(static_cast<Eigen::Index>(predictor.size()));
  for (std::size_t i = 0; i < predictor.size(); ++i) {
    if (!predictor.at(i).usable()) return std::nullopt;
    found(static_cast<Eigen::Index>(i)) = predictor.at(i).restitution_squared;
  }
  return found;
}

}  // namespace

LawErrors LawErrors::of(const std::vector<std::size_t>& points) const {
  LawErrors part{mechanism, base, {}};
  part.functions.resize(static_cast<Eigen::Index>(points.size()), functions.cols());
  if (functions.cols() > 0) part.functions = functions(points, Eigen::all);
  return part;
}

std::optional<Eigen::MatrixXd> law_error_columns(const Candidate& candidate,
                                                 const Observations& data, const Weights& weights,
                                                 std::span<const double> theta,
                                                 const LawErrors& laws) {
  const ImpactModel& model = candidate.model;
  const std::vector<double> full(theta.begin(), theta.end());
  PointPredictor predictor(model, data.conditions());
  const std::optional<Eigen::VectorXd> all = squares(predictor, full);
  if (!all) return std::nullopt;
  const std::optional<Eigen::VectorXd> bare = squares(predictor, without_mechanisms(model, full));
  if (!bare) return std::nullopt;
  std::vector<Eigen::VectorXd> sizes;  // size of each error, in e^2 [points]
  sizes.push_back(laws.base * (1.0 - bare->array()).min(most_loss).max(0.0).matrix());
  for (const Mechanism* mechanism : model.chain) {
    const std::optional<Eigen::VectorXd> less =
        squares(predictor, without_mechanism(model, full, *mechanism));
    if (!less) return std::nullopt;
    sizes.push_back(laws.mechanism *
                    (*all - *less).array().min(most_loss).max(-most_loss).matrix());
  }
  Eigen::VectorXd slopes(all->size());
  for (Eigen::Index i = 0; i < slopes.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    slopes(i) =
        weighted_residual(data.points[k], weights.points[k], (*all)(i), data.noise.student).slope;
  }
  const Eigen::Index rank = laws.functions.cols();
  Eigen::MatrixXd columns(slopes.size(), rank * static_cast<Eigen::Index>(sizes.size()));
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    columns.middleCols(static_cast<Eigen::Index>(k) * rank, rank) =
        slopes.cwiseProduct(sizes[k]).asDiagonal() * laws.functions;
  }
  whiten_shared(data, weights, columns);
  return columns;
}

Refit under_law_errors(const Candidate& candidate, const Observations& data, const Weights& weights,
                       Refit refit, const LawErrors& laws) {
  if (laws.none() || !refit.usable) return refit;
  const auto columns = law_error_columns(candidate, data, weights, refit.theta, laws);
  if (!columns) return {};
  refit.discrepancy = std::make_shared<const Discrepancy>(*columns);
  refit.discrepancy->whiten(refit.residuals);
  refit.jacobian.resize(data.points.size() * refit.theta.size());
  refit.discrepancy->whiten(refit.jacobian, refit.theta.size());
  refit.chi2 = std::inner_product(refit.residuals.begin(), refit.residuals.end(),
                                  refit.residuals.begin(), 0.0);
  return refit;
}

Refit with_law_errors(const Candidate& candidate, const Observations& data, const Weights& weights,
                      Refit refit, const LawErrors& laws) {
  if (laws.none()) return refit;
  for (int round = 0; round < rounds && refit.usable; ++round) {
    const auto columns = law_error_columns(candidate, data, weights, refit.theta, laws);
    if (!columns) return {};
    refit = refit_candidate(candidate, data, weights, refit.theta, 0,
                            std::make_shared<const Discrepancy>(*columns));
  }
  return refit;
}

}  // namespace recoil
