#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"
#include "document/sentence.hpp"

/// Text about a diagnosis.
namespace recoil {

/// A p-value from `simulated` data sets: "p = 0.03", or "p < 0.002" if no data set reached the
/// observed value.
std::string p_words(double p, int simulated);

/// The name of a condition: "ambient pressure".
std::string condition_words(Condition condition);

/// The action of an experiment: "more impacts", "pump the chamber".
std::string doing_words(const NextExperiment& experiment);
/// The name of a rival of an experiment.
std::string rival_words(const std::string& name);

/// The structure that a test looks for: "residuals bend with velocity".
std::string words_of(StructureQuestion question);

/// A block of held-out points: "2.58 um", "1.1 to 4.7 m/s", "wall1990-mica".
std::string fold_words(const Fold& fold, const std::vector<Dataset>& datasets);

/// The names of the first five causes, and the number of the others.
std::string cause_words(const std::vector<std::string>& ids, const char* between = ", ");

/// Warnings about the diagnosis: failed simulations, a failed fit of the extended model.
std::vector<std::string> diagnosis_warnings(const Diagnosis& diagnosis);

/// The cause of what the model leaves, in one line without a full stop; empty if it leaves nothing.
std::string cause_headline(const Diagnosis& diagnosis);

/// The verdict on the model (`verdict_sentence`), then `cause_headline`.
Sentence headline(const Diagnosis& diagnosis);

/// The answer: what is wrong, its cause, and the gain of the extended model or the next step.
std::vector<std::string> answer_sentences(const Diagnosis& diagnosis);

/// Further notes, the most important first: fitted values, unstated errors that explain the misfit
/// as well, effects of the stated conditions.
std::vector<std::string> answer_notes(const Diagnosis& diagnosis);

/// `answer_sentences` and `answer_notes` as one text.
std::string answer_words(const Diagnosis& diagnosis);

}  // namespace recoil
