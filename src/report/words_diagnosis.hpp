#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"

/// A diagnosis in words.
namespace recoil {

/// "p = 0.03", or "p < 0.002" where no simulated data set looked as systematic.
std::string p_words(double p, int simulated);

/// "ambient pressure"
std::string condition_words(Condition condition);

/// What to do, in a few words: "more impacts", "pump the chamber".
std::string doing_words(const NextExperiment& experiment);

/// Why a candidate that is set aside is.
std::string because_words(const CandidateResult& candidate);

/// "C_x = 3 m" of those that were fitted, or that a condition states; of many, as a parameter per
/// series may be, the range.
std::string parameters_words(const CandidateResult& candidate);

/// Where the base model misses most, in one sentence; empty where it misses nowhere.
std::string where_words(const Diagnosis& diagnosis);

/// The causes in words: the first five, and how many more there are.
std::string cause_words(const std::vector<std::string>& ids, const char* between = ", ");

/// What a question put to the residuals found, if it did: "residuals bend with velocity".
std::string words_of(StructureQuestion question);

/// "2.58 um", "1.1 to 4.7 m/s", "wall1990-mica".
std::string fold_words(const Fold& fold, const std::vector<Dataset>& datasets);

/// Why a parameter cannot have its value; empty where it can.
std::string implausible_words(const FoundParameter& parameter);

/// Why a candidate is not taken for a cause; empty where it is.
std::string set_aside_words(const CandidateResult& candidate);

/// The same in a word or two, for a table.
std::string short_set_aside_words(const CandidateResult& candidate);

/// What has to be known of the diagnosis as a whole.
std::vector<std::string> diagnosis_warnings(const Diagnosis& diagnosis);

/// The answer in one line, without a full stop.
std::string headline(const Diagnosis& diagnosis);

/// Three sentences at most: what is wrong, what it is, and what that gains or what to do next.
std::vector<std::string> answer_sentences(const Diagnosis& diagnosis);

/// What else there is to know, a sentence or two each, the most important first: points that were
/// set aside, values, errors that would do as well, what conditions say must be there.
std::vector<std::string> answer_notes(const Diagnosis& diagnosis);

/// All of that in one text.
std::string answer_words(const Diagnosis& diagnosis);

}  // namespace recoil
