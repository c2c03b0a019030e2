#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"

/// What a diagnosis has to say, in words.
namespace recoil {

/// The answer in one paragraph for someone who was not there.
std::string answer_words(const Diagnosis& diagnosis);

/// Where the base model misses most, in one sentence; empty where it misses nowhere.
std::string where_words(const Diagnosis& diagnosis);

/// What a question put to the residuals found, if it did: "residuals bend with velocity".
std::string words_of(StructureQuestion question);

/// "2.58 um", "1.1 to 4.7 m/s", "wall1990-mica".
std::string fold_words(const Fold& fold, const std::vector<Dataset>& datasets);

/// Why a parameter cannot have its value; empty where it can.
std::string implausible_words(const FoundParameter& parameter);

/// Why a candidate is not taken for a cause; empty where it is.
std::string set_aside_words(const CandidateResult& candidate);

/// The same in a word or two, for a picture.
std::string short_set_aside_words(const CandidateResult& candidate);

/// What has to be known of the diagnosis as a whole.
std::vector<std::string> diagnosis_warnings(const Diagnosis& diagnosis);

}  // namespace recoil
