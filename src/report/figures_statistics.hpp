#pragma once

#include <vector>

#include "report/report.hpp"

namespace recoil {

/// Weighted residuals against V, one picture per dataset.
std::vector<Figure> residual_velocity_figures(const Analysis& analysis);

/// Weighted residuals against diameter with the mean of each diameter, one picture per dataset.
std::vector<Figure> residual_diameter_figures(const Analysis& analysis);

/// Bootstrap distribution of each free parameter with estimate and recommended interval.
std::vector<Figure> bootstrap_figures(const Analysis& analysis);

}  // namespace recoil
