#pragma once

#include "uncertainty/uncertainty.hpp"

namespace recoil {

/// A parameter counts as identifiable when its recommended interval exists, stays clear of the
/// parameter's bounds, and its standard error (times Student's factor where the noise is estimated)
/// is below a quarter of the parameter's scale: the larger of its value and of what alone would
/// make up the whole loss 1 - e^2 at some point. That scale hardly depends on the luck of an
/// estimate, while the value alone would let those data sets through in which it came out too large,
/// of which the interval then holds the truth less often (reports/coverage-grid-*.md). At a quarter
/// the interval is as wide as the scale, and an estimate of that size four errors clear of zero. The
/// text names what stands in the way.
Identifiability judge_identifiability(const FitResult& fitted, const Observations& data,
                                      const std::vector<IntervalSet>& intervals,
                                      const std::vector<CaptureEstimate>& capture);

/// The interval that `set.recommended` names.
const Interval& recommended_interval(const IntervalSet& set);

}  // namespace recoil
