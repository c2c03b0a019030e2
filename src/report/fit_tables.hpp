#pragma once

#include <vector>

#include "analysis/analysis.hpp"
#include "document/document.hpp"

/// The tables of a fit, for the terminal and the page. A table without rows has nothing to show.
namespace recoil {

/// Name of a dataset among the others of its fit: its surface where all surfaces differ, else its
/// id.
std::string short_name(const std::vector<Dataset>& datasets, std::size_t dataset);

/// Capture velocity and its interval by diameter, one column per dataset.
Table capture_table(const Analysis& analysis);

/// Estimate, standard error and recommended interval of every parameter.
Table parameters_table(const Analysis& analysis);

/// Every kind of interval of every free parameter.
Table intervals_table(const Analysis& analysis);

/// Correlations above 0.1 in magnitude, the largest first.
Table correlations_table(const Analysis& analysis);

/// Stated and fitted value of every uncertain constant of the materials.
Table constants_table(const Analysis& analysis);

/// Estimates and profile intervals beside those with exact materials.
Table conditional_table(const Analysis& analysis);

/// Share of every source of error in the variance of each parameter and of V* at each reference
/// diameter [%] (JCGM 100:2008, 5.1).
Table budget_table(const Analysis& analysis);

/// Mean, deviation and interval of the posterior, with the convergence of the sampler.
Table posterior_table(const Analysis& analysis);

/// The two-point calibration of one dataset beside the full fit.
/// C_H, C_A and f0 by two points, by all points with the same f0, and with f0 fitted.
Table two_point_table(const Analysis& analysis, const TwoPointComparison& comparison);
Table two_point_spread_table(const Analysis& analysis, const TwoPointComparison& comparison);

/// How the fit was made and how well it meets the points.
Table statistics_table(const Analysis& analysis);

/// The two bodies of one dataset and the contact that follows from them.
Table materials_table(const Analysis& analysis, std::size_t dataset);
Table contact_table(const Analysis& analysis, std::size_t dataset);

}  // namespace recoil
