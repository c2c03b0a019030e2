#include "diagnosis/unstated_errors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "diagnosis/search.hpp"
#include "estimate/input_errors.hpp"
#include "estimate/residual.hpp"
#include "estimate/setting_error.hpp"
#include "estimate/shared_errors.hpp"

namespace recoil {

namespace {

constexpr double steps_of_rulers[] = {0.01, 0.005, 0.002, 0.001};
constexpr double highest_of_steps = 15.0;
constexpr double coherent = 0.9;
constexpr std::size_t fewest_heights = 4;

/// The height to which the sphere of `point` rebounds in vacuum, e^2 V^2 / 2g [m].
double rebound_height(const ImpactPoint& point) {
  const double rebound = point.restitution * point.incident_velocity;
  return rebound * rebound / (2.0 * standard_gravity);
}

/// Sums over the rebounds of one size and velocity, for the coherence of their heights with a step.
struct Heights {
  double sum = 0.0;      ///< sum of the heights [m]
  double cosines = 0.0;  ///< sum of cos(2 pi h / step)
  int count = 0;
};

/// The mean cosine over all sizes and velocities whose rebounds are low enough, with equal weights;
/// 0 if there are too few.
double coherence(const Dataset& dataset, double step) {
  std::map<std::pair<double, double>, Heights> places;
  for (const ImpactPoint& point : dataset.points) {
    if (!(point.restitution > 0.0)) continue;
    Heights& heights = places[{point.diameter, point.incident_velocity}];
    const double height = rebound_height(point);
    heights.sum += height;
    heights.cosines += std::cos(2.0 * std::numbers::pi * height / step);
    ++heights.count;
  }
  double sum = 0.0;
  std::size_t low = 0;
  for (const auto& [place, heights] : places) {
    if (heights.sum > highest_of_steps * step * heights.count) continue;
    sum += heights.cosines / heights.count;
    ++low;
  }
  return low < fewest_heights ? 0.0 : sum / static_cast<double>(low);
}

constexpr double smallest_error = 0.002;  // relative error of a velocity
constexpr double largest_error = 0.15;
constexpr double smallest_reading = 2e-4;        // error of a height or a time, over the median one
constexpr double smallest_setting_error = 2e-4;  // error of e [1]
constexpr int steps = 15;

/// Standard deviation of the e^2 of a point that rebounded, including the errors of V and d [1].
double square_sd(const Observation& point, const PointWeights& weights) {
  const double e = point.restitution;
  if (weights.mean_sd > 0.0) return 2.0 * e * weights.mean_sd;
  return std::hypot(std::max(2.0 * e, weights.sd) * weights.sd, weights.input_sd);
}

/// The terms of -2 ln likelihood that depend on the weights alone.
double deviance_of_weights(const FitResult& fitted) {
  const Observations& data = fitted.data;
  double sum = SharedErrors(data, fitted.weights).log_determinant();
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    if (!point.censored) sum += 2.0 * std::log(square_sd(point, fitted.weights.points[i]));
  }
  return sum;
}

/// -2 ln likelihood of a fit up to a constant, including the terms that depend on the weights.
double deviance_with_weights(const FitResult& fitted) {
  double sum = deviance_of_weights(fitted);
  for (std::size_t i = 0; i < fitted.data.points.size(); ++i) {
    sum += fitted.residuals[i] * fitted.residuals[i];
  }
  return sum;
}

/// The fraction of `simulated` residuals with at least this ratio of the fourth moment to the
/// square of the second: a few outlying points are not an error of all points.
double tails_p(std::span<const double> residuals, const Samples& simulated) {
  const auto tails = [](std::span<const double> r) {
    double second = 0.0, fourth = 0.0;
    for (const double value : r) {
      second += value * value;
      fourth += value * value * value * value;
    }
    return second > 0.0 ? fourth / (second * second) : 0.0;
  };
  const double own = tails(residuals);
  const auto as_large = std::ranges::count_if(
      simulated, [&](const std::vector<double>& r) { return tails(r) >= own; });
  return (1.0 + static_cast<double>(as_large)) / (1.0 + static_cast<double>(simulated.size()));
}

/// The smaller p-value of structure and tails of the residuals, corrected for two tests.
double remaining_p(const SearchBase& base, const Observations& data, const FitResult& fitted,
                   const Refit& refit) {
  const StructureStatistics statistics(data, fitted.weights, refit, fitted.prediction_squared);
  const Samples simulated = statistics.residuals_of_noise(base.noise);
  const Structure structure = judge_structure(statistics, refit.residuals, statistics(simulated));
  return std::min(1.0, 2.0 * std::min(structure.p_value, tails_p(refit.residuals, simulated)));
}

/// The fit of the base model under the errors of `datasets` and `noise`.
FitResult fit_under(const SearchBase& base, const std::vector<Dataset>& datasets, NoiseSpec noise) {
  if (base.fitted.data.share(SharedBy::setting)) {
    noise.setting_sd = base.fitted.weights.noise.setting_sd;
  }
  FitOptions options;
  options.several_starts = false;
  options.start = base.fitted.theta;
  return fit(base.candidate.model, gather(datasets, noise), options);
}

/// The reading of a rebound: a height [m], or a time of flight [s].
double reading_of(const ImpactPoint& point, UnstatedSource source) {
  return source == UnstatedSource::height_readings
             ? rebound_height(point)
             : 2.0 * point.restitution * point.incident_velocity / standard_gravity;
}

/// The sd of e over the sd of a reading [1/m or 1/s].
double slope_of_reading(const ImpactPoint& point, UnstatedSource source) {
  const double e = point.restitution;
  const double v = point.incident_velocity;
  return source == UnstatedSource::height_readings
             ? standard_gravity / (e * v * v)
             : std::sqrt(1.0 + e * e) * standard_gravity / (2.0 * v);
}

FitResult fit_with_reading_errors(const SearchBase& base, UnstatedSource source, double sd) {
  std::vector<Dataset> datasets = base.datasets;
  for (Dataset& dataset : datasets) {
    for (ImpactPoint& point : dataset.points) {
      if (!(point.restitution > 0.0) || !point.restitution_sd) continue;
      point.restitution_sd =
          std::hypot(*point.restitution_sd, sd * slope_of_reading(point, source));
    }
  }
  return fit_under(base, datasets, base.spec.noise);
}

/// The abscissa of the minimum of the parabola through three equidistant points; the middle point
/// if they do not enclose it.
double vertex(double middle, double step, double before, double at, double after) {
  const double curvature = before - 2.0 * at + after;
  if (!(curvature > 0.0)) return middle;
  return middle + step * std::clamp(0.5 * (before - after) / curvature, -1.0, 1.0);
}

/// The error in [least, most] with the smallest `cost`, from the parabola through the best three
/// points of a grid; nullopt if it is at an end of the grid.
template <class Cost>
std::optional<double> best_error(const SearchBase& base, double least, double most,
                                 const Cost& cost) {
  const double step = std::log(most / least) / (steps - 1);
  std::vector<double> costs(steps);
  parallel_over(steps, base.options.threads, [&](std::size_t k) {
    costs[k] = cost(least * std::exp(step * static_cast<double>(k)));
  });
  const auto best = static_cast<std::size_t>(std::ranges::min_element(costs) - costs.begin());
  if (best == 0 || best + 1 == costs.size()) return std::nullopt;
  if (!std::isfinite(costs[best - 1]) || !std::isfinite(costs[best + 1])) return std::nullopt;
  const double middle = std::log(least) + step * static_cast<double>(best);
  return std::exp(vertex(middle, step, costs[best - 1], costs[best], costs[best + 1]));
}

/// The errors of the size that maximises the likelihood of the data.
template <class FitWith>
std::optional<UnstatedErrors> likeliest(const SearchBase& base, UnstatedSource source, double least,
                                        double most, const FitWith& fit_with) {
  const std::optional<double> value = best_error(base, least, most, [&](double sd) {
    const FitResult fitted = fit_with(sd);
    return fitted.usable ? deviance_with_weights(fitted) : INFINITY;
  });
  if (!value) return std::nullopt;
  const FitResult fitted = fit_with(*value);
  if (!fitted.usable) return std::nullopt;
  Candidate one_more = base.candidate;  // the size of the errors is a parameter, too
  ++one_more.free_count;
  const auto [refit, criterion, chi2] = refit_over_laws(
      one_more, fitted.data, fitted.weights,
      refit_candidate(base.candidate, fitted.data, fitted.weights, fitted.theta, 1), base.laws);
  if (!refit.usable) return std::nullopt;
  UnstatedErrors found;
  found.source = source;
  found.value = *value;
  found.delta_aicc =
      criterion + deviance_of_weights(fitted) - base.criterion - deviance_of_weights(base.fitted);
  found.remaining_p = remaining_p(base, fitted.data, fitted, refit);
  return found;
}

std::optional<UnstatedErrors> velocity_errors(const SearchBase& base) {
  const bool stated = std::ranges::any_of(
      base.fitted.data.points, [](const Observation& point) { return point.velocity_sd > 0.0; });
  if (stated) return std::nullopt;
  return likeliest(base, UnstatedSource::velocity_errors, smallest_error, largest_error,
                   [&](double relative_sd) {
                     NoiseSpec noise = base.spec.noise;
                     noise.velocity_errors = true;
                     noise.velocity_relative_sd = relative_sd;
                     return fit_under(base, base.datasets, noise);
                   });
}

/// The quantity that the instrument of all datasets reads; nullopt without a common one.
std::optional<UnstatedSource> readings_of(const std::vector<Dataset>& datasets) {
  const auto all_by = [&](Method method) {
    return std::ranges::all_of(datasets,
                               [&](const Dataset& one) { return one.system.method == method; });
  };
  if (all_by(Method::drop_heights)) return UnstatedSource::height_readings;
  if (all_by(Method::bounce_intervals)) return UnstatedSource::time_readings;
  return std::nullopt;
}

std::optional<UnstatedErrors> reading_errors(const SearchBase& base) {
  const std::optional<UnstatedSource> source = readings_of(base.datasets);
  if (!source) return std::nullopt;
  std::vector<double> readings;
  for (const Dataset& dataset : base.datasets) {
    for (const ImpactPoint& point : dataset.points) {
      if (point.restitution > 0.0) readings.push_back(reading_of(point, *source));
    }
  }
  if (readings.empty()) return std::nullopt;
  const auto middle = readings.begin() + static_cast<std::ptrdiff_t>(readings.size() / 2);
  std::nth_element(readings.begin(), middle, readings.end());
  return likeliest(base, *source, smallest_reading * *middle, largest_error * *middle,
                   [&](double sd) { return fit_with_reading_errors(base, *source, sd); });
}

std::optional<UnstatedErrors> larger_deviations(const SearchBase& base) {
  const double chi2 = base.first.chi2;
  const auto dof = static_cast<double>(base.fitted.dof);
  if (dof < 1.0 || chi2 <= dof) return std::nullopt;
  const int free = base.candidate.free_count;
  const double n = dof + free;  // number of points that scatter
  UnstatedErrors found;
  found.source = UnstatedSource::larger_deviations;
  found.value = std::sqrt(chi2 / dof);
  found.delta_aicc = corrected_criterion(base.fitted.data, n * std::log(chi2 / n) + n, free + 1) +
                     base.first.discrepancy->log_determinant() -
                     2.0 * std::log(base.laws.sizes.front().prior) - base.criterion;
  Observations unsized = base.fitted.data;
  unsized.noise.sd_stated = false;
  found.remaining_p = remaining_p(base, unsized, base.fitted, base.first);
  return found;
}

/// The columns of the residuals [points x settings] for an error of e of size `sd` that the points
/// of each setting share, whitened for the shared errors of the fit.
Eigen::MatrixXd setting_columns(const SearchBase& base, double sd) {
  const Observations& data = base.fitted.data;
  std::map<std::size_t, Eigen::Index> place;
  for (const Observation& point : data.points) {
    place.try_emplace(point.setting, static_cast<Eigen::Index>(place.size()));
  }
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(data.points.size()),
                                                  static_cast<Eigen::Index>(place.size()));
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    if (point.censored) continue;
    const double square = base.fitted.prediction_squared[i];
    columns(static_cast<Eigen::Index>(i), place[point.setting]) =
        sd * slope_in_restitution(weighted_residual(point, base.fitted.weights.points[i], square,
                                                    data.noise.student),
                                  square);
  }
  whiten_shared(data, base.fitted.weights, columns);
  return columns;
}

