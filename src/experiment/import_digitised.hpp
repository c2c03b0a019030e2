#pragma once

#include "experiment/import_table.hpp"

namespace recoil {

/// WebPlotDigitizer's CSV: names of the series in the first line, each over two columns, X and Y in
/// the second; or, for one series, two columns of numbers without a header. With `axes` and
/// `reading_error` f (part of an axis), the standard deviations are
///   f (max - min) on a linear axis,   V f ln(max / min) on a logarithmic one.
ImportedPoints read_digitised(const ImportRequest& request);

}  // namespace recoil
