#pragma once

#include "experiment/imported_points.hpp"

namespace recoil {

/// WebPlotDigitizer's CSV: names of the series in the first line, each over two columns, X and Y in
/// the second; or, for one series, nothing but two columns of numbers. With `axes` and
/// `reading_error` f (part of an axis), the standard deviations are
///   f (max - min) on a linear axis,   V f ln(max / min) on a logarithmic one.
ImportedPoints read_digitised(const ImportRequest& request);

}  // namespace recoil
