#pragma once

#include <string>

#include "document/sentence.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/bootstrap_result.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/two_point_comparison.hpp"

/// What intervals and bootstrap have to say, in words. None begins with a capital or ends with a
/// full stop, so that they fit into sentences (`as_sentence`).
namespace recoil {

/// "Wald", "profile", "percentile", "BCa", "studentized".
std::string words_of(IntervalKind kind);

/// Why there is no interval: "the parameter is fixed"; empty where there is one.
std::string missing_words(const Interval& interval);

/// What has to be known beside the interval of `what` ("C_A", "the capture velocity"); empty when
/// nothing.
Sentence note_words(const Interval& interval, const Sentence& what);

/// Why the recommended interval is the one to quote.
std::string recommended_words(const IntervalSet& set);
std::string recommended_words(const CaptureEstimate& capture);

/// Why the intervals of a slot differ; empty when they agree.
Sentence disagreement_words(const FitResult& fitted, std::size_t slot, const IntervalSet& set);

/// By how much the error of `what` depends on the variance function.
Sentence undecided_words(const Sentence& what, double factor);

/// That the impacts differ too much for the interval of `what`.
Sentence wide_spread_words(const Sentence& what, double event_spread);

/// Why the scheme was used, and what it does.
std::string scheme_words(const BootstrapResult& bootstrap);

/// Which refits failed, with which data; empty when none did.
std::string failures_words(const BootstrapResult& bootstrap, const Observations& data);

/// What the minimiser said in the first of them.
std::string failure_message(const FailedReplicates& failures);

/// Why nothing is held out when two points are compared with all; empty where something is.
std::string held_out_words(const TwoPointComparison& comparison);

/// How far chance alone moves the ends of the intervals; empty without any.
std::string chance_words(const BootstrapResult& bootstrap);

}  // namespace recoil
