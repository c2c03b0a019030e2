#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "document/sentence.hpp"

/// A fit in words. Phrases begin with a small letter and have no full stop, so that they fit into
/// sentences (`as_sentence`).
namespace recoil {

/// The equation of motion with its source.
Sentence equation_words(AdhesionLaw law);

/// Does the model fit? With the p-value, or the reason why it cannot be tested.
Sentence quality_words(const FitResult& fitted);

/// Which law of loss the points chose, and how near the others are; empty where they chose none.
Sentence loss_words(const Analysis& analysis);

/// The noise that the fit used and the evidence for it, in clauses with semicolons.
std::string noise_words(const FitResult& fitted);

/// The scale of an estimated variance function: "sd(e) = 0.021".
std::string scale_words(VarianceFunction function, double scale);

/// How the two-point iteration on `dataset` ended, with numbers.
Sentence two_point_words(const FitResult& fitted, std::size_t dataset,
                         const TwoPointResult& result);

/// The warning about residuals that are larger than stated.
Sentence noise_warning(const FitResult& fitted);

/// Warnings about the fit itself, the gravest first.
std::vector<Sentence> fit_warnings(const FitResult& fitted);

/// Warnings of every stage, the gravest first, without repetition; the last are contradictions
/// among the stated inputs, "dataset: sentence".
std::vector<Sentence> all_warnings(const Analysis& analysis);

/// "Wald", "profile", "percentile", "BCa", "studentized".
std::string words_of(IntervalKind kind);

/// Why there is no interval: "the parameter is fixed"; empty where there is one.
std::string missing_words(const Interval& interval);

/// The caution about the interval of `what` ("C_A", "the capture velocity"); empty without one.
Sentence note_words(const Interval& interval, const Sentence& what);

/// The same for a table: "upper limit"; empty for a caution that needs a sentence.
std::string short_note(Caution caution);

/// Why the recommended interval is the one to quote.
std::string recommended_words(const IntervalSet& set);
std::string recommended_words(const CaptureEstimate& capture);

/// Why the intervals of a parameter differ; empty when they agree.
Sentence disagreement_words(const FitResult& fitted, std::size_t slot, const IntervalSet& set);

/// Why the resampling scheme was used, and what it resamples.
std::string scheme_words(const BootstrapResult& bootstrap);

/// Which refits failed, and with which data; empty when none did.
std::string failures_words(const BootstrapResult& bootstrap, const Observations& data);

/// The minimiser's message in the first of them.
std::string failure_message(const FailedReplicates& failures);

/// Why no diameter is held out when two points are compared with all; empty where one is.
std::string held_out_words(const TwoPointComparison& comparison);

/// "f0^0.97 C_A^0.25 (the capture velocity: ...)": the product that a direction stands for.
Sentence direction_words(const FitResult& fitted, const InformationDirection& direction);

/// Which parameters are poorly determined, why, and what to measure.
Sentence identifiability_words(const FitResult& fitted, const UncertaintyResult& uncertainty);

/// Warnings about replicates and capture velocities, one sentence each.
std::vector<Sentence> uncertainty_warnings(const UncertaintyResult& uncertainty,
                                           const Observations& data);

/// Why there is no posterior; empty where there is one.
std::string no_posterior_words(const PosteriorResult& posterior);
/// Why its points cannot be left out one by one; empty where they are.
std::string no_leave_one_out_words(const PosteriorResult& posterior);
/// How well the model predicts points that it has not seen, and which points that cannot be said
/// of; empty without a posterior.
Sentence leave_one_out_words(const Analysis& analysis);

/// "V*(4.9 um)", with the dataset where there are several.
Sentence capture_name(const Analysis& analysis, const CaptureEstimate& capture);

/// "scatter of the points", "particle.youngs_modulus".
std::string source_words(const BudgetEntry& entry, const ImpactModel& model);

/// A quantity with a budget of its errors.
struct BudgetOf {
  Sentence quantity;
  std::string unit;
  const ErrorBudget* budget = nullptr;
};

/// The budgets of all parameters, and of V* at the reference diameter of each dataset.
std::vector<BudgetOf> reference_budgets(const Analysis& analysis);

/// What to measure better first, one sentence for the quantities that have the same largest source
/// of error; empty without uncertain constants.
std::vector<Sentence> budget_sentences(const Analysis& analysis);

/// Constants that the points moved by more than one standard deviation; empty without any.
Sentence moved_words(const Analysis& analysis);

}  // namespace recoil
