#pragma once

#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "document/document.hpp"

/// A dataset as sections, for `recoil check` and Python.
namespace recoil {

/// Properties of a dataset: bodies, columns, points and checksum.
Table dataset_table(const Dataset& dataset);

/// Every series with the ranges of its sizes, velocities and restitutions, and its impacts.
Table series_table(const Dataset& dataset);

std::vector<Section> dataset_sections(const Dataset& dataset);

/// The output of `recoil check`.
std::string dataset_text(const Dataset& dataset, Importance least = Importance::detail);

}  // namespace recoil
