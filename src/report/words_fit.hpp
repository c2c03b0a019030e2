#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "coverage/posterior_check.hpp"
#include "document/sentence.hpp"

/// Text about a fit. Phrases begin with a small letter and have no full stop; `as_sentence` makes
/// sentences of them.
namespace recoil {

/// The equation of motion with its source.
Sentence equation_words(AdhesionLaw law);

/// Why the noise of a fit is not known: "the readings do not scatter".
std::string unknown_noise_reason(const FitResult& fitted);

/// The law of loss with the smallest AICc, and how far the AICc of the others is above it; empty if
/// no laws were compared.
Sentence loss_words(const Analysis& analysis);

/// The name of f0, with the diameter to which it belongs if no point has it: "f0 at 49 um".
Sentence with_its_size(const FitResult& fitted, const Sentence& f0);

/// What the residuals are compared with: "the stated noise"; that of the counts if no e is known.
std::string noise_name(const FitResult& fitted);

/// The noise model of the fit and the evidence for it.
std::string noise_words(const FitResult& fitted);

/// A variance function with its scale: "sd(e) = 0.021".
std::string scale_words(VarianceFunction function, double scale);

/// The result of the two-point calibration on `dataset`.
Sentence two_point_words(const FitResult& fitted, std::size_t dataset,
                         const TwoPointResult& result);

/// The warning that the residuals are larger than the stated noise.
Sentence noise_warning(const FitResult& fitted);

/// Warnings about the fit itself, the most important first.
std::vector<Sentence> fit_warnings(const FitResult& fitted);

/// Warnings of all stages, the most important first, without repetition. Contradictions among the
/// stated inputs are last.
std::vector<Sentence> all_warnings(const Analysis& analysis);

/// The name of a kind of interval: "Wald", "profile", "percentile", "BCa", "studentized".
std::string words_of(IntervalKind kind);

/// Why there is no interval: "the parameter is fixed"; empty if there is one.
std::string missing_words(const Interval& interval);

/// The caution about the interval of `what` ("C_A", "the capture velocity"); empty if there is
/// none.
Sentence note_words(const Interval& interval, const Sentence& what);

/// A caution in a table: "upper limit"; empty if it needs a whole sentence (`note_words`).
std::string short_note(Caution caution);

/// Why this interval is recommended.
std::string recommended_words(const IntervalSet& set);
std::string recommended_words(const CaptureEstimate& capture);

/// Why the intervals of a parameter differ; empty if they agree.
Sentence disagreement_words(const FitResult& fitted, std::size_t slot, const IntervalSet& set);

/// Why this resampling scheme was used, and what it resamples.
std::string scheme_words(const BootstrapResult& bootstrap);

/// The number of failed refits and the points in which their data differ from the others; empty if
/// none failed.
std::string failures_words(const BootstrapResult& bootstrap, const Observations& data);

/// The minimiser's message for the first failed refit.
std::string failure_message(const FailedReplicates& failures);

/// Why the two-point comparison holds out no diameter; empty if it does.
std::string held_out_words(const TwoPointComparison& comparison);

/// The product of powers that a direction in ln theta determines: "f0^0.97 C_A^0.25 (the capture
/// velocity: ...)".
Sentence direction_words(const FitResult& fitted, const InformationDirection& direction);

/// Which parameters are poorly determined, why, and which points would help.
Sentence identifiability_words(const FitResult& fitted, const UncertaintyResult& uncertainty);

/// Warnings about bootstrap replicates and capture velocities.
std::vector<Sentence> uncertainty_warnings(const UncertaintyResult& uncertainty,
                                           const Observations& data);

/// Whether the posterior can be believed, in one sentence.
Sentence posterior_check_words(const PosteriorStudy& study, const PosteriorCheck& check);

/// Why there is no posterior; empty if there is one.
std::string no_posterior_words(const PosteriorResult& posterior);
/// Why there is no leave-one-out estimate; empty if there is one.
std::string no_leave_one_out_words(const PosteriorResult& posterior);
/// The leave-one-out estimate (PSIS-LOO; Vehtari, Gelman & Gabry 2017) and the points for which it
/// is not reliable; empty without a posterior.
Sentence leave_one_out_words(const Analysis& analysis);

/// "V*(4.9 um)", with the dataset if there are several.
Sentence capture_name(const Analysis& analysis, const CaptureEstimate& capture);

/// A source of error: "scatter of the points", "particle.youngs_modulus".
std::string source_words(const BudgetEntry& entry, const ImpactModel& model);

/// The largest source of error of every parameter and of V* at each reference diameter. Quantities
/// with the same source share a sentence. Empty without uncertain constants.
std::vector<Sentence> budget_sentences(const Analysis& analysis);

/// The constants that the fit moves by at least one standard deviation; empty if there are none.
Sentence moved_words(const Analysis& analysis);

}  // namespace recoil
