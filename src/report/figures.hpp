#pragma once

#include <string>
#include <vector>

#include "document/document.hpp"
#include "report/report.hpp"

namespace recoil {

/// e against V (log axis) of each diameter: points with error bars, full fit with its band, the
/// two-point curve, the capture velocity with its interval.
std::vector<Figure> restitution_figures(const Analysis& analysis);

/// Weighted residuals against V, one picture per dataset.
std::vector<Figure> residual_velocity_figures(const Analysis& analysis);

/// Weighted residuals against diameter with the mean of each diameter, one picture per dataset.
std::vector<Figure> residual_diameter_figures(const Analysis& analysis);

/// Bootstrap distribution of each free parameter with estimate and recommended interval.
std::vector<Figure> bootstrap_figures(const Analysis& analysis);

/// The replicates of every pair of free parameters, with the profile likelihood of each on the
/// diagonal: one picture, none without replicates. Of more than six, the first six.
std::vector<Figure> corner_figures(const Analysis& analysis);

/// All intervals of one free parameter side by side, with its estimate and its bounds.
std::vector<Figure> interval_figures(const Analysis& analysis);

/// What two points cost, as a function of which two are taken, one per dataset.
std::vector<Figure> pair_figures(const Analysis& analysis);

/// C_H against C_A of every replicate, calibrated by two points and by all, one per dataset.
std::vector<Figure> two_point_figures(const Analysis& analysis);

/// f0 against radius with f0 ~ r^(1/3) (Fig. 8 of Li, Dunn & Brach 1999), all datasets.
std::vector<Figure> adhesion_force_figures(const Analysis& analysis);

/// The four contact forces against time (Fig. 6 there), one picture per dataset: reference
/// diameter, and 5.2 m/s where the data reach it, the geometric middle of their range elsewhere.
std::vector<Figure> force_history_figures(const Analysis& analysis);

/// All points and fitted curves of e(V) in one small picture; `id` is part of its name.
plot::Picture restitution_overview(const Analysis& analysis, const std::string& id);

}  // namespace recoil
