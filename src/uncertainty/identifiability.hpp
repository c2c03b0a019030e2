#pragma once

#include "uncertainty/noise_alternatives.hpp"
#include "uncertainty/uncertainty.hpp"

namespace recoil {

/// A parameter counts as identifiable when its recommended interval exists and its standard error
/// (times Student's factor where the noise is estimated) is below a tenth of the parameter's scale:
/// the larger of its value and of what alone would make up the whole loss 1 - e^2 at the point that
/// it moves most. That scale hardly depends on the luck of an estimate. Its value alone would, and
/// so would asking whether the interval is clear of zero: both pick the data sets in which the
/// parameter came out large, or in which the interval holds the truth more often than promised
/// (reports/coverage-grid-*.md). A parameter so small that its interval begins at zero can
/// therefore be identifiable; the text then calls it an upper limit. It names what stands in the
/// way of others.
///
/// Where the noise is estimated, its error must not depend on how the noise is seen, either: by
/// more than `undecided` between variance functions that the points cannot decide between, the
/// interval may be too narrow or too wide.
/// Nor may the capture velocity scatter by more than `widest_spread` from impact to impact.
/// @param alternatives of `noise_alternatives`; may be left out where the noise is stated
Identifiability judge_identifiability(const FitResult& fitted,
                                      const std::vector<IntervalSet>& intervals,
                                      const std::vector<CaptureEstimate>& capture,
                                      const std::vector<NoiseAlternative>& alternatives = {});

/// The interval that `set.recommended` names.
const Interval& recommended_interval(const IntervalSet& set);

}  // namespace recoil
