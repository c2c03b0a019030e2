#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/analysis.hpp"
#include "diagnosis/diagnosis_result.hpp"
#include "document/document.hpp"
#include "document/terminal.hpp"

/// Pictures, tables, text and page of a fit.
namespace recoil {

/// A caption for curves of points that average over sizes.
inline constexpr const char* mean_curve_words =
    "The curve is the mean of the rebounds that are seen: it rises again where slow ones are not.";

/// e against V of the whole fit: bands, curves and points in one plot, with one colour and mark for
/// each diameter or, in a fit of several datasets, for each dataset, with one dash for each
/// diameter.
/// @param width, height of the picture [px]
plot::Picture restitution_overview(const Analysis& analysis, int width, int height);

/// What it shows, without the numbers of the fit.
Sentence overview_caption(const Analysis& analysis);

/// The caption of a publication: bodies, provenance, what is drawn, and the result.
Sentence figure_caption(const Analysis& analysis);

/// e against V for every diameter: points, fit with its band, two-point calibration and V*. A
/// figure includes the data for `explore_script` if the script can compute the model.
std::vector<Figure> restitution_figures(const Analysis& analysis);

/// The JavaScript that adds controls to these pictures (explore.js). A reader changes C_H, C_A, f0
/// or W and the diameter, and sees the curve, its capture velocity and its chi2.
std::string_view explore_script();

/// Weighted residuals against V, one picture for each dataset.
std::vector<Figure> residual_figures(const Analysis& analysis);

/// What the laws get wrong, one picture for each dataset: the error g of the laws against V for
/// every size, with its band, and the loss of every point against that of exact laws with the
/// fitted constants, (e_exact^2 - e^2) / (1 - e_exact^2). Empty if no error of the laws is seen.
std::vector<Figure> law_error_figures(const Analysis& analysis);

/// V* against diameter, compared with older capture models, one picture for each dataset.
std::vector<Figure> capture_figures(const Analysis& analysis);

/// Capture velocity with its interval by diameter, one column for each dataset.
Table capture_table(const Analysis& analysis);

/// Estimate, standard error and recommended interval of every parameter.
Table parameters_table(const Analysis& analysis);

/// Stated and fitted value of every uncertain constant of the materials.
Table constants_table(const Analysis& analysis);

/// Mean, standard deviation and interval of the posterior, with the convergence of the sampler.
Table posterior_table(const Analysis& analysis);

/// C_H, C_A and f0 from two points, from all points with the same f0, and with f0 fitted.
Table two_point_table(const Analysis& analysis, const TwoPointComparison& comparison);

/// The method of the fit and its goodness.
Table statistics_table(const Analysis& analysis);

Table materials_table(const Analysis& analysis);
Table contact_table(const Analysis& analysis);

/// The result of a fit, for the terminal and the page: first the answer (verdict, V*, parameters,
/// diagnosis, the most important warning), then the details.
/// @param diagnosis may be null
/// @param diagnosis_page address of the page of the diagnosis; may be empty
std::vector<Section> fit_sections(const Analysis& analysis, const Diagnosis* diagnosis = nullptr,
                                  const std::string& diagnosis_page = "");

/// The page of a fit. @pre analysis.fitted.usable
Document fit_document(const Analysis& analysis, const Diagnosis* diagnosis = nullptr,
                      const std::string& diagnosis_page = "");

/// The output of `recoil fit`: the answer in at most 25 lines, or the answer with the details.
std::string fit_text(const Analysis& analysis, Importance least,
                     std::size_t columns = most_columns);

/// The page as one self-contained file.
/// @throws ComputationError if the fit is not usable
std::string fit_html(const Analysis& analysis, const Diagnosis* diagnosis = nullptr,
                     const std::string& diagnosis_page = "");

}  // namespace recoil
