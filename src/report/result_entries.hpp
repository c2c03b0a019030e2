#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/fit.hpp"
#include "json/diagnosis_file.hpp"
#include "json/fit_file.hpp"
#include "json/printed_results.hpp"
#include "predict/law_choice.hpp"
#include "predict/validity.hpp"
#include "uncertainty/interval.hpp"

/// What several of the JSON files of results contain.
namespace recoil {

DatasetEntry dataset_entry(const Dataset& dataset);

DatasetReference dataset_reference(const Dataset& dataset);

/// One check of the limits of the model; its dataset is left empty.
ValidityEntry validity_entry(const Validity& check);

OrNull<LawErrorFound> law_error_found(const std::optional<LawErrorEstimate>& laws);

/// The ends of an interval; nullopt unless both exist and are finite.
std::optional<Ends> ends_of(const Interval& interval);

/// Statistics of e that do not depend on a model.
struct RestitutionEntries {
  std::vector<RestitutionMeanEntry> means;
  std::vector<RestitutionRangeEntry> ranges;
  VelocityDependenceEntry velocity;
  SeriesDifferEntry series;
};
RestitutionEntries restitution_entries(const std::vector<Dataset>& datasets,
                                       const ImpactModel& model);

/// Sets these statistics in `file`, a FitFile or DiagnosisFile.
template <class File>
void set_restitution(File& file, const std::vector<Dataset>& datasets, const ImpactModel& model) {
  RestitutionEntries entries = restitution_entries(datasets, model);
  file.restitution_range = std::move(entries.ranges);
  file.restitution_summary = std::move(entries.means);
  file.velocity_dependence = std::move(entries.velocity);
  file.series_differ = std::move(entries.series);
}

/// The verdict on the model, as fit.json and diagnosis.json state it.
FitFile::ModelVerdictFound model_verdict_of(const FitResult& fitted);

}  // namespace recoil