bool has_settings_of_several_points(const Observations& data) {
  std::set<std::size_t> seen;
  return std::ranges::any_of(
      data.points, [&](const Observation& point) { return !seen.insert(point.setting).second; });
}

/// Refits the base model under a shared error of settings of size `sd`, and errors of its laws of
/// the size of `start`.
Refit fit_with_settings(const SearchBase& base, const Refit& start, double sd) {
  const Observations& data = base.fitted.data;
  const auto laws = law_error_columns(base.candidate, data, base.fitted.weights, start.theta,
                                      base.laws, start.law_error);
  if (!laws) return {};
  const Eigen::MatrixXd settings = setting_columns(base, sd);
  Eigen::MatrixXd both(settings.rows(), laws->cols() + settings.cols());
  both << *laws, settings;
  return refit_candidate(base.candidate, data, base.fitted.weights, start.theta, 1,
                         std::make_shared<const Discrepancy>(both));
}

std::optional<UnstatedErrors> shared_settings(const SearchBase& base) {
  const Observations& data = base.fitted.data;
  if (base.spec.noise.setting_sd.value_or(0.0) > 0.0 || setting_velocity_error().acts(data)) {
    return std::nullopt;  // the error is stated
  }
  if (!has_settings_of_several_points(data)) return std::nullopt;
  const int free = base.candidate.free_count;
  const Refit& start = base.first;
  const std::optional<double> sd =
      best_error(base, smallest_setting_error, largest_error, [&](double size) {
        const Refit refit = fit_with_settings(base, start, size);
        return refit.usable ? corrected_criterion(data, refit, free + 1) : INFINITY;
      });
  if (!sd) return std::nullopt;
  const Refit refit = fit_with_settings(base, start, *sd);
  if (!refit.usable) return std::nullopt;
  UnstatedErrors found;
  found.source = UnstatedSource::shared_setting;
  found.delta_aicc = corrected_criterion(data, refit, free + 1) -
                     2.0 * std::log(base.laws.sizes.front().prior) - base.criterion;
  found.value = std::hypot(*sd, base.fitted.weights.noise.setting_sd);
  found.remaining_p = remaining_p(base, data, base.fitted, refit);
  return found;
}

}  // namespace

double height_step(const Dataset& dataset) {
  if (dataset.system.method != Method::drop_heights) return 0.0;
  for (const double step : steps_of_rulers) {
    if (coherence(dataset, step) > coherent) return step;
  }
  return 0.0;
}

double height_step(const std::vector<Dataset>& datasets) {
  double largest = 0.0;
  for (const Dataset& dataset : datasets) largest = std::max(largest, height_step(dataset));
  return largest;
}

std::vector<UnstatedErrors> unstated_errors(const SearchBase& base) {
  if (base.spec.noise.student) return {};
  std::vector<UnstatedErrors> all;
  if (const auto found = shared_settings(base)) all.push_back(*found);
  if (base.fitted.data.noise.sd_stated) {
    for (const auto& found :
         {velocity_errors(base), larger_deviations(base), reading_errors(base)}) {
      if (found) all.push_back(*found);
    }
  }
  std::ranges::sort(all, {}, &UnstatedErrors::delta_aicc);
  return all;
}

}  // namespace recoil
