#pragma once

#include "experiment/import_table.hpp"

namespace recoil {

/// Heights of one or several balls over time, as video analysis writes them: `time` or `frame`
/// (with
/// --fps), `height` or `pixel` (with --scale, the length of a pixel; without it the fall itself is
/// the scale, g over the measured acceleration).
///
/// Impacts are the minima that stand out of the noise. The flights between them are fitted together
/// by least squares,
///   y = c_k + b_k (t - t_k) - a (t - t_k)^2 / 2,
/// with one a for each ball, without the sample at the minimum, which may lie on either side. Two
/// flights meet at the impact; e = -v_after / v_before and V = -v_before there. The errors follow
/// from the scatter about the parabolas and the covariance of c, b and a. Drag of the air is not
/// taken out.
ImportedPoints read_track(const ImportRequest& request);

}  // namespace recoil
