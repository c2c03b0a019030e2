#include "estimate/shared_settings.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include "core/numerics.hpp"
#include "estimate/residual.hpp"

namespace recoil {
namespace {

constexpr double largest_error = 0.3;  // largest sigma, an error of e [1]
// With m >= 5 deviations a standard deviation is known within a factor of 2.5 (95 %): sqrt(5 /
// chi2) ranges from 0.62 to 2.45.
constexpr int fewest_deviations = 5;

/// Weighted sums of the deviations of e from the prediction over the points of one setting.
struct SettingMean {
  double weight = 0.0;  ///< sum of 1 / sd^2
  double sum = 0.0;     ///< sum of deviation / sd^2
  double square = 0.0;  ///< sum of deviation^2 / sd^2
  int points = 0;

  double mean() const { return sum / weight; }
  double within() const { return std::max(0.0, square - sum * sum / weight); }
};

std::map<std::size_t, SettingMean> means_of(const Observations& data,
                                            std::span<const double> predicted) {
  std::map<std::size_t, SettingMean> means;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    if (point.censored) continue;
    const WeightedResidual r = weighted_residual(point, predicted[i]);
    const double slope = slope_in_restitution(r, predicted[i]);
    if (!(slope > 0.0)) continue;
    const double deviation = r.value / slope;  // measured minus predicted e, to first order
    SettingMean& setting = means[point.setting];
    setting.weight += slope * slope;
    setting.sum += deviation * slope * slope;
    setting.square += deviation * deviation * slope * slope;
    ++setting.points;
  }
  return means;
}

/// Indicator functions of all series but the first [functions][points]: differences between series
/// are not errors of settings.
std::vector<std::vector<double>> series_offsets(const Observations& data) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> offsets;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    offsets.try_emplace({point.dataset, point.series}, data.points.size(), 0.0).first->second[i] =
        1.0;
  }
  std::vector<std::vector<double>> functions;
  for (auto at = std::next(offsets.begin()); at != offsets.end(); ++at) {
    functions.push_back(std::move(at->second));
  }
  return functions;
}

/// The largest error of e that the stated errors of V cause, e sd_V / V [1]; infinite if a point
/// with a known e states none.
double stated_setting_error(const Observations& data) {
  double most = 0.0;
  for (const Observation& point : data.points) {
    if (point.censored) continue;
    if (!(point.velocity_sd > 0.0)) return INFINITY;
    most = std::max(most, point.restitution * point.velocity_sd / point.velocity);
  }
  return most;
}

/// Correlation matrix of the errors of these points: the identity, with correlations between
/// bounces of one launch (see `SharedSettings`).
Eigen::MatrixXd correlations(const std::vector<Observation>& points,
                             const std::vector<std::size_t>& which) {
  const auto count = static_cast<Eigen::Index>(which.size());
  Eigen::MatrixXd found = Eigen::MatrixXd::Identity(count, count);
  const auto by_instants = [](const Observation& point) {
    const double back = 1.0 / point.restitution;
    return Eigen::Vector3d(1.0, -(1.0 + back), back).normalized().eval();
  };
  for (Eigen::Index i = 0; i < count; ++i) {
    const Observation& first = points[which[static_cast<std::size_t>(i)]];
    if (first.launch == Observation::no_launch) continue;
    for (Eigen::Index j = 0; j < count; ++j) {
      const Observation& second = points[which[static_cast<std::size_t>(j)]];
      if (second.launch != first.launch || second.bounce <= first.bounce) continue;
      const auto apart = second.bounce - first.bounce;
      if (apart > 2) continue;
      const Eigen::Vector3d a = by_instants(first);
      const Eigen::Vector3d b = by_instants(second);
      found(i, j) = found(j, i) = apart == 1 ? a(1) * b(0) + a(2) * b(1) : a(2) * b(0);
    }
  }
  return found;
}

}  // namespace

double slope_in_restitution(const WeightedResidual& residual, double restitution_squared) {
  return std::abs(residual.slope) * 2.0 * std::sqrt(std::max(restitution_squared, 0.0));
}

SharedSettings::SharedSettings(const std::vector<Observation>& points) {
  // Every shared error is a column of U; columns with a common point form one block.
  enum class Kind { setting, size, instants };
  using Source = std::tuple<Kind, std::size_t, std::size_t>;  // dataset; setting, series or launch
  std::map<Source, std::vector<Member>> columns;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointWeights& weights = points[i].weights;
    if (weights.setting_load > 0.0) {
      columns[{Kind::setting, 0, points[i].setting}].push_back({i, weights.setting_load});
    }
    if (weights.size_load != 0.0) {
      columns[{Kind::size, points[i].dataset, points[i].series}].push_back({i, weights.size_load});
    }
    if (points[i].launch != Observation::no_launch) {
      columns[{Kind::instants, 0, points[i].launch}].push_back({i, 0.0});
    }
  }
  std::map<std::size_t, std::size_t> block_of;  // block of a point
  std::vector<std::vector<const std::vector<Member>*>> blocks;
  for (const auto& [source, members] : columns) {
    const std::size_t own = blocks.size();
    blocks.push_back({&members});
    for (const Member& member : members) {
      const std::size_t other = block_of.try_emplace(member.point, own).first->second;
      if (other == own) continue;
      for (const std::vector<Member>* column : blocks[other]) {
        for (const Member& moved : *column) block_of[moved.point] = own;
      }
      blocks[own].insert(blocks[own].end(), blocks[other].begin(), blocks[other].end());
      blocks[other].clear();
    }
  }
  for (const auto& own : blocks) {
    if (!own.empty()) add_block(points, own);
  }
}

