#pragma once

#include <vector>

#include "analysis/analysis.hpp"
#include "document/document.hpp"

/// The tables of a fit, for the terminal and the page. A table without rows has nothing to show.
namespace recoil {

/// Capture velocity and its interval by diameter, one column per dataset.
Table capture_table(const Analysis& analysis);

/// Estimate, standard error and recommended interval of every parameter.
Table parameters_table(const Analysis& analysis);

/// Stated and fitted value of every uncertain constant of the materials.
Table constants_table(const Analysis& analysis);

/// Mean, deviation and interval of the posterior, with the convergence of the sampler.
Table posterior_table(const Analysis& analysis);

/// C_H, C_A and f0 by two points, by all points with the same f0, and with f0 fitted.
Table two_point_table(const Analysis& analysis, const TwoPointComparison& comparison);

/// How the fit was made and how well it meets the points.
Table statistics_table(const Analysis& analysis);

/// The constants of every body, and the contact that follows from them on every dataset.
Table materials_table(const Analysis& analysis);
Table contact_table(const Analysis& analysis);

}  // namespace recoil
