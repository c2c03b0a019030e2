#pragma once

#include <string>

#include "plot/plot.hpp"

namespace recoil::plot {

/// The numbers that a picture shows as one table of comma-separated values (RFC 4180), in five
/// digits: a column for every column of its layers, named "LAYER: QUANTITY [UNIT]" (before it the
/// heading of the plot where there are several), pure numbers without a unit. Layers of one plot
/// that begin with the same quantity share its column, "QUANTITY [UNIT]", and its rows where it has
/// the same values there; cells in which a layer has nothing are empty. Layers without a name that
/// show the same quantity are told apart by (2), (3). What an axis calls by a name instead of a
/// number stands by its name. Empty where the picture shows no data.
std::string csv_of(const Picture& picture);

}  // namespace recoil::plot
