#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "coverage/coverage.hpp"
#include "diagnosis/diagnosis_result.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"
#include "json/diagnosis_file.hpp"
#include "json/fit_file.hpp"
#include "predict/simulated_impact.hpp"
#include "report/comparison_report.hpp"

/// The JSON files of results. Numbers that do not exist are null, where possible with a reason.
namespace recoil {

DatasetEntry dataset_entry(const Dataset& dataset);

/// The dataset of a simulated impact or of a mixture: id, provenance, sha256.
Json dataset_json(const Dataset& dataset);

/// One check of one impact or fit, without the place of the impact.
ValidityEntry validity_entry(const Validity& check);

/// The ends of an interval; nullopt unless both exist and are finite.
std::optional<Ends> ends_of(const Interval& interval);

/// What the points say of e without a model.
struct RestitutionEntries {
  std::vector<RestitutionMeanEntry> means;
  VelocityDependenceEntry velocity;
  SeriesDifferEntry series;
};
RestitutionEntries restitution_entries(const std::vector<Dataset>& datasets);

/// Puts them into `file`, a FitFile or DiagnosisFile.
template <class File>
void set_restitution(File& file, const std::vector<Dataset>& datasets) {
  RestitutionEntries entries = restitution_entries(datasets);
  file.restitution_summary = std::move(entries.means);
  file.velocity_dependence = std::move(entries.velocity);
  file.series_differ = std::move(entries.series);
}

/// @pre analysis.fitted.usable
FitFile fit_file(const Analysis& analysis);
/// The text of `fit.json`.
std::string fit_json(const Analysis& analysis);

/// The text of `posterior.csv`, the joint draws of the posterior: one column for each slot that
/// moves and each capture velocity, SI units; before them the numbers of the chain and of the draw
/// in it, after them the scale of the noise where it is unknown, ln likelihood and ln prior. Empty
/// without a posterior.
std::string posterior_csv(const Analysis& analysis);

DiagnosisFile diagnosis_file(const Diagnosis& diagnosis);
/// The text of `diagnosis.json`.
std::string diagnosis_json(const Diagnosis& diagnosis);

/// What `recoil compare --json` prints: `fits[]`, and under `quantities[]` what each fit says of
/// one quantity, in the order of the fits (null where a fit does not have it).
/// @throws InputError when the fits are not of the same data. @pre two or more
std::string comparison_json(const std::vector<ComparedFit>& fits);

/// What `recoil coverage --json` prints.
std::string coverage_json(const CoverageResult& result, const FitSpec& spec,
                          const CoverageOptions& options, const std::vector<Dataset>& datasets);

/// What `recoil simulate --json` prints.
/// @param values where the parameters come from: "initial values", or the name of a fit.json
std::string simulation_json(const ImpactModel& model, const std::vector<Dataset>& datasets,
                            const SimulatedImpact& simulated, const std::string& fit,
                            const std::string& values);

/// What `recoil pair --json` prints: the passages that were read, the measuring plane, the impacts,
/// passages without a rebound, and the points.
std::string pairing_json(const PassageTable& table, const PairingResult& pairs,
                         const Averages& averages);

}  // namespace recoil
