#include "diagnosis/discrepancy.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "diagnosis/candidate.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "estimate/shared_settings.hpp"

namespace recoil {
namespace {

constexpr double left_out = 1e-6;   // of the unit variance of a smooth function
constexpr double too_small = 1e-9;  // of a variance of residuals, beside their own

/// The matrix I + Q diag(factor) Q' times `m`.
template <class M>
void scale_along(const Eigen::MatrixXd& Q, const Eigen::VectorXd& factor, M& m) {
  const Eigen::MatrixXd along = Q.transpose() * m;
  m += Q * (factor.asDiagonal() * along);
}

}  // namespace

Eigen::MatrixXd smooth_functions(const Observations& data) {
  const auto n = static_cast<Eigen::Index>(data.points.size());
  Eigen::ArrayXd log_velocity(n), log_diameter(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Observation& point = data.points[static_cast<std::size_t>(i)];
    log_velocity(i) = std::log(point.velocity);
    log_diameter(i) = std::log(point.diameter);
  }
  Eigen::ArrayXd unexplained = Eigen::ArrayXd::Ones(n);
  std::vector<Eigen::VectorXd> columns;
  while (static_cast<Eigen::Index>(columns.size()) < n) {
    Eigen::Index pivot = 0;
    const double most = unexplained.maxCoeff(&pivot);
    if (!(most > left_out)) break;
    Eigen::VectorXd column = (-0.5 * ((log_velocity - log_velocity(pivot)).square() +
                                      (log_diameter - log_diameter(pivot)).square()))
                                 .exp();
    for (const Eigen::VectorXd& other : columns) column -= other(pivot) * other;
    column /= std::sqrt(most);
    unexplained -= column.array().square();
    columns.push_back(std::move(column));
  }
  Eigen::MatrixXd functions(n, static_cast<Eigen::Index>(columns.size()));
  for (Eigen::Index k = 0; k < functions.cols(); ++k) {
    functions.col(k) = columns[static_cast<std::size_t>(k)];
  }
  return functions;
}

Discrepancy::Discrepancy(const Eigen::MatrixXd& shared) {
  if (shared.cols() == 0) return;
  // U'U = V S^2 V' gives the directions U V / S, and I + U U' has 1 + S^2 along them.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(shared.transpose() * shared);
  const Eigen::VectorXd& variances = eigen.eigenvalues();
  const auto rank = (variances.array() > too_small).count();
  directions_.resize(shared.rows(), rank);
  whiter_.resize(rank);
  rougher_.resize(rank);
  for (Eigen::Index k = 0; k < rank; ++k) {
    const Eigen::Index from = variances.size() - 1 - k;  // in the order of size, the largest first
    const double variance = variances(from);
    directions_.col(k) = shared * eigen.eigenvectors().col(from) / std::sqrt(variance);
    rougher_(k) = std::sqrt(1.0 + variance) - 1.0;
    whiter_(k) = 1.0 / std::sqrt(1.0 + variance) - 1.0;
    log_determinant_ += std::log1p(variance);
  }
}

void Discrepancy::whiten(std::span<double> residuals) const {
  if (shares_nothing()) return;
  Eigen::Map<Eigen::VectorXd> r(residuals.data(), directions_.rows());
  scale_along(directions_, whiter_, r);
}

void Discrepancy::unwhiten(std::span<double> residuals) const {
  if (shares_nothing()) return;
  Eigen::Map<Eigen::VectorXd> r(residuals.data(), directions_.rows());
  scale_along(directions_, rougher_, r);
}

void Discrepancy::whiten(std::span<double> jacobian, std::size_t p) const {
  if (shares_nothing() || p == 0) return;
  Eigen::Map<RowMajor> J(jacobian.data(), directions_.rows(), static_cast<Eigen::Index>(p));
  scale_along(directions_, whiter_, J);
}

void whiten_settings(const Observations& data, Eigen::MatrixXd& columns) {
  const SharedSettings settings(data.points);
  for (Eigen::Index k = 0; k < columns.cols() && !settings.none(); ++k) {
    settings.whiten({columns.col(k).data(), data.points.size()});
  }
}

LeastSquaresProblem whitened(LeastSquaresProblem problem, const Discrepancy& discrepancy) {
  if (discrepancy.shares_nothing()) return problem;
  problem.evaluate = [plain = std::move(problem.evaluate), &discrepancy](
                         std::span<const double> theta, std::span<double> residuals,
                         std::span<double> jacobian) {
    if (!plain(theta, residuals, jacobian)) return false;
    discrepancy.whiten(residuals);
    if (!jacobian.empty()) discrepancy.whiten(jacobian, theta.size());
    return true;
  };
  return problem;
}

std::shared_ptr<const Discrepancy> nothing_shared() {
  static const auto nothing = std::make_shared<const Discrepancy>();
  return nothing;
}

namespace {

/// Rounds in which the covariance follows the parameters: the second moves a criterion by less than
/// 0.1.
constexpr int rounds = 2;
constexpr double most_loss = 1.0;  // of e^2: no more than all the energy

/// e^2 of every point, 0 where it is captured; empty where there is no answer.
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
                                                 const Observations& data,
                                                 std::span<const double> theta,
                                                 const LawErrors& laws) {
  const ImpactModel& model = candidate.model;
  const std::vector<double> full(theta.begin(), theta.end());
  PointPredictor predictor(model, data.conditions());
  const std::optional<Eigen::VectorXd> all = squares(predictor, full);
  if (!all) return std::nullopt;
  const std::optional<Eigen::VectorXd> bare = squares(predictor, without_mechanisms(model, full));
  if (!bare) return std::nullopt;
  std::vector<Eigen::VectorXd> sizes;  // of each error, in e^2
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
    slopes(i) =
        weighted_residual(data.points[static_cast<std::size_t>(i)], (*all)(i), data.noise.student)
            .slope;
  }
  const Eigen::Index rank = laws.functions.cols();
  Eigen::MatrixXd columns(slopes.size(), rank * static_cast<Eigen::Index>(sizes.size()));
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    columns.middleCols(static_cast<Eigen::Index>(k) * rank, rank) =
        slopes.cwiseProduct(sizes[k]).asDiagonal() * laws.functions;
  }
  whiten_settings(data, columns);
  return columns;
}

Refit under_law_errors(const Candidate& candidate, const Observations& data, Refit refit,
                       const LawErrors& laws) {
  if (laws.none() || !refit.usable) return refit;
  const auto columns = law_error_columns(candidate, data, refit.theta, laws);
  if (!columns) return {};
  refit.discrepancy = std::make_shared<const Discrepancy>(*columns);
  refit.discrepancy->whiten(refit.residuals);
  refit.jacobian.resize(data.points.size() * refit.theta.size());
  refit.discrepancy->whiten(refit.jacobian, refit.theta.size());
  refit.chi2 = std::inner_product(refit.residuals.begin(), refit.residuals.end(),
                                  refit.residuals.begin(), 0.0);
  return refit;
}

Refit with_law_errors(const Candidate& candidate, const Observations& data, Refit refit,
                      const LawErrors& laws) {
  if (laws.none()) return refit;
  for (int round = 0; round < rounds && refit.usable; ++round) {
    const auto columns = law_error_columns(candidate, data, refit.theta, laws);
    if (!columns) return {};
    refit = refit_candidate(candidate, data, refit.theta, 0,
                            std::make_shared<const Discrepancy>(*columns));
  }
  return refit;
}

}  // namespace recoil
