#include "diagnosis/unstated_errors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "diagnosis/search.hpp"
#include "estimate/residual.hpp"
#include "estimate/shared_settings.hpp"

namespace recoil {
namespace {

constexpr double smallest_error = 0.002;  // of a velocity, relative
constexpr double largest_error = 0.15;
constexpr double smallest_setting_error = 2e-4;  // of e
constexpr int steps = 15;

/// Standard deviation of the e^2 of a point that rebounded, with what the errors of V and d make of
/// it [1].
double square_sd(const Observation& point) {
  const double e = point.restitution;
  if (point.weights.mean_sd > 0.0) return 2.0 * e * point.weights.mean_sd;
  return std::hypot(std::max(2.0 * e, point.weights.sd) * point.weights.sd, point.weights.input_sd);
}

/// -2 ln likelihood of a fit whose weights are a part of the question, but for a constant.
double deviance_with_weights(const Observations& data, std::span<const double> residuals) {
  double sum = SharedSettings(data.points).log_determinant();
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    sum += residuals[i] * residuals[i];
    if (!point.censored) sum += 2.0 * std::log(square_sd(point));
  }
  return sum;
}

double deviance_with_weights(const Observations& data, const Refit& refit) {
  return deviance_with_weights(data, refit.residuals) + refit.discrepancy->log_determinant();
}

/// Part of normal samples through the same projection whose fourth moment, beside the square of the
/// second, is as large: a few points far off are not errors that all points have.
double tails_p(const StructureStatistics& statistics, std::span<const double> residuals,
               std::uint64_t seed) {
  const auto tails = [](std::span<const double> r) {
    double second = 0.0, fourth = 0.0;
    for (const double value : r) {
      second += value * value;
      fourth += value * value * value * value;
    }
    return second > 0.0 ? fourth / (second * second) : 0.0;
  };
  const double own = tails(residuals);
  std::vector<double> noise(residuals.size());
  int as_large = 0;
  for (int b = 0; b < quick_samples; ++b) {
    RandomStream random(seed, RandomPurpose::diagnosis, static_cast<std::uint64_t>(b));
    for (double& value : noise) value = random.normal();
    if (tails(statistics.residuals_of_noise(noise)) >= own) ++as_large;
  }
  return (1.0 + as_large) / (1.0 + quick_samples);
}

/// Of the structure and the tails of the residuals, the more striking p-value, paid for both.
double remaining_p(const SearchBase& base, const Observations& data, const Refit& refit,
                   std::span<const double> predicted) {
  const std::uint64_t seed = base.options.seed;
  const double structure = quick_structure(data, refit, predicted, quick_samples, seed).p_value;
  const double tails = tails_p(StructureStatistics(data, refit, predicted), refit.residuals, seed);
  return std::min(1.0, 2.0 * std::min(structure, tails));
}

FitResult fit_with_velocity_errors(const SearchBase& base, double relative_sd) {
  NoiseSpec noise = base.spec.noise;
  noise.velocity_errors = true;
  noise.velocity_relative_sd = relative_sd;
  if (base.fitted.data.shares_settings()) noise.setting_sd = base.fitted.data.noise.setting_sd;
  FitOptions options;
  options.several_starts = false;
  options.start = base.fitted.theta;
  return fit(base.candidate.model, gather(base.datasets, noise), options);
}

/// The abscissa of the minimum of the parabola through three equidistant points; the middle one
/// where they do not enclose it.
double vertex(double middle, double step, double before, double at, double after) {
  const double curvature = before - 2.0 * at + after;
  if (!(curvature > 0.0)) return middle;
  return middle + step * std::clamp(0.5 * (before - after) / curvature, -1.0, 1.0);
}

/// The relative error of the velocities that makes the data most likely; none where it is on the
/// edge of what was tried.
std::optional<double> likeliest_velocity_error(const SearchBase& base) {
  const double step = std::log(largest_error / smallest_error) / (steps - 1);
  std::vector<double> deviance(steps, INFINITY);
  parallel_over(steps, base.options.threads, [&](std::size_t k) {
    const double tried = smallest_error * std::exp(step * static_cast<double>(k));
    const FitResult fitted = fit_with_velocity_errors(base, tried);
    if (fitted.usable) deviance[k] = deviance_with_weights(fitted.data, fitted.residuals);
  });
  const auto best = static_cast<std::size_t>(std::min_element(deviance.begin(), deviance.end()) -
                                             deviance.begin());
  if (best == 0 || best + 1 == deviance.size()) return std::nullopt;
  if (!std::isfinite(deviance[best - 1]) || !std::isfinite(deviance[best + 1])) return std::nullopt;
  const double middle = std::log(smallest_error) + step * static_cast<double>(best);
  return std::exp(vertex(middle, step, deviance[best - 1], deviance[best], deviance[best + 1]));
}

std::optional<UnstatedErrors> velocity_errors(const SearchBase& base) {
  const Observations& data = base.fitted.data;
  const bool some = std::any_of(data.points.begin(), data.points.end(),
                                [](const Observation& point) { return point.velocity_sd > 0.0; });
  if (some) return std::nullopt;
  const std::optional<double> relative_sd = likeliest_velocity_error(base);
  if (!relative_sd) return std::nullopt;
  const FitResult fitted = fit_with_velocity_errors(base, *relative_sd);
  if (!fitted.usable) return std::nullopt;
  const Refit refit =
      with_law_errors(base.candidate, fitted.data,
                      refit_candidate(base.candidate, fitted.data, fitted.theta, 1), base.laws);
  if (!refit.usable) return std::nullopt;
  const int free = base.candidate.free_count;
  UnstatedErrors found;
  found.source = ErrorSource::velocity_errors;
  found.value = *relative_sd;
  found.delta_aicc =
      corrected_criterion(fitted.data, deviance_with_weights(fitted.data, refit), free + 1) -
      corrected_criterion(data, deviance_with_weights(data, base.refit), free);
  found.remaining_p = remaining_p(base, fitted.data, refit, fitted.prediction_squared);
  return found;
}

std::optional<UnstatedErrors> larger_deviations(const SearchBase& base) {
  const double chi2 = base.refit.chi2;
  const auto dof = static_cast<double>(base.fitted.dof);
  if (dof < 1.0 || chi2 <= dof) return std::nullopt;
  const int free = base.candidate.free_count;
  const double n = dof + free;  // points that scatter
  UnstatedErrors found;
  found.source = ErrorSource::larger_deviations;
  found.value = std::sqrt(chi2 / dof);
  found.delta_aicc = corrected_criterion(base.fitted.data, n * std::log(chi2 / n) + n, free + 1) -
                     corrected_criterion(base.fitted.data, chi2, free);
  Observations unsized = base.fitted.data;
  unsized.sd_stated = false;
  found.remaining_p = remaining_p(base, unsized, base.refit, base.fitted.prediction_squared);
  return found;
}

/// What an error of e of size `sd`, shared by the points of each setting, adds to the residuals,
/// beside what the fit says that they share.
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
        sd * slope_in_restitution(weighted_residual(point, square, data.noise.student), square);
  }
  whiten_settings(data, columns);
  return columns;
}

