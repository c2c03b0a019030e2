#pragma once

#include <string>
#include <vector>

#include "data/datapackage.hpp"
#include "data/dataset.hpp"
#include "document/document.hpp"
#include "experiment/import.hpp"

/// Text about datasets: provenance, warnings, stated errors, notes of an import.
namespace recoil {

/// One sentence about the origin of the points.
std::string provenance_sentence(Provenance provenance);

/// What the reader has to know about the points first: a banner for each provenance among the
/// datasets, and sentences about restitutions of 0 that count as captures and about angles of
/// incidence.
std::vector<Block> data_banners(const std::vector<Dataset>& datasets);

/// A warning about points: "2 points with a restitution above 1 (first in line 5): ...".
std::string warning_sentence(const DatasetWarning& warning);

/// "V is the normal component ..., of 12 points at up to 23 degrees"; empty if no point states an
/// angle of incidence above 0.
std::string normal_component_words(const Dataset& dataset);

/// The sizes over which each point averages: "every point averages over 20 to 110 um ...".
std::string mixed_sizes_words(const MeasuredSizes& sizes);

/// The name of a constant: "Young's modulus".
std::string_view words_of_constant(Constant constant);

/// The stated standard deviations of the constants: "particle: Young's modulus 20 %; surface:
/// Poisson's ratio 0.02"; empty if there are none.
std::string stated_errors_words(const ImpactSystem& system);

/// The stated values that are ignored because the materials contradict them.
std::string left_out_sentence(const std::vector<LeftOverride>& left_out);

/// A note of `recoil import` as a sentence.
std::string note_sentence(const ImportNote& note);

}  // namespace recoil
