#pragma once

#include "report/report.hpp"

namespace recoil::sample {

/// A filled analysis of four diameters, 32 points, made without fitting anything: what the writers
/// need, with numbers of a plausible size.
Analysis four_diameters();

/// Two datasets fitted together, f0 free per dataset, captured points, no stated deviations.
Analysis two_datasets();

/// What each correction of a pairing does, in numbers of a plausible size; one row without a fit.
CorrectionStudy corrections(std::size_t size_classes);

}  // namespace recoil::sample
