#include "diagnosis/outlying_points.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/numerics.hpp"
#include "diagnosis/search.hpp"
#include "estimate/odd_point.hpp"
#include "estimate/residual.hpp"

namespace recoil {
namespace {

// Fraction of data sets in which any point is wrongly called outlying.
constexpr double false_rate = 0.05;
constexpr double any_discrepancy = 0.3;  // sd of a smooth discrepancy of e^2
// Power of V_min / V in the residuals of a wrong capture velocity.
constexpr double steepness = 2.0;
// Prior sd of a parameter's effect, in standard deviations of the residuals.
constexpr double any_parameter = 1e4;
constexpr double to_sd = 1.4826;   // sd over the median of |z| for a normal z
constexpr std::size_t fewest = 8;  // fewest points that can show another to be outlying

using Indices = std::vector<std::size_t>;

/// The columns U of the covariance of the residuals: base parameters, smooth functions, and the
/// effect of a wrong capture velocity for each diameter.
Eigen::MatrixXd predictable(const SearchBase& base) {
  const Observations& data = base.fitted.data;
  const std::size_t p = base.refit.theta.size();
  const Eigen::MatrixXd& smooth = base.laws.functions;
  const Indices moving = base.refit.moving_slots();
  const auto n = static_cast<Eigen::Index>(data.points.size());
  const auto free = static_cast<Eigen::Index>(moving.size());
  std::map<std::pair<std::size_t, double>, std::pair<Eigen::Index, double>> groups;  // V_min
  for (const Observation& point : data.points) {
    const auto at = groups.try_emplace({point.dataset, point.diameter},
                                       static_cast<Eigen::Index>(groups.size()), point.velocity);
    double& slowest = at.first->second.second;
    slowest = std::min(slowest, point.velocity);
  }
  const auto group_count = static_cast<Eigen::Index>(groups.size());
  const Eigen::Index near_capture = free + smooth.cols();
  Eigen::MatrixXd U = Eigen::MatrixXd::Zero(n, near_capture + group_count);
  // The Jacobian of the unwhitened residuals; that of the refit is whitened.
  for (Eigen::Index j = 0; j < free; ++j) {
    std::vector<double> column;
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      column.push_back(base.refit.jacobian[i * p + moving[static_cast<std::size_t>(j)]]);
    }
    base.refit.discrepancy->unwhiten(column);
    U.col(j) = Eigen::Map<Eigen::VectorXd>(column.data(), n);
    const double length = U.col(j).norm();
    if (length > 0.0) U.col(j) *= any_parameter / length;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double slope = weighted_residual(data.points[k], base.fitted.weights.points[k],
                                           base.fitted.prediction_squared[k], data.noise.student)
                             .slope;
    U.row(i).segment(free, smooth.cols()) = any_discrepancy * slope * smooth.row(i);
    const auto& [group, slowest] = groups[{data.points[k].dataset, data.points[k].diameter}];
    U(i, near_capture + group) = slope * std::pow(slowest / data.points[k].velocity, steepness);
  }
  return U;
}

/// The deviations of points from their prediction by the points `others`, in standard deviations. A
/// point is not used for its own prediction.
class PredictionByOthers {
 public:
  PredictionByOthers(const Eigen::MatrixXd& U, const Eigen::VectorXd& r, const Indices& others)
      : U_(U), r_(r), along_(Eigen::VectorXd::Zero(U.cols())) {
    Eigen::MatrixXd information = Eigen::MatrixXd::Identity(U.cols(), U.cols());
    for (const std::size_t i : others) {
      const auto row = static_cast<Eigen::Index>(i);
      information += U.row(row).transpose() * U.row(row);
      along_ += U.row(row).transpose() * r(row);
    }
    solver_.compute(information);
  }
  /// The deviation of a point that is one of the others: predicted without it.
  double of_one_of_them(std::size_t i) const {
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::VectorXd weight = solver_.solve(U_.row(row).transpose());
    const double precision = 1.0 - U_.row(row).dot(weight);  // [C^-1]_ii
    const double left = r_(row) - weight.dot(along_);        // [C^-1 r]_i
    return precision > 1e-9 ? left / std::sqrt(precision) : 0.0;
  }
  /// The deviation of a point that is not one of the others.
  double of_another(std::size_t i) const {
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::VectorXd weight = solver_.solve(U_.row(row).transpose());
    return (r_(row) - weight.dot(along_)) / std::sqrt(1.0 + U_.row(row).dot(weight));
  }

