#pragma once

#include "analysis/analysis.hpp"

namespace recoil::sample {

/// A filled analysis of four diameters, 32 points, made without fitting anything: what the writers
/// need, with numbers of a plausible size.
Analysis four_diameters();

/// Two datasets fitted together, f0 free per dataset, captured points, no stated deviations.
Analysis two_datasets();

}  // namespace recoil::sample
