#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "coverage/posterior_check.hpp"
#include "diagnosis/diagnosis_result.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"
#include "predict/simulated_impact.hpp"
#include "report/comparison_report.hpp"

/// The JSON files of results. Missing numbers are null, if possible with a reason.
namespace recoil {

/// The content of fit.json. @pre analysis.fitted.usable
std::string fit_json(const Analysis& analysis);

/// The content of posterior.csv, the draws of the posterior in SI units. Its columns are chain,
/// draw, the sampled slots, the capture velocities, the noise scale if it is sampled, ln likelihood
/// and ln prior. Empty without a posterior.
std::string posterior_csv(const Analysis& analysis);

/// The content of log_likelihood.csv: ln likelihood of every point under the draws of
/// posterior.csv, with the columns chain, draw, 1, 2, ... in the order of `residuals`. Empty if
/// points have no likelihood of their own.
std::string log_likelihood_csv(const Analysis& analysis);

std::string diagnosis_json(const Diagnosis& diagnosis);

/// The output of `recoil compare --json` for at least two fits. `quantities[].fits[]` is in the
/// order of the fits, with null for a fit without this quantity.
/// @throws InputError if the fits are not of the same data
std::string comparison_json(const std::vector<ComparedFit>& fits);

/// The output of `recoil coverage --json`.
std::string coverage_json(const CoverageResult& result, const FitSpec& spec,
                          const CoverageOptions& options, const std::vector<Dataset>& datasets);

/// The output of `recoil coverage --posterior --json`.
std::string posterior_check_json(const PosteriorStudy& study, const PosteriorCheck& check,
                                 const FitSpec& spec, const CoverageOptions& options);

/// The output of `recoil simulate --json`.
/// @param values source of the parameters: "initial values", or the name of a fit.json
std::string simulation_json(const ImpactModel& model, const std::vector<Dataset>& datasets,
                            const SimulatedImpact& simulated, const std::string& fit,
                            const std::string& values);

/// The output of `recoil pair --json`: passages, measuring plane, impacts, passages without a
/// rebound, and points.
std::string pairing_json(const PassageTable& table, const PairingResult& pairs,
                         const Averages& averages);

}  // namespace recoil