void SharedSettings::add_block(const std::vector<Observation>& points,
                               const std::vector<const std::vector<Member>*>& columns) {
  Block block;
  bool bounces = false;
  std::map<std::size_t, Eigen::Index> row;
  for (const auto* column : columns) {
    for (const Member& member : *column) {
      if (row.try_emplace(member.point, static_cast<Eigen::Index>(row.size())).second) {
        block.points.push_back(member.point);
        bounces = bounces || points[member.point].launch != Observation::no_launch;
      }
    }
  }
  const auto errors = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(row.size()), errors);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    for (const Member& member : *columns[k]) {
      loads(row[member.point], static_cast<Eigen::Index>(k)) = member.load;
    }
  }
  if (bounces) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> covariance(
        correlations(points, block.points) + loads * loads.transpose());
    const Eigen::MatrixXd whole = covariance.operatorInverseSqrt();
    log_determinant_ += covariance.eigenvalues().array().log().sum();
    block.whole.assign(whole.data(), whole.data() + whole.size());
    blocks_.push_back(std::move(block));
    return;
  }
  // U'U = W S W' makes the root I - U W ((1 - (1 + S)^(-1/2)) / S) W' U'.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> squares(loads.transpose() * loads);
  Eigen::VectorXd factors(errors);
  for (Eigen::Index k = 0; k < errors; ++k) {
    const double square = squares.eigenvalues()(k);
    factors(k) = square > 0.0 ? (1.0 - 1.0 / std::sqrt(1.0 + square)) / square : 0.5;
    log_determinant_ += std::log1p(std::max(0.0, square));
  }
  const Eigen::MatrixXd inner =
      squares.eigenvectors() * factors.asDiagonal() * squares.eigenvectors().transpose();
  block.loads.assign(loads.data(), loads.data() + loads.size());
  block.inner.assign(inner.data(), inner.data() + inner.size());
  blocks_.push_back(std::move(block));
}

void SharedSettings::whiten(std::span<double> rows, std::size_t columns) const {
  for (const Block& block : blocks_) {
    const auto count = static_cast<Eigen::Index>(block.points.size());
    Eigen::MatrixXd own(count, static_cast<Eigen::Index>(columns));
    for (Eigen::Index i = 0; i < count; ++i) {
      const double* row = &rows[block.points[static_cast<std::size_t>(i)] * columns];
      for (Eigen::Index k = 0; k < own.cols(); ++k) own(i, k) = row[k];
    }
    if (!block.whole.empty()) {
      own = Eigen::Map<const Eigen::MatrixXd>(block.whole.data(), count, count) * own;
    } else {
      const auto errors = static_cast<Eigen::Index>(block.loads.size()) / count;
      const Eigen::Map<const Eigen::MatrixXd> loads(block.loads.data(), count, errors);
      const Eigen::Map<const Eigen::MatrixXd> inner(block.inner.data(), errors, errors);
      own -= (loads * (inner * (loads.transpose() * own))).eval();
    }
    for (Eigen::Index i = 0; i < count; ++i) {
      double* row = &rows[block.points[static_cast<std::size_t>(i)] * columns];
      for (Eigen::Index k = 0; k < own.cols(); ++k) row[k] = own(i, k);
    }
  }
}

