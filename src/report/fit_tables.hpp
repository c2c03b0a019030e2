#pragma once

#include <vector>

#include "document/document.hpp"
#include "report/report.hpp"

/// The tables of a fit, for the terminal, the page and whoever asks for a number in them. Each is
/// empty when there is nothing to say.
namespace recoil {

/// "C_H [s/m]"
Sentence labelled(const ParameterSlot& slot);

/// How the fit was made and how well it meets the points, as names and values.
Table statistics_table(const Analysis& analysis);

/// Estimate, standard error and recommended interval of every parameter.
Table parameters_table(const Analysis& analysis);

/// What has to be known of single parameters: bounds, missing intervals.
List parameter_remarks(const Analysis& analysis);

/// Every kind of interval of every free parameter, and why some are missing.
Table intervals_table(const Analysis& analysis);
List missing_intervals(const Analysis& analysis);

/// The larger correlations, the largest first.
Table correlations_table(const Analysis& analysis);

Table capture_table(const Analysis& analysis);

/// Two points beside all points, on one dataset.
Table two_point_table(const Analysis& analysis, const TwoPointComparison& comparison);

Table bootstrap_table(const Analysis& analysis);

/// The two bodies of one dataset, and the contact that they make.
Table materials_table(const Analysis& analysis, std::size_t dataset);
Table contact_table(const Analysis& analysis, std::size_t dataset);

/// What was asked for in the fit file.
Table options_table(const Analysis& analysis);

/// Where the minimisation began and ended.
Table starts_table(const Analysis& analysis);

/// One row per point, of very many the first thousand.
Table points_table(const Analysis& analysis);

}  // namespace recoil
