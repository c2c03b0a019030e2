#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"
#include "document/document.hpp"
#include "report/diagnosis_document.hpp"

namespace recoil {

/// The tables of a diagnosis, each empty when there is nothing to say.
Table structure_table(const Diagnosis& diagnosis);
Table misfit_table(const Diagnosis& diagnosis);
/// @param most so many rows at most
Table candidates_table(const std::vector<CandidateResult>& candidates, std::size_t most);
Table found_parameters_table(const std::vector<CandidateResult>& candidates, std::size_t most);
Table held_out_table(const Diagnosis& diagnosis);
Table both_models_table(const Diagnosis& diagnosis);
Table capture_change_table(const Diagnosis& diagnosis);
Table next_experiment_table(const Diagnosis& diagnosis);
Table expected_table(const Diagnosis& diagnosis);

/// The answer and what else has to be known of it.
std::vector<Block> diagnosis_answer(const Diagnosis& diagnosis);

/// What `recoil diagnose` prints.
std::vector<Section> diagnosis_sections(const Diagnosis& diagnosis);

/// What `recoil diagnose` prints: the answer, the tests, the map, the ranking, the gain. At most
/// 100 columns.
std::string diagnosis_text(const Diagnosis& diagnosis);

/// One self-contained page for someone who was not there: the answer in words, the misfit, the
/// ranking, the fit before and after, what was gained.
/// @throws ComputationError when gnuplot cannot be run.
std::string diagnosis_html(const Diagnosis& diagnosis);

/// The page of a diagnosis.
Document diagnosis_document(const Diagnosis& diagnosis);

/// The same in short for a fit's page: the answer, the misfit, the fit before and after.
/// @param address of the page of the diagnosis; empty: there is none
std::vector<Block> diagnosis_blocks(const Diagnosis& diagnosis, const std::string& address = "");

}  // namespace recoil
