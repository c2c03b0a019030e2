#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "validation/studies/diagnosis_answer.hpp"
#include "validation/studies/hidden_effects_plan.hpp"
#include "validation/studies/study_stamp.hpp"

namespace hidden {

/// Rows: what was hidden (visible effects in designs of several diameters). Columns: what was
/// answered.
struct Confusion {
  std::vector<std::string> rows;
  std::vector<std::string> columns;
  std::vector<std::vector<int>> counts;
};
Confusion confusion_of(const std::vector<Answered>& answers);

/// So many of so many.
struct Count {
  int k = 0;
  int n = 0;
};

/// What is asked of the diagnosis. In designs of several diameters and of visible effects unless
/// said otherwise.
enum class Bar {
  named,            ///< named outright
  separable_named,  ///< the same, where the nearest rival leaves a misfit of `separable` or more
  named_or_law,     ///< named, or the cause of which it and all its rivals are laws
  listed,           ///< among named and rivals
  wrong,            ///< a wrong cause named, or one shared by laws among which it is not
  false_alarm,      ///< anything but adequate where nothing is hidden
  outside_unexplained,  ///< an effect outside the catalogue called unexplained
  unstated_named,       ///< a cause named for errors that nobody stated
  unstated_told,        ///< told that such errors would do, where structure is seen
  single_diameter,      ///< not_separable for an effect in a design of one diameter
  unseen,               ///< a visible effect called adequate
  bent_listed,          ///< law bent by 10 %: named, listed, or its shape recognised
  bent_wrong,           ///< the same: a wrong cause named
  bent_unexplained,     ///< the same: unexplained
  other_listed,         ///< made by another published law: named, listed, or its shape recognised
  other_wrong,          ///< the same, also by a dry law beside adhesion: a wrong cause named
  other_unexplained,    ///< by another published law: unexplained
  other_unseen,         ///< the same: called adequate
  base_alarm,           ///< anything but adequate where the losses are bent by 3 %
  impossible_named,     ///< a cause named for an effect of impossible size
  loop_named,           ///< named, or its cause told, after doing what is advised, three times at
                        ///< most
  loop_wrong,           ///< the same: a wrong cause
  dropped_listed,       ///< an effect in drops of spheres of millimetres: named or listed
  dropped_wrong,        ///< the same: a wrong cause named
  settings_named,       ///< a cause named where heights were set wrong
  rounded_named,        ///< a cause named where readings are rounded and nothing is hidden
  rounded_listed,       ///< an effect beside rounding: named or listed
  rounded_wrong,        ///< the same: a wrong cause named
  odd_named,            ///< a cause named where points are misread
  odd_found,            ///< of the points that are misread, those set aside
  odd_accused           ///< of the others, those set aside
};

/// The share that is wanted: at least, or at most.
struct Wanted {
  double share = 0.0;
  bool at_least = true;
};
Wanted wanted_of(Bar bar);

/// No other single cause of the catalogue comes closer than this, so that a name can be given.
inline constexpr double separable = 4.0;

/// Data sets of one kind and strength, and what was answered.
struct PowerRow {
  Arm arm = Arm::effect;
  std::string hidden;  ///< "plastic_yield + probe_plane", "nothing"
  double signal_to_noise = 0.0;
  std::map<std::string, int> designs;  ///< data sets of each
  std::map<Mark, int> marks;
  int n = 0;
};

/// How near the nearest rivals of a visible effect come.
struct RivalRow {
  std::string hidden;
  double signal_to_noise = 0.0;
  std::map<std::string, int> rivals;
  double least = 0.0;
  double median = 0.0;
};

/// The answers had all causes within `margin` of the best in AICc been rivals.
struct MarginRow {
  double margin = 0.0;
  int named = 0, wrong = 0, listed = 0, n = 0;
};

struct AlarmRow {
  std::string design;
  Count alarms;  ///< verdicts other than adequate
  Count low_p;   ///< p below 5 %
};

/// What nature does not have strong enough.
struct UnreachedRow {
  std::string hidden;
  std::string design;
  std::map<double, int> not_made;  ///< data sets by wanted signal-to-noise
  double largest = 0.0;            ///< signal-to-noise that was met
};

struct Times {
  double median = 0.0, nine_of_ten = 0.0, longest = 0.0;  ///< [s], one diagnosis on one thread
  int n = 0;
};

/// What was done in the rounds of those that were told after one or more.
struct LoopEffort {
  double median_events = 0.0;
  double median_rounds = 0.0;
  int at_once = 0;  ///< were told without any
  int n = 0;        ///< after one or more
};

/// All that the page and the picture of the study show.
struct StudyTally {
  recoil::StudyStamp stamp;
  std::uint64_t seed = 0;
  int planned = 0;
  int tried = 0;
  int made = 0;  ///< of the tried: the wanted strength exists
  std::map<Bar, Count> bars;
  int not_named = 0;      ///< visible effects that were not named outright
  int alike = 0;          ///< of these, with a rival nearer than `separable`
  int told_by_cause = 0;  ///< of these, told by the cause that their laws share
  std::vector<RivalRow> rivals;
  std::vector<MarginRow> margins;
  std::vector<PowerRow> powers;
  Confusion confusion;
  std::vector<AlarmRow> alarms;
  Count errors_told_astray;  ///< told of unstated errors where a visible effect is hidden
  std::optional<Times> times;
  std::optional<LoopEffort> loop;
  std::vector<std::string> complaints;  ///< of diagnoses without an answer
  std::vector<UnreachedRow> unreached;
};

/// @param planned how many data sets `answers` would have if all were done
StudyTally tally_of(const std::vector<Answered>& answers, std::size_t planned,
                    const StudySize& size);

std::string tally_json(const StudyTally& tally);
/// @throws recoil::InputError when `file` is not the JSON of such a study
StudyTally read_tally(const std::filesystem::path& file);

}  // namespace hidden

template <>
struct recoil::NamesOf<hidden::Bar> {
  static constexpr std::array<std::string_view, 31> names = {"named",
                                                             "separable_named",
                                                             "named_or_law",
                                                             "listed",
                                                             "wrong",
                                                             "false_alarm",
                                                             "outside_unexplained",
                                                             "unstated_named",
                                                             "unstated_told",
                                                             "single_diameter",
                                                             "unseen",
                                                             "bent_listed",
                                                             "bent_wrong",
                                                             "bent_unexplained",
                                                             "other_listed",
                                                             "other_wrong",
                                                             "other_unexplained",
                                                             "other_unseen",
                                                             "base_alarm",
                                                             "impossible_named",
                                                             "loop_named",
                                                             "loop_wrong",
                                                             "dropped_listed",
                                                             "dropped_wrong",
                                                             "settings_named",
                                                             "rounded_named",
                                                             "rounded_listed",
                                                             "rounded_wrong",
                                                             "odd_named",
                                                             "odd_found",
                                                             "odd_accused"};
};