bool has_settings_of_several_points(const Observations& data) {
  std::set<std::size_t> seen;
  return std::any_of(data.points.begin(), data.points.end(),
                     [&](const Observation& point) { return !seen.insert(point.setting).second; });
}

/// The base model refitted with what its laws and the settings share.
Refit fit_with_settings(const SearchBase& base, double sd) {
  const Observations& data = base.fitted.data;
  const auto laws = law_error_columns(base.candidate, data, base.refit.theta, base.laws);
  if (!laws) return {};
  const Eigen::MatrixXd settings = setting_columns(base, sd);
  Eigen::MatrixXd both(settings.rows(), laws->cols() + settings.cols());
  both << *laws, settings;
  return refit_candidate(base.candidate, data, base.refit.theta, 1,
                         std::make_shared<const Discrepancy>(both));
}

std::optional<UnstatedErrors> shared_settings(const SearchBase& base) {
  const Observations& data = base.fitted.data;
  if (base.spec.noise.setting_sd.value_or(0.0) > 0.0) return std::nullopt;  // somebody knows it
  if (!has_settings_of_several_points(data)) return std::nullopt;
  const int free = base.candidate.free_count;
  const double step = std::log(largest_error / smallest_setting_error) / (steps - 1);
  std::vector<double> criterion(steps, INFINITY);
  parallel_over(steps, base.options.threads, [&](std::size_t k) {
    const double sd = smallest_setting_error * std::exp(step * static_cast<double>(k));
    const Refit refit = fit_with_settings(base, sd);
    if (refit.usable) criterion[k] = corrected_criterion(data, refit, free + 1);
  });
  const auto best = static_cast<std::size_t>(std::min_element(criterion.begin(), criterion.end()) -
                                             criterion.begin());
  if (best == 0 || best + 1 == criterion.size()) return std::nullopt;
  const double middle = std::log(smallest_setting_error) + step * static_cast<double>(best);
  UnstatedErrors found;
  found.source = ErrorSource::shared_setting;
  found.value =
      std::exp(vertex(middle, step, criterion[best - 1], criterion[best], criterion[best + 1]));
  const Refit refit = fit_with_settings(base, found.value);
  if (!refit.usable) return std::nullopt;
  found.delta_aicc = corrected_criterion(data, refit, free + 1) - base.criterion;
  found.value = std::hypot(found.value, data.noise.setting_sd);
  found.remaining_p = remaining_p(base, data, refit, base.fitted.prediction_squared);
  return found;
}

}  // namespace

std::vector<UnstatedErrors> unstated_errors(const SearchBase& base) {
  if (base.spec.noise.student) return {};
  std::vector<UnstatedErrors> all;
  if (const auto found = shared_settings(base)) all.push_back(*found);
  if (base.fitted.data.sd_stated) {
    for (const auto& found : {velocity_errors(base), larger_deviations(base)}) {
      if (found) all.push_back(*found);
    }
  }
  std::sort(all.begin(), all.end(), [](const UnstatedErrors& a, const UnstatedErrors& b) {
    return a.delta_aicc < b.delta_aicc;
  });
  return all;
}

}  // namespace recoil
