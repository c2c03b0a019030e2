#pragma once

#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "document/document.hpp"

namespace recoil {

/// What was read of the two bodies, the columns and the file, as names and values.
Table dataset_table(const Dataset& dataset);

/// Each series with its sizes, velocities, restitutions and impacts.
Table series_table(const Dataset& dataset);

std::vector<Section> dataset_sections(const Dataset& dataset);

/// What `recoil check` prints.
std::string dataset_text(const Dataset& dataset);

}  // namespace recoil
