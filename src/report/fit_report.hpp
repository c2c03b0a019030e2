#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/analysis.hpp"
#include "diagnosis/diagnosis_result.hpp"
#include "document/document.hpp"
#include "document/terminal.hpp"

/// A fit: its pictures, its tables, its text and its page.
namespace recoil {

/// Where points average over sizes.
inline constexpr const char* mean_curve_words =
    "The curve is the mean of the spheres that rebound: it rises again where only the largest do.";

/// e against V of the whole fit: points and curves in one plot, told apart by diameter or, in a fit
/// of several datasets, by dataset.
plot::Picture restitution_overview(const Analysis& analysis, int width, int height);

/// e against V of every diameter: points, fit and its band, two-point calibration, V*; with what
/// `explore_script` needs where it can compute the model.
std::vector<Figure> restitution_figures(const Analysis& analysis);

/// The JavaScript that explores these pictures (explore.js): controls of C_H, C_A, f0 or W and the
/// diameter, the curve for them, its capture velocity and chi2.
std::string_view explore_script();

/// Weighted residuals against V, one picture per dataset.
std::vector<Figure> residual_figures(const Analysis& analysis);

/// V* against diameter beside older capture models, one picture per dataset.
std::vector<Figure> capture_figures(const Analysis& analysis);

/// Capture velocity and its interval by diameter, one column per dataset.
Table capture_table(const Analysis& analysis);

/// Estimate, standard error and recommended interval of every parameter.
Table parameters_table(const Analysis& analysis);

/// Stated and fitted value of every uncertain constant of the materials.
Table constants_table(const Analysis& analysis);

/// Mean, deviation and interval of the posterior, with the convergence of the sampler.
Table posterior_table(const Analysis& analysis);

/// C_H, C_A and f0 by two points, by all points with the same f0, and with f0 fitted.
Table two_point_table(const Analysis& analysis, const TwoPointComparison& comparison);

/// How the fit was made and how well it meets the points.
Table statistics_table(const Analysis& analysis);

/// The constants of every body, and the contact that follows from them on every dataset.
Table materials_table(const Analysis& analysis);
Table contact_table(const Analysis& analysis);

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

/// One self-contained page of less than 1 MB. Its script saves the pictures.
/// @throws ComputationError when the fit is not usable.
std::string fit_html(const Analysis& analysis, const Diagnosis* diagnosis = nullptr,
                     const std::string& diagnosis_page = "");

}  // namespace recoil
