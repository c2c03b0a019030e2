#pragma once

#include "analysis/analysis.hpp"

namespace recoil::sample {

/// An analysis of four diameters and 32 points with plausible numbers, made without a fit.
Analysis four_diameters();

/// A joint fit of two datasets with f0 free per dataset, captured points and no stated deviations.
Analysis two_datasets();

}  // namespace recoil::sample
