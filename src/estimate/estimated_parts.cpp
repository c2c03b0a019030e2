#include "estimate/estimated_parts.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "estimate/misfit.hpp"
#include "estimate/pooled_deviations.hpp"
#include "estimate/residual.hpp"
#include "estimate/setting_error.hpp"
#include "estimate/shared_errors.hpp"

namespace recoil {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The share of the own scatter of point i that this error causes.
double share_of(Estimated error, const FitResult& fitted, std::size_t i) {
  const Observation& point = fitted.data.points[i];
  const PointWeights& own = fitted.weights.points[i];
  if (!has_own_scatter(fitted.data, i)) return 0.0;
  const double sd = own.scatter > 0.0 ? (point.censored ? 0.0 : own.sd / own.mean_sd) : 1.0;
  const double of_impacts = std::max(0.0, 1.0 - sd * sd);
  if (error == Estimated::spread) return of_impacts;
  if (fitted.data.noise.sd_stated && !pools_deviation(point)) return 0.0;
  const double slope =
      weighted_residual(point, own, fitted.prediction_squared[i], fitted.data.noise.student).slope;
  return std::max(0.0, 1.0 - std::pow(own.input_sd * slope, 2) - of_impacts);
}

}  // namespace

void set_estimated_parts(FitResult& result, const LeastSquaresResult& run) {
  if (result.covariance.empty()) return;
  const auto n = static_cast<Eigen::Index>(result.data.points.size());
  const auto p = static_cast<Eigen::Index>(result.theta.size());
  const Eigen::Map<const Matrix> jacobian(run.jacobian.data(), n, p);
  const Eigen::Map<const Matrix> covariance(result.covariance.data(), p, p);
  const double scale = std::sqrt(scaled_covariance(result.data, {1.0}, result.noise_scale).front());
  Matrix influence = jacobian * covariance / scale;
  SharedErrors(result.data, result.weights)
      .whiten({influence.data(), static_cast<std::size_t>(influence.size())}, result.theta.size());
  for (EstimatedPart& part : result.estimated) {
    Matrix square = Matrix::Zero(p, p);
    const auto add = [&square](const Eigen::RowVectorXd& row) { square += row.transpose() * row; };
    if (part.error != Estimated::setting) {
      for (Eigen::Index i = 0; i < n; ++i) {
        const double share = share_of(part.error, result, static_cast<std::size_t>(i));
        if (share > 0.0) add(std::sqrt(share) * influence.row(i));
      }
    } else {
      const auto& sources = result.data.sources;
      const auto loads = loads_of_sources(result.data, result.weights);
      const auto k =
          static_cast<std::size_t>(std::ranges::find(sources, &setting_error()) - sources.begin());
      std::map<std::size_t, Eigen::RowVectorXd> draws;
      for (Eigen::Index i = 0; k < loads.size() && i < n; ++i) {
        const auto point = static_cast<std::size_t>(i);
        const auto draw =
            draws.try_emplace(result.data.points[point].setting, Eigen::RowVectorXd::Zero(p));
        draw.first->second += loads[k][point] * influence.row(i);
      }
      for (const auto& [setting, row] : draws) add(row);
    }
    part.covariance.assign(square.data(), square.data() + square.size());
  }
}

}  // namespace recoil
