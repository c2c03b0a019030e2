#include "estimate/noise_doubt.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "estimate/setting_error.hpp"

namespace recoil {
namespace {

/// The ratio of the scatters if one noise scale is estimated for all datasets but their residuals
/// differ: F test of the largest against the smallest mean square, with a Bonferroni correction for
/// all pairs.
std::optional<double> unequal_scales(const FitResult& fitted) {
  const std::size_t datasets = fitted.model.contacts.size();
  if (fitted.data.noise.sd_stated || datasets < 2) return std::nullopt;
  struct Residuals {
    double square = 0.0;
    double count = 0.0;
    double mean() const { return square / count; }
  };
  std::vector<Residuals> squares(datasets);
  for (std::size_t i = 0; i < fitted.residuals.size(); ++i) {
    const Observation& point = fitted.data.points[i];
    if (point.censored) continue;
    squares[point.dataset].square += fitted.residuals[i] * fitted.residuals[i];
    squares[point.dataset].count += 1.0;
  }
  std::erase_if(squares, [](const Residuals& r) { return !(r.count > 2.0) || !(r.square > 0.0); });
  if (squares.size() < 2) return std::nullopt;
  const auto [least, most] = std::ranges::minmax_element(
      squares, [](const auto& a, const auto& b) { return a.mean() < b.mean(); });
  constexpr double level = 0.01;
  const double ratio = most->mean() / least->mean();
  const double pairs = static_cast<double>(datasets * (datasets - 1));
  if (!(gsl_cdf_fdist_Q(ratio, most->count, least->count) * pairs < level)) return std::nullopt;
  return std::sqrt(ratio);
}

/// A doubt about errors shared by the points of a setting that the points cannot determine.
std::optional<NoiseDoubt> doubt_of_settings(const FitResult& fitted) {
  const Observations& data = fitted.data;
  if (!data.noise.setting_sd_estimated) return std::nullopt;
  if (spare_settings(data, fitted.model.free_count()) <= 0) {
    return NoiseDoubt{NoiseDoubt::Cause::few_settings,
                      static_cast<double>(count_settings(data).settings)};
  }
  // Without adhesion e hardly depends on V, so a shared error of V acts like one of e.
  std::map<std::size_t, double> velocity;  // by setting
  bool adheres = false;
  for (const Observation& point : data.points) {
    adheres = adheres || !without_adhesion(fitted.model, point.dataset);
    if (velocity.try_emplace(point.setting, point.velocity).first->second != point.velocity) {
      return std::nullopt;
    }
  }
  if (!adheres) return std::nullopt;
  return NoiseDoubt{NoiseDoubt::Cause::setting_velocity};
}

}  // namespace

std::vector<NoiseDoubt> noise_doubts(const FitResult& fitted) {
  std::vector<NoiseDoubt> doubts;
  const int few = fitted.data.noise.sd_of_few;
  if (few > 0 && fitted.weights.noise.pooled_dof == 0) {
    doubts.push_back({NoiseDoubt::Cause::sd_of_few, static_cast<double>(few)});
  }
  if (const auto ratio = unequal_scales(fitted)) {
    doubts.push_back({NoiseDoubt::Cause::unequal_scales, *ratio});
  }
  if (const auto doubt = doubt_of_settings(fitted)) doubts.push_back(*doubt);
  return doubts;
}

}  // namespace recoil
