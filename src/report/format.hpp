#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "document/document.hpp"
#include "document/number.hpp"
#include "document/terminal.hpp"
#include "report/report.hpp"

/// What the text, JSON and HTML writers say in common: numbers, names, and lookups in an Analysis
/// that never run out of range when a stage was skipped.
namespace recoil {

/// "[0.0027, 0.0035]", or "none".
std::string interval_text(const Interval& interval, int count = 4);

/// The same in a table; an empty cell where there is none.
Cell interval_cell(const Interval& interval, const Notation& notation = padded(4));

/// A diameter in micrometres, three or more digits: "4.90".
std::string diameter_text(double diameter);

/// What sizes are said in where many stand together: spheres in um, balls, all of 1 mm and more, in
/// mm.
struct SizeUnit {
  double metres;
  const char* name;  ///< in words and tables
  const char* sign;  ///< in pictures: "µm"
};
SizeUnit size_unit(std::span<const double> diameters);
/// That of all points.
SizeUnit size_unit(std::span<const Dataset> datasets);
/// A diameter [m] in that unit, without it: "4.90".
std::string size_text(double diameter, const SizeUnit& unit);

/// The same in a picture, in the unit of this one: "4.90 µm", "42.0 mm"
std::string diameter_label(double diameter);
/// "4.9 um", "42 mm"
std::string diameter_words(double diameter);
/// The same, the unit marked as one.
Sentence diameter_sentence(double diameter);

/// `words` with a capital at the start and a full stop at the end; empty stays empty.
std::string as_sentence(std::string words);

/// Every interval of one slot; with the reason filled in when the assessment has none for it.
IntervalSet intervals_of(const Analysis& analysis, std::size_t slot);

/// Which interval is recommended and why, one sentence per kind.
std::vector<Sentence> recommendations(const Analysis& analysis);

/// Why the intervals of a parameter differ, one sentence per parameter of which they do.
std::vector<Sentence> disagreements(const Analysis& analysis);

/// Correlation of two slots from the covariance; 0 when either has no variance.
double correlation(const Analysis& analysis, std::size_t a, std::size_t b);

/// The provenance that makes the least claim among the datasets.
Provenance weakest_provenance(const std::vector<Dataset>& datasets);

/// (label, sentence) of each provenance among the datasets, without repetition.
std::vector<std::pair<std::string, std::string>> provenances(const std::vector<Dataset>& datasets);

/// Warnings of every stage in pipeline order, without repetition. The contradictions of the contact
/// are not among them.
std::vector<Sentence> all_warnings(const Analysis& analysis);

/// What disagrees among the stated inputs, "dataset: sentence".
std::vector<Sentence> all_contradictions(const Analysis& analysis);

/// The two-point comparison of `dataset`, or null.
const TwoPointComparison* two_point_of(const Analysis& analysis, std::size_t dataset);

/// The conditions of the fit's answer for `dataset` at its reference diameter.
ImpactConditions reference_conditions(const Analysis& analysis, std::size_t dataset,
                                      double velocity);

/// Does nothing hold the spheres of `dataset`? See the same of a model.
bool without_adhesion(const Analysis& analysis, std::size_t dataset);

/// What stands in the place of a capture velocity then.
inline constexpr const char* no_capture_words = "none (no adhesion)";

/// How the residuals are scaled for display: 1, or the noise level when no deviation was stated.
double residual_unit(const Analysis& analysis);

}  // namespace recoil
