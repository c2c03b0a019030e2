#pragma once

#include <vector>

#include "report/report.hpp"

namespace recoil {

/// f0 against radius with f0 ~ r^(1/3) (Fig. 8 of Li, Dunn & Brach 1999), all datasets.
std::vector<Figure> adhesion_force_figures(const Analysis& analysis);

/// The four contact forces against time (Fig. 6 there), one picture per dataset: reference
/// diameter, and 5.2 m/s where the data reach it, the geometric middle of their range elsewhere.
std::vector<Figure> force_history_figures(const Analysis& analysis);

}  // namespace recoil
