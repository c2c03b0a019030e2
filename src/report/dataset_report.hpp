#pragma once

#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "document/document.hpp"
#include "plot/plot.hpp"

/// A dataset as sections, for `recoil check` and Python.
namespace recoil {

/// Properties of a dataset: bodies, columns, points and checksum.
Table dataset_table(const Dataset& dataset);

/// Every series with the ranges of its sizes, velocities and restitutions, and its impacts.
Table series_table(const Dataset& dataset);

/// The readings of e against V, with their errors, and the mean of every series with its interval.
/// @param width [px]
plot::Picture restitution_picture(const Dataset& dataset, int width);

std::vector<Section> dataset_sections(const Dataset& dataset);

/// The output of `recoil check`.
std::string dataset_text(const Dataset& dataset, Importance least = Importance::detail);

}  // namespace recoil
