#pragma once

#include "uncertainty/uncertainty.hpp"

namespace recoil {

/// A parameter counts as identifiable when its recommended interval exists, stays clear of the
/// parameter's bounds, and is narrower than the estimate itself on the lower side (half-width below
/// `widest` times the value). The text names what stands in the way.
Identifiability judge_identifiability(const FitResult& fitted, const Observations& data,
                                      const std::vector<IntervalSet>& intervals,
                                      const std::vector<CaptureEstimate>& capture);

/// The interval that `set.recommended` names.
const Interval& recommended_interval(const IntervalSet& set);

}  // namespace recoil
