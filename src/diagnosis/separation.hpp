#pragma once

#include <vector>

#include "diagnosis/candidate_result.hpp"
#include "diagnosis/search.hpp"

namespace recoil {

/// The probability that the criterion of the true cause is smaller than that of a rival by at least
/// `margin`. The difference is normal with the mean lambda + penalty and the variance 4 lambda
/// (`DiagnosisOptions::margin` derives it).
/// @param lambda the least chi2 of the rival on points without noise [1]
/// @param penalty what the parameters of the rival cost more than those of the cause [1]
double probability_of_naming(double lambda, double penalty, double margin);

/// Sets `separation` and `separation_allowed` of the first possible causes, at most four. Each
/// makes points without noise, and every other possible cause is fitted to them: lambda is the
/// chi2 that is left. For `separation_allowed` the five nearest are fitted again under the errors
/// of their laws: `usual_law_error` for a mechanism, and `law_error_of_base` times this for the
/// base model.
/// @param candidates the best first
void separate(const SearchBase& base, std::vector<CandidateResult>& candidates);

}  // namespace recoil
