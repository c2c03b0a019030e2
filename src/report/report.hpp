#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "document/document.hpp"
#include "estimate/fit.hpp"
#include "experiment/correction_study.hpp"
#include "predict/capture_comparison.hpp"
#include "predict/law_choice.hpp"
#include "predict/polydisperse.hpp"
#include "predict/validity.hpp"
#include "uncertainty/uncertainty_result.hpp"

namespace recoil {

/// All that is known at the end of one fit; the only input of every writer below.
struct Analysis {
  FitSpec spec;
  std::vector<Dataset> datasets;
  FitResult fitted;
  std::vector<Validity> validity;  ///< where the model holds, the worst point of each dataset
  UncertaintyResult uncertainty;
  std::vector<PolydispersePrediction> mixtures;  ///< of datasets that come with a size distribution
  std::vector<CaptureComparison> captures;       ///< beside the older models; may be empty
  std::vector<LawFit> laws;                  ///< the fit under its own law and others; may be empty
  std::vector<CorrectionStudy> corrections;  ///< of a reconstruction that goes by way of events
  bool corrections_outdated = false;         ///< they were made from another fit, dataset or recipe
};

/// This program's version, "0.2.0".
std::string version();

/// The block report that `recoil fit` prints: provenance, fit statistics, variables, correlations,
/// derived quantities, two-point comparison, warnings. At most 100 columns. An unusable fit gets
/// the blocks that it has, and its failure.
std::string text_report(const Analysis& analysis);

/// One self-contained page: plots (inline SVG by gnuplot), tables, provenance; no network, about
/// 1 MB at most. Its scripts save the pictures and explore e(V); without them it is complete.
/// @param diagnosis the section on what the model gets wrong; empty: there is none
/// @pre analysis.fitted.usable
/// @throws ComputationError when gnuplot cannot be run.
std::string html_report(const Analysis& analysis, std::vector<Block> diagnosis = {});

/// A small e(V) picture of the whole fit as SVG, for the index.
/// @throws ComputationError when gnuplot cannot be run.
std::string thumbnail(const Analysis& analysis);
/// The numbers in it, as comma-separated values.
std::string thumbnail_csv(const Analysis& analysis);

}  // namespace recoil
