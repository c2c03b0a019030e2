#pragma once

#include <string>

#include "diagnosis/candidate_result.hpp"

/// Text about a candidate of a diagnosis.
namespace recoil {

/// A value with its standard error: "3.1", "3.1 +/- 0.2".
std::string value_words(const FoundParameter& parameter);

/// Why the value of a parameter is not possible; empty if it is possible.
std::string implausible_words(const FoundParameter& parameter);

/// Why a candidate that is set aside is not accepted.
std::string because_words(const CandidateResult& candidate);

/// Why a candidate is not accepted as a cause; empty if it is accepted.
std::string set_aside_words(const CandidateResult& candidate);

/// `set_aside_words` in a few words, for a table.
std::string short_set_aside_words(const CandidateResult& candidate);

}  // namespace recoil