double estimated_setting_error(const Observations& data, std::span<const double> predicted,
                               int free_count, std::span<const std::vector<double>> trends) {
  const auto means = means_of(data, predicted);
  const auto count = static_cast<Eigen::Index>(means.size());
  double within = 0.0;
  int freedom = 0;
  Eigen::ArrayXd mean(count), weight(count);
  std::map<std::size_t, Eigen::Index> place;
  for (const auto& [setting, of_setting] : means) {
    const auto k = static_cast<Eigen::Index>(place.size());
    place[setting] = k;
    mean(k) = of_setting.mean();
    weight(k) = of_setting.weight;
    within += of_setting.within();
    freedom += of_setting.points - 1;
  }
  const auto functions = static_cast<Eigen::Index>(trends.size());
  const Eigen::Index between = count - free_count - functions;
  if (between < 1 || freedom < 1) return 0.0;
  Eigen::MatrixXd trend(count, functions);
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const auto at = place.find(data.points[i].setting);
    for (Eigen::Index k = 0; k < functions && at != place.end(); ++k) {
      trend(at->second, k) = trends[static_cast<std::size_t>(k)][i];
    }
  }
  // The stated standard deviations hold unless the points scatter more within their settings.
  const double scatter = within / freedom;
  const double unit = data.noise.sd_stated ? std::max(1.0, scatter) : scatter;
  const auto excess = [&](double error) {
    const Eigen::ArrayXd root = (unit / weight + error * error).rsqrt();
    const Eigen::VectorXd white = (root * mean).matrix();
    double left = white.squaredNorm();
    if (functions > 0) {
      const Eigen::MatrixXd columns = root.matrix().asDiagonal() * trend;
      left = (white - columns * columns.colPivHouseholderQr().solve(white)).squaredNorm();
    }
    return left - static_cast<double>(between);
  };
  if (!(excess(0.0) > 0.0)) return 0.0;
  if (excess(largest_error) > 0.0) return largest_error;
  return find_root(excess, 0.0, largest_error, 1e-9);
}

int spare_settings(const Observations& data, int free_count) {
  std::set<std::pair<std::size_t, std::size_t>> series;
  for (const Observation& point : data.points) series.insert({point.dataset, point.series});
  return count_settings(data).settings - free_count - static_cast<int>(series.size() - 1);
}

bool too_few_settings(const Observations& data, int free_count) {
  return data.noise.setting_sd_estimated && spare_settings(data, free_count) < fewest_deviations;
}

void renew_settings(std::span<const double> predicted, int free_count, Observations& data) {
  if (!data.noise.shares_errors()) return;
  double& error = data.noise.setting_sd;
  if (data.noise.spec.setting_sd) {
    error = *data.noise.spec.setting_sd;
  } else if (!data.noise.setting_sd_estimated || spare_settings(data, free_count) < 1) {
    error = 0.0;
  } else {
    error = std::min(estimated_setting_error(data, predicted, free_count, series_offsets(data)),
                     stated_setting_error(data));
  }
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    Observation& point = data.points[i];
    const double slope =
        point.censored ? 0.0
                       : slope_in_restitution(weighted_residual(point, predicted[i]), predicted[i]);
    point.weights.setting_load = slope * std::hypot(error, point.weights.setting_sd);
    point.weights.size_load = slope * point.weights.size_sd;
  }
}

std::vector<double> draw_setting_errors(const Observations& data, double noise_scale,
                                        RandomStream& random) {
  std::vector<double> errors(data.points.size(), 0.0);
  if (data.noise.shares_instants) {
    std::map<std::size_t, std::vector<std::size_t>> launches;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      if (data.points[i].launch != Observation::no_launch) {
        launches[data.points[i].launch].push_back(i);
      }
    }
    for (const auto& [launch, own] : launches) {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> correlated(
          correlations(data.points, own));
      Eigen::VectorXd drawn(static_cast<Eigen::Index>(own.size()));
      for (double& error : drawn) error = random.normal();
      drawn = (correlated.operatorSqrt() * drawn).eval();
      for (std::size_t k = 0; k < own.size(); ++k) {
        errors[own[k]] =
            noise_scale * data.points[own[k]].weights.sd * drawn(static_cast<Eigen::Index>(k));
      }
    }
  }
  if (data.noise.series_diameter_stated) {
    std::map<std::pair<std::size_t, std::size_t>, double> of_series;  // in standard deviations
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const Observation& point = data.points[i];
      const auto [place, is_new] = of_series.try_emplace({point.dataset, point.series}, 0.0);
      if (is_new) place->second = random.normal();
      errors[i] = place->second * point.weights.size_sd;
    }
  }
  if (!(data.noise.setting_sd > 0.0) && !data.noise.setting_velocity_stated) return errors;
  std::map<std::size_t, double> drawn;  // in standard deviations
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const auto [place, is_new] = drawn.try_emplace(data.points[i].setting, 0.0);
    if (is_new) place->second = random.normal();
    const double stated = data.points[i].weights.setting_sd;
    errors[i] += place->second *
                 (stated > 0.0 ? std::hypot(data.noise.setting_sd, stated) : data.noise.setting_sd);
  }
  return errors;
}

double shifted_square(double restitution_squared, double error) {
  if (error == 0.0 || !(restitution_squared > 0.0)) return restitution_squared;
  const double e = std::max(0.0, std::sqrt(restitution_squared) + error);
  return e * e;
}

SettingCount count_settings(const Observations& data) {
  std::map<std::size_t, int> points;
  for (const Observation& point : data.points) {
    if (!point.censored) ++points[point.setting];
  }
  SettingCount count;
  for (const auto& [setting, own] : points) {
    ++count.settings;
    count.points += own;
  }
  return count;
}

}  // namespace recoil