 private:
  const Eigen::MatrixXd& U_;
  const Eigen::VectorXd& r_;
  Eigen::VectorXd along_;
  Eigen::LDLT<Eigen::MatrixXd> solver_;
};

double scale_of(std::vector<double> z, bool stated) {
  for (double& value : z) value = std::abs(value);
  const auto middle = z.begin() + static_cast<std::ptrdiff_t>(z.size() / 2);
  std::nth_element(z.begin(), middle, z.end());
  const double scale = to_sd * *middle;
  return stated ? std::max(scale, 1.0) : scale;
}

}  // namespace

std::vector<OutlyingPoint> outlying_points(const SearchBase& base) {
  gsl_errors_are_values();
  const Observations& data = base.fitted.data;
  const std::size_t n = data.points.size();
  std::vector<double> plain = base.refit.residuals;
  base.refit.discrepancy->unwhiten(plain);
  const Eigen::VectorXd r = Eigen::Map<Eigen::VectorXd>(plain.data(), static_cast<Eigen::Index>(n));
  const Eigen::MatrixXd U = predictable(base);
  const double limit = gsl_cdf_ugaussian_Qinv(0.5 * false_rate / static_cast<double>(n));
  Indices kept, out;
  // A captured point that the model also captures has a residual near zero.
  for (std::size_t i = 0; i < n; ++i) {
    if (data.points[i].informs(base.fitted.prediction_squared[i])) kept.push_back(i);
  }
  const std::size_t most = kept.size() / 5;
  double scale = 1.0;
  const std::size_t free = base.refit.moving_slots().size();
  while (out.size() < most && kept.size() > fewest + free) {
    const PredictionByOthers prediction(U, r, kept);
    std::vector<double> z;
    for (const std::size_t i : kept) z.push_back(prediction.of_one_of_them(i));
    scale = scale_of(z, data.noise.sd_stated);
    const auto worst = static_cast<std::size_t>(
        std::ranges::max_element(z, {}, [](double one) { return std::abs(one); }) - z.begin());
    if (!(scale > 0.0) || !(std::abs(z[worst]) > limit * scale)) break;
    out.push_back(kept[worst]);
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(worst));
  }
  std::vector<OutlyingPoint> found;
  const auto add = [&](std::size_t i, double z) {
    const Observation& point = data.points[i];
    found.push_back({i, point.dataset, point.line, point.diameter, point.velocity,
                     point.censored ? 0.0 : point.restitution, z});
  };
  if (out.empty()) {
    // Too few points for smooth functions: `odd_point` predicts each from the others by the model.
    if (kept.size() > fewest + free) return found;
    if (const std::optional<OddPoint> odd = odd_point(base.fitted)) add(odd->index, odd->residual);
    return found;
  }
  std::ranges::sort(out);
  const PredictionByOthers prediction(U, r, kept);
  for (const std::size_t i : out) {
    const double z = prediction.of_another(i) / scale;
    if (std::abs(z) > limit) add(i, z);
  }
  return found;
}

std::vector<Dataset> without_points(std::vector<Dataset> datasets,
                                    const std::vector<OutlyingPoint>& outlying) {
  std::size_t index = 0;  // index of the observation: the points of all datasets in order
  for (Dataset& dataset : datasets) {
    std::vector<ImpactPoint> kept;
    for (const ImpactPoint& point : dataset.points) {
      const bool odd =
          std::ranges::any_of(outlying, [&](const OutlyingPoint& o) { return o.index == index; });
      if (!odd) kept.push_back(point);
      ++index;
    }
    dataset.points = std::move(kept);
  }
  return datasets;
}

}  // namespace recoil
