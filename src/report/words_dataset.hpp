#pragma once

#include <string>
#include <vector>

#include "data/datapackage.hpp"
#include "data/dataset.hpp"
#include "document/document.hpp"
#include "estimate/restitution_summary.hpp"
#include "experiment/import.hpp"
#include "predict/validity.hpp"

/// Datasets in words: origin, warnings, stated errors, limits of the model, notes of an import.
namespace recoil {

/// One sentence on the origin of the points; for a reconstruction, that none was measured.
std::string provenance_sentence(Provenance provenance);

/// A banner for each provenance among the datasets.
std::vector<Block> provenance_banners(const std::vector<Dataset>& datasets);

/// "2 points with a restitution above 1 (first in line 5): ..."
std::string warning_sentence(const DatasetWarning& warning);

/// "every point averages over 20 to 110 um (mean 49 um, ...)".
std::string mixed_sizes_words(const MeasuredSizes& sizes);

/// "Young's modulus".
std::string_view words_of_constant(Constant constant);

/// "particle: Young's modulus 20 %; surface: Poisson's ratio 0.02"; empty where all are exact.
std::string stated_errors_words(const ImpactSystem& system);

/// Stated values that were not taken over with the materials of another dataset.
std::string left_out_sentence(const std::vector<LeftOverride>& left_out);

/// "the contact grows to 0.53 of the sphere's radius (100 m/s, 4.9 um); Hertz' theory is good to
/// about 0.3".
std::string validity_sentence(const Validity& validity);

/// The worst of those beyond each limit, with the dataset where there are several.
std::vector<std::string> exceeded_limits(const std::vector<Validity>& validity,
                                         const std::vector<Dataset>& datasets);

/// Quantity, value and limit of one impact.
Table validity_table(const std::vector<Validity>& validity);

/// The mean of every series, whether e depends on V, whether series differ. Nothing without a
/// rebound.
std::vector<Sentence> restitution_sentences(const RestitutionSummary& summary,
                                            const std::vector<Dataset>& datasets);

/// The mean of every series and setting, where there are several.
Table restitution_table(const RestitutionSummary& summary, const std::vector<Dataset>& datasets);

/// A note of `recoil import` as a sentence.
std::string note_sentence(const ImportNote& note);

/// What was read of the two bodies, the columns and the file, as names and values.
Table dataset_table(const Dataset& dataset);

/// Each series with its sizes, velocities, restitutions and impacts.
Table series_table(const Dataset& dataset);

std::vector<Section> dataset_sections(const Dataset& dataset);

/// What `recoil check` prints.
std::string dataset_text(const Dataset& dataset);

}  // namespace recoil
