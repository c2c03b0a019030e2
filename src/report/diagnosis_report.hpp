#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"
#include "document/document.hpp"
#include "document/terminal.hpp"

/// A diagnosis: its pictures, its text and its page.
namespace recoil {

/// Where the base model is too high or too low, over velocity and diameter; one per dataset.
std::vector<Figure> misfit_figures(const Diagnosis& diagnosis);

/// e(V) of the points under the base and the extended model; one per dataset, none without one.
std::vector<Figure> before_after_figures(const Diagnosis& diagnosis);

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
std::string diagnosis_html(const Diagnosis& diagnosis);

}  // namespace recoil
