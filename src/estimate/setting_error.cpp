#include "estimate/setting_error.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "core/numerics.hpp"
#include "estimate/error_source.hpp"
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

std::map<std::size_t, SettingMean> means_of(const Observations& data, const Weights& weights,
                                            std::span<const double> predicted) {
  std::map<std::size_t, SettingMean> means;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    if (point.censored) continue;
    const WeightedResidual r = weighted_residual(point, weights.points[i], predicted[i]);
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

/// An error of e itself, sigma, that the points of one setting share.
class SettingError : public ErrorSource {
 public:
  SettingError()
      : ErrorSource({"setting", "setting_sd", "errors that settings share"}, SharedBy::setting) {}

  bool acts(const Observations& data) const override {
    return data.noise.setting_sd_estimated || data.noise.spec.setting_sd.value_or(0.0) > 0.0;
  }
  double effect(const Observation&, const Local& at, const Noise& noise) const override {
    return 2.0 * std::sqrt(std::max(at.value, 0.0)) * noise.setting_sd;
  }
};

}  // namespace

const ErrorSource& setting_error() {
  static const SettingError source;
  return source;
}

double estimated_setting_error(const Observations& data, const Weights& weights,
                               std::span<const double> predicted, int free_count,
                               std::span<const std::vector<double>> trends) {
  const auto means = means_of(data, weights, predicted);
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

double setting_sd_at(const Observations& data, const Weights& weights,
                     std::span<const double> predicted, int free_count) {
  if (data.noise.spec.setting_sd) return *data.noise.spec.setting_sd;
  if (!data.noise.setting_sd_estimated || spare_settings(data, free_count) < 1) return 0.0;
  return std::min(
      estimated_setting_error(data, weights, predicted, free_count, series_offsets(data)),
      stated_setting_error(data));
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
