#include "diagnosis/law_errors.hpp"

#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

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
  LawErrors part{sizes, {}, mechanism};
  if (functions.size() > 0) part.functions = functions(points, Eigen::all);
  return part;
}

LawErrors allowed_law_errors(std::optional<double> stated, const Observations& data) {
  LawErrors laws{sizes_of_law_error(), smooth_functions(data)};
  std::erase_if(laws.sizes, [](const LawErrorSize& one) {
    return one.size < least_law_error || one.size > largest_law_error_of_base;
  });
  double sum = 0.0;
  for (const LawErrorSize& one : laws.sizes) sum += one.prior;
  for (LawErrorSize& one : laws.sizes) one.prior /= sum;
  if (stated) {
    laws.mechanism = *stated;
    laws.sizes = {{law_error_of_base * *stated, 1.0}};
  }
  return laws;
}

std::optional<Eigen::MatrixXd> law_error_columns(const Candidate& candidate,
                                                 const Observations& data, const Weights& weights,
                                                 std::span<const double> theta,
                                                 const LawErrors& laws, double size) {
  const ImpactModel& model = candidate.model;
  const std::vector<double> full(theta.begin(), theta.end());
  PointPredictor predictor(model, data.conditions());
  const std::optional<Eigen::VectorXd> all = squares(predictor, full);
  if (!all) return std::nullopt;
  const std::optional<Eigen::VectorXd> bare = squares(predictor, without_mechanisms(model, full));
  if (!bare) return std::nullopt;
  std::vector<Eigen::VectorXd> sizes;  // size of each error, in e^2 [points]
  sizes.push_back(size * (1.0 - bare->array()).min(most_loss).max(0.0).matrix());
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

Refit refit_with_law_error(const Candidate& candidate, const Observations& data,
                           const Weights& weights, Refit refit, const LawErrors& laws,
                           double size) {
  for (int round = 0; round < rounds && refit.usable && laws.act(candidate, size); ++round) {
    const auto columns = law_error_columns(candidate, data, weights, refit.theta, laws, size);
    if (!columns) return {};
    refit = refit_candidate(candidate, data, weights, refit.theta, 0,
                            std::make_shared<const Discrepancy>(*columns));
    refit.law_error = size;
  }
  return refit;
}

namespace {

/// `refit`, evaluated under the covariance of errors of one size at its parameters.
Refit screened_with(const Candidate& candidate, const Observations& data, const Weights& weights,
                    Refit refit, const LawErrors& laws, double size) {
  if (!laws.act(candidate, size) || !refit.usable) return refit;
  const auto columns = law_error_columns(candidate, data, weights, refit.theta, laws, size);
  if (!columns) return {};
  refit.law_error = size;
  refit.discrepancy = std::make_shared<const Discrepancy>(*columns);
  refit.discrepancy->whiten(refit.residuals);
  refit.jacobian.resize(data.points.size() * refit.theta.size());
  refit.discrepancy->whiten(refit.jacobian, refit.theta.size());
  refit.chi2 = std::inner_product(refit.residuals.begin(), refit.residuals.end(),
                                  refit.residuals.begin(), 0.0);
  return refit;
}

/// @param refit_at (start, size) -> the refit under errors of that size
template <class RefitAt>
RefitOverLaws averaged(const Candidate& candidate, const Observations& data, const Refit& refit,
                       const LawErrors& laws, const RefitAt& refit_at) {
  constexpr double hopeless = 20.0;  // larger sizes only get worse from here
  RefitOverLaws found;
  double best = INFINITY, sum = 0.0;
  Refit last = refit;
  for (const LawErrorSize& one : laws.sizes) {
    Refit here = refit_at(last, one.size);
    if (!here.usable) continue;
    const double criterion = corrected_criterion(data, here, candidate.free_count);
    const double own = criterion - 2.0 * std::log(one.prior);
    if (!found.refit.usable) {
      found.first_chi2 = here.chi2;
      found.refit = here;
    }
    if (own < best) {
      sum = sum * std::exp(0.5 * (own - best)) + 1.0;
      best = own;
      found.refit = here;
    } else {
      sum += std::exp(-0.5 * (own - best));
    }
    if (own > best + hopeless) break;
    last = std::move(here);
  }
  // Too few points for the criterion leave it infinite.
  if (std::isfinite(best)) found.criterion = best - 2.0 * std::log(sum);
  return found;
}

}  // namespace

RefitOverLaws refit_over_laws(const Candidate& candidate, const Observations& data,
                              const Weights& weights, const Refit& refit, const LawErrors& laws) {
  return averaged(candidate, data, refit, laws, [&](const Refit& start, double size) {
    return refit_with_law_error(candidate, data, weights, start, laws, size);
  });
}

RefitOverLaws screen_over_laws(const Candidate& candidate, const Observations& data,
                               const Weights& weights, const Refit& refit, const LawErrors& laws) {
  return averaged(candidate, data, refit, laws, [&](const Refit&, double size) {
    return screened_with(candidate, data, weights, refit, laws, size);
  });
}

}  // namespace recoil
