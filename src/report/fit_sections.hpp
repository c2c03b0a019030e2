#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "diagnosis/diagnosis_result.hpp"
#include "document/document.hpp"
#include "document/terminal.hpp"

namespace recoil {

/// The result of a fit: first the answer (verdict, V*, parameters, diagnosis, the gravest warning),
/// then the details. The terminal and the page show the same list.
/// @param diagnosis may be null
/// @param diagnosis_page address of its page; empty without one
std::vector<Section> fit_sections(const Analysis& analysis, const Diagnosis* diagnosis = nullptr,
                                  const std::string& diagnosis_page = "");

/// The page of a fit. @pre analysis.fitted.usable
Document fit_document(const Analysis& analysis, const Diagnosis* diagnosis = nullptr,
                      const std::string& diagnosis_page = "");

/// The answer as `recoil fit` prints it, at most 25 lines, or with the details.
std::string fit_text(const Analysis& analysis, Importance least,
                     std::size_t columns = terminal_columns);

/// One self-contained page of less than 1 MB. Its scripts save the pictures and explore e(V).
/// @throws ComputationError when the fit is not usable or gnuplot cannot be run.
std::string fit_html(const Analysis& analysis, const Diagnosis* diagnosis = nullptr,
                     const std::string& diagnosis_page = "");

}  // namespace recoil
