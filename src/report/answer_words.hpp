#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"

/// The answer of a diagnosis for someone who was not there.
namespace recoil {

/// Three sentences at most: what is wrong, what it is, and what that gains or what to do next.
std::vector<std::string> answer_sentences(const Diagnosis& diagnosis);

/// What else there is to know, a sentence or two each, the most important first: points that were
/// set aside, values, errors that would do as well, what conditions say must be there.
std::vector<std::string> answer_notes(const Diagnosis& diagnosis);

/// All of that in one text.
std::string answer_words(const Diagnosis& diagnosis);

}  // namespace recoil
