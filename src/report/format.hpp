#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analysis/analysis.hpp"
#include "document/document.hpp"
#include "document/number.hpp"
#include "document/terminal.hpp"

/// Numbers and sizes as text, and lookups in an Analysis that stay in range when a stage was
/// skipped.
namespace recoil {

/// An interval in a table; an empty cell where there is none.
Cell interval_cell(const Interval& interval, const Notation& notation = padded(4));

/// A diameter in micrometres, three or more digits: "4.90".
std::string diameter_text(double diameter);

/// The common unit of several sizes: mm where all are 1 mm or more, else um.
struct SizeUnit {
  double metres;
  const char* name;  ///< in words and tables
  const char* sign;  ///< in pictures: "µm"
};
SizeUnit size_unit(std::span<const double> diameters);
/// The unit of all points.
SizeUnit size_unit(std::span<const Dataset> datasets);
/// A diameter [m] in that unit, without it: "4.90".
std::string size_text(double diameter, const SizeUnit& unit);

/// The same in a picture, in the unit of this one: "4.90 µm", "42.0 mm"
std::string diameter_label(double diameter);
/// "4.9 um", "42 mm"
std::string diameter_words(double diameter);
/// The same, the unit marked as one.
Sentence diameter_sentence(double diameter);

/// The words for one value of an enum.
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

/// "p = 0.03", "p < 1e-6".
std::string p_words(double p);

/// A value with its interval, where it has one: "0.958 [0.912, 0.984]".
Number with_interval(double value, const Interval& interval, const Notation& notation);

/// The capture velocity at the diameter for which the parameters of a dataset are quoted; null
/// where none was found.
const CaptureEstimate* reference_capture(const Analysis& analysis, std::size_t dataset);

/// A page with these sections. The heading of the page stands for the title of the first.
Document page_of(const std::string& title, const std::string& name, std::vector<Section> sections);

/// Every interval of one slot; with the reason filled in when the assessment has none for it.
IntervalSet intervals_of(const Analysis& analysis, std::size_t slot);

/// (label, sentence) of each provenance among the datasets, without repetition.
std::vector<std::pair<std::string, std::string>> provenances(const std::vector<Dataset>& datasets);

/// The conditions of an impact on `dataset` at its reference diameter, under the fit.
ImpactConditions reference_conditions(const Analysis& analysis, std::size_t dataset,
                                      double velocity);

/// Name of a dataset among the others of its fit: its surface where all surfaces differ, else its
/// id.
std::string short_name(const std::vector<Dataset>& datasets, std::size_t dataset);

/// An uncertain constant of a model: "Young's modulus of mica".
std::string constant_words(const ImpactModel& model, std::size_t constant,
                           const std::vector<Dataset>& datasets);

/// A parameter as people write it: the symbol of one of the base model, the words of another. What
/// belongs to one dataset has its short name.
Sentence parameter_words(const ImpactModel& model, std::size_t slot,
                         const std::vector<Dataset>& datasets);

/// Is there no adhesion on `dataset`?
bool without_adhesion(const Analysis& analysis, std::size_t dataset);

/// Is there adhesion on any dataset?
bool adheres_anywhere(const ImpactModel& model);

/// Shown in place of a capture velocity where there is no adhesion.
inline constexpr const char* no_capture_words = "none (no adhesion)";

/// A list of whole sentences: a capital at the start and a full stop at the end. Empty ones are
/// left out.
List list_of_sentences(const std::vector<Sentence>& sentences);

/// A section of the answer, and one that the answer does without.
Section shown_section(const char* id, const char* title, Blocks blocks);
Section detail_section(const char* id, const char* title, Blocks blocks);

}  // namespace recoil
