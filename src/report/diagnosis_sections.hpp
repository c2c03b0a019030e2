#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"
#include "document/document.hpp"
#include "document/terminal.hpp"

namespace recoil {

/// The result of a diagnosis: first the answer, then misfit, causes, extended model, next
/// experiments and notes. The terminal and the page show the same list.
std::vector<Section> diagnosis_sections(const Diagnosis& diagnosis);

/// The answer in short, for the page of the fit.
/// @param address of the page of the diagnosis; empty without one
Section diagnosis_summary(const Diagnosis& diagnosis, const std::string& address = "");

/// The page of a diagnosis.
Document diagnosis_document(const Diagnosis& diagnosis);

/// The output of `recoil diagnose`: the answer in at most 25 lines, or with the details.
std::string diagnosis_text(const Diagnosis& diagnosis, Importance least,
                           std::size_t columns = terminal_columns);

/// One self-contained page.
/// @throws ComputationError when gnuplot cannot be run.
std::string diagnosis_html(const Diagnosis& diagnosis);

}  // namespace recoil
