#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/analysis.hpp"
#include "document/document.hpp"
#include "document/number.hpp"

/// Numbers, sizes and names as text, and access to parts of an Analysis that may be missing.
namespace recoil {

/// An interval in a table; an empty cell if there is none.
Cell interval_cell(const Interval& interval, const Notation& notation = padded(4));

/// A diameter [m] in micrometres, with at least three digits: "4.90".
std::string diameter_text(double diameter);

/// The common unit of several diameters [m]: mm if all are at least 1 mm, otherwise um.
struct SizeUnit {
  double metres;
  const char* name;  ///< in text and tables
  const char* sign;  ///< in pictures: "µm"
};
SizeUnit size_unit(std::span<const double> diameters);
/// The common unit of the diameters of all points.
SizeUnit size_unit(std::span<const Dataset> datasets);
/// A diameter [m] in this unit, without the unit: "4.90".
std::string size_text(double diameter, const SizeUnit& unit);

/// A diameter [m] with its unit, for a picture: "4.90 µm", "42.0 mm".
std::string diameter_label(double diameter);
/// A diameter [m] with its unit, for text: "4.9 um", "42 mm".
std::string diameter_words(double diameter);
/// `diameter_words` with the unit marked as a unit.
Sentence diameter_sentence(double diameter);

/// The text for one value of an enum.
template <NamedEnum Enum>
struct Phrase {
  Enum value;
  const char* words;
};

/// The entry of `value` in a table with one entry for every value of its enum.
template <class Entry, std::size_t Count>
constexpr const Entry& phrase_for(const Entry (&entries)[Count], decltype(Entry::value) value) {
  static_assert(Count == count_of<decltype(Entry::value)>, "a value has no words");
  return *std::find_if(std::begin(entries), std::end(entries) - 1,
                       [&](const Entry& entry) { return entry.value == value; });
}

/// The date in UTC, that of SOURCE_DATE_EPOCH if it is set: "2026-01-31".
std::string today();

/// "p = 0.03", "p < 1e-6".
std::string p_words(double p);

/// A value with its interval, if there is one: "0.958 [0.912, 0.984]".
Number with_interval(double value, const Interval& interval, const Notation& notation);

/// The capture velocity of a dataset at the diameter nearest to its reference diameter; null if
/// none was found.
const CaptureEstimate* reference_capture(const Analysis& analysis, std::size_t dataset);

/// A page with these sections. The heading of the page replaces the title of the first section.
Document page_of(const std::string& title, const std::string& name, std::vector<Section> sections);

/// All intervals of one slot. Missing intervals state why they are missing.
IntervalSet intervals_of(const Analysis& analysis, std::size_t slot);

/// Label and sentence of each provenance among the datasets, without repetition.
std::vector<std::pair<std::string, std::string>> provenances(const std::vector<Dataset>& datasets);

/// The conditions of an impact at `velocity` [m/s] with the fitted parameters and the reference
/// diameter of the dataset.
ImpactConditions reference_conditions(const Analysis& analysis, std::size_t dataset,
                                      double velocity);

/// A short name for a dataset: its surface if all datasets have different surfaces, otherwise its
/// id.
std::string short_name(const std::vector<Dataset>& datasets, std::size_t dataset);

/// An uncertain constant of a model: "Young's modulus of mica".
std::string constant_words(const ImpactModel& model, std::size_t constant,
                           const std::vector<Dataset>& datasets);

/// The name of a parameter: a symbol for the base model, words for a mechanism. A parameter of one
/// dataset includes its short name.
Sentence parameter_words(const ImpactModel& model, std::size_t slot,
                         const std::vector<Dataset>& datasets);

/// A name with its unit in brackets: "C_H [s/m]"; the name alone for the unit "1".
Sentence name_with_unit(const Sentence& name, std::string_view unit_name);

/// True if there is no adhesion on `dataset`.
bool without_adhesion(const Analysis& analysis, std::size_t dataset);

/// True if there is adhesion on any dataset.
bool adheres_anywhere(const ImpactModel& model);

/// A list of complete sentences (`as_sentence`). Empty sentences are omitted.
List list_of_sentences(const std::vector<Sentence>& sentences);

/// A section of the answer, and a section of the details.
Section shown_section(const char* id, const char* title, Blocks blocks);
Section detail_section(const char* id, const char* title, Blocks blocks);

}  // namespace recoil
