#pragma once

#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"
#include "document/document.hpp"
#include "document/terminal.hpp"

/// Pictures, text and page of a diagnosis.
namespace recoil {

/// The deviations of the points from the base model against velocity and diameter, one picture for
/// each dataset.
std::vector<Figure> misfit_figures(const Diagnosis& diagnosis);

/// e(V) under the base and the extended model, one picture for each dataset; empty without an
/// extended model.
std::vector<Figure> before_after_figures(const Diagnosis& diagnosis);

/// The result of a diagnosis, for the terminal and the page: first the answer, then misfit, causes,
/// extended model, next experiments and notes.
std::vector<Section> diagnosis_sections(const Diagnosis& diagnosis);

/// The best candidates, for the page of the fit; empty if none gains.
Section closest_causes(const Diagnosis& diagnosis);

/// A short answer, for the page of the fit.
/// @param address of the closest causes; may be empty
Section diagnosis_summary(const Diagnosis& diagnosis, const std::string& address = "");

Document diagnosis_document(const Diagnosis& diagnosis);

/// The output of `recoil diagnose`: the answer, or the answer with the details.
std::string diagnosis_text(const Diagnosis& diagnosis, Importance least,
                           std::size_t columns = most_columns);

std::string diagnosis_html(const Diagnosis& diagnosis);

}  // namespace recoil
