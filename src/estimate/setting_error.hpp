#pragma once

#include <span>
#include <vector>

#include "estimate/error_source.hpp"
#include "estimate/observations.hpp"
#include "estimate/weights.hpp"

namespace recoil {

/// `setting_sd`: sigma, an error of e that the points of one setting share [1], stated or
/// estimated.
const ErrorSource& setting_error();

/// Estimates sigma, the error of e that the points of one setting of the apparatus share, from the
/// scatter between settings, compared with the scatter within them. With m_k the weighted mean
/// deviation of e from the prediction in setting k, v_k its variance from the scatter within
/// settings, and p parameters, sigma solves
///   sum m_k^2 / (v_k + sigma^2) = settings - p
/// (Paule & Mandel 1982, J. Res. Natl. Bur. Stand. 87, 377-385); 0 without a solution.
/// @param predicted predicted e^2 [points]
/// @param trends functions that the m_k may contain and that are removed by weighted least squares,
///   each at the cost of one parameter [functions][points]
double estimated_setting_error(const Observations& data, const Weights& weights,
                               std::span<const double> predicted, int free_count,
                               std::span<const std::vector<double>> trends = {});

/// The sigma of a fit with these predictions: the stated one; else estimated together with an
/// offset of every series, and limited to the error of e that the stated errors of V cause; 0 if
/// too few settings are left.
double setting_sd_at(const Observations& data, const Weights& weights,
                     std::span<const double> predicted, int free_count);

/// Settings minus free parameters and differences between series: the number of deviations from
/// which sigma is estimated.
int spare_settings(const Observations& data, int free_count);

/// Is sigma estimated from too few settings to distinguish it from a misfit of the model?
bool too_few_settings(const Observations& data, int free_count);

/// The number of settings whose points share an error, and the number of their points.
struct SettingCount {
  int settings = 0;
  int points = 0;
};
SettingCount count_settings(const Observations& data);

}  // namespace recoil
