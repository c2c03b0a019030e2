#pragma once

#include <string>
#include <vector>

#include "data/datapackage.hpp"
#include "data/dataset.hpp"
#include "document/document.hpp"
#include "estimate/restitution_summary.hpp"
#include "experiment/import.hpp"
#include "predict/validity.hpp"

/// Text and tables about datasets: provenance, warnings, stated errors, limits of the model, notes
/// of an import.
namespace recoil {

/// One sentence about the origin of the points.
std::string provenance_sentence(Provenance provenance);

/// One banner for each provenance among the datasets.
std::vector<Block> provenance_banners(const std::vector<Dataset>& datasets);

/// A warning about points: "2 points with a restitution above 1 (first in line 5): ...".
std::string warning_sentence(const DatasetWarning& warning);

/// The sizes over which each point averages: "every point averages over 20 to 110 um ...".
std::string mixed_sizes_words(const MeasuredSizes& sizes);

/// The name of a constant: "Young's modulus".
std::string_view words_of_constant(Constant constant);

/// The stated standard deviations of the constants: "particle: Young's modulus 20 %; surface:
/// Poisson's ratio 0.02"; empty if there are none.
std::string stated_errors_words(const ImpactSystem& system);

/// The stated values that are ignored because the materials contradict them.
std::string left_out_sentence(const std::vector<LeftOverride>& left_out);

/// One check of the limits of the model: "the contact grows to 0.53 of the sphere's radius (100
/// m/s, 4.9 um); Hertz' theory holds up to about 0.3".
std::string validity_sentence(const Validity& validity);

/// For each exceeded limit of the model, a sentence about the impact that exceeds it most.
std::vector<std::string> exceeded_limits(const std::vector<Validity>& validity,
                                         const std::vector<Dataset>& datasets);

/// The checks of one impact: quantity, value and limit.
Table validity_table(const std::vector<Validity>& validity);

/// The mean e of every series, the dependence of e on V, and the difference between series. Empty
/// if nothing rebounded.
std::vector<Sentence> restitution_sentences(const RestitutionSummary& summary,
                                            const std::vector<Dataset>& datasets);

/// The mean e of every series and setting; empty if there is only one.
Table restitution_table(const RestitutionSummary& summary, const std::vector<Dataset>& datasets);

/// A note of `recoil import` as a sentence.
std::string note_sentence(const ImportNote& note);

/// Properties of a dataset: bodies, columns, points and checksum.
Table dataset_table(const Dataset& dataset);

/// Every series with the ranges of its sizes, velocities and restitutions, and its impacts.
Table series_table(const Dataset& dataset);

std::vector<Section> dataset_sections(const Dataset& dataset);

/// The output of `recoil check`.
std::string dataset_text(const Dataset& dataset);

}  // namespace recoil
