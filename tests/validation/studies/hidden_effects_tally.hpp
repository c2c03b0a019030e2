#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "validation/studies/diagnosis_answer.hpp"
#include "validation/studies/hidden_effects_plan.hpp"
#include "validation/studies/study.hpp"

namespace recoil::hidden {

/// Rows: what was hidden (visible effects in designs of several diameters). Columns: what was
/// answered.
struct Confusion {
  std::vector<std::string> rows;
  std::vector<std::string> columns;
  std::vector<std::vector<int>> counts;
  RECOIL_FIELDS(rows, columns, counts)
};

/// So many of so many.
struct Count {
  int k = 0;
  int n = 0;
  RECOIL_FIELDS(k, n)
};

/// What is wanted of the diagnosis: a share of the data sets, at least or at most. Of visible
/// effects in designs of several diameters, unless its words say otherwise.
struct Bar {
  const char* id;
  const char* words;
  double share;
  bool at_least;
  std::function<bool(const Answered&)> among;   ///< the data sets that count
  std::function<bool(const Answered&)> passes;  ///< those with the answer in question
  std::function<double(const Answered&)> ideal =
      {};                         ///< how often an ideal judge gives it; or empty
  int Answered::*part = nullptr;  ///< where points count instead of data sets
  int Answered::*whole = nullptr;
};
const std::vector<Bar>& study_bars();

/// No other single cause of the catalogue comes closer than this, so that a name can be given.
inline constexpr double separable = 4.0;

/// Data sets of one kind and strength, and what was answered.
struct PowerRow {
  Arm arm = Arm::effect;
  std::string hidden;  ///< "plastic_yield + probe_plane", "nothing"
  double signal_to_noise = 0.0;
  std::map<std::string, int> designs;  ///< data sets of each
  std::map<std::string, int> marks;    ///< by the name of the mark
  int n = 0;
  RECOIL_FIELDS(arm, hidden, signal_to_noise, designs, marks, n)

  int marked(Mark mark) const;
};

/// How near the nearest rivals of a visible effect come.
struct RivalRow {
  std::string hidden;
  double signal_to_noise = 0.0;
  std::map<std::string, int> rivals;
  double least = 0.0;
  double median = 0.0;
  RECOIL_FIELDS(hidden, signal_to_noise, rivals, least, median)
};

struct AlarmRow {
  std::string design;
  Count alarms;  ///< verdicts other than adequate
  Count low_p;   ///< p below 5 %
  RECOIL_FIELDS(design, alarms, low_p)
};

/// What nature does not have strong enough.
struct UnreachedRow {
  std::string hidden;
  std::string design;
  struct NotMade {
    double signal_to_noise = 0.0;  ///< wanted
    int n = 0;                     ///< data sets
    RECOIL_FIELDS(signal_to_noise, n)
  };
  std::vector<NotMade> not_made;
  double largest = 0.0;  ///< signal-to-noise that was met
  RECOIL_FIELDS(hidden, design, not_made, largest)
};

struct Times {
  double median = 0.0, nine_of_ten = 0.0, longest = 0.0;  ///< [s], one diagnosis on one thread
  int n = 0;
  RECOIL_FIELDS(median, nine_of_ten, longest, n)
};

/// What was done in the rounds of those that were told after one or more.
struct LoopEffort {
  double median_events = 0.0;
  double median_rounds = 0.0;
  int at_once = 0;  ///< were told without any
  int n = 0;        ///< after one or more
  RECOIL_FIELDS(median_events, median_rounds, at_once, n)
};

/// Visible effects that were not named outright.
struct NotNamed {
  int n = 0;
  int alike = 0;          ///< of these, with a rival nearer than `separable`
  int told_by_cause = 0;  ///< of these, told by the cause that their laws share
  RECOIL_FIELDS(n, alike, told_by_cause)
};

/// What one method answered to the visible effects, and where nothing was hidden.
struct MethodRow {
  std::string method;
  Count named;   ///< the effect alone
  Count listed;  ///< it, alone or among others
  Count wrong;   ///< something that is not there
  Count alarms;  ///< something, where nothing was hidden
  RECOIL_FIELDS(method, named, listed, wrong, alarms)
};

/// What the allowance for errors of the laws costs and brings, where the laws err by `truth`.
struct AllowanceRow {
  std::string truth;
  Count named;        ///< with the allowance: the effect alone
  Count wrong;        ///< with it: something that is not there
  Count exact_named;  ///< if the laws are taken for exact
  Count exact_wrong;
  RECOIL_FIELDS(truth, named, wrong, exact_named, exact_wrong)
};

/// All that the page and the picture of the study show.
struct StudyTally {
  StudyStamp stamp;
  std::uint64_t seed = 0;
  int planned = 0;
  int tried = 0;
  int made = 0;                    ///< of the tried: the wanted strength exists
  std::vector<std::string> whole;  ///< kinds of data sets that were all tried
  Named<Count> bars;               ///< by the id of the bar
  OrAbsent<Named<double>> ideal;   ///< the number that an ideal judge reaches at most
  NotNamed not_named;
  std::vector<RivalRow> rivals;
  std::vector<PowerRow> powers;
  Confusion confusion;
  std::vector<AlarmRow> alarms;
  Count errors_told_astray;  ///< told of unstated errors where a visible effect is hidden
  std::optional<Times> times;
  OrAbsent<LoopEffort> loop;
  std::vector<std::string> complaints;  ///< of diagnoses without an answer
  std::vector<UnreachedRow> unreached;
  OrAbsent<std::vector<MethodRow>> methods;  ///< on the data sets that all were asked of
  OrAbsent<std::vector<AllowanceRow>> allowance;
  RECOIL_FIELDS(seed, planned, tried, made, whole, bars, ideal, not_named, rivals, powers,
                confusion, alarms, errors_told_astray, times, loop, complaints, unreached, methods,
                allowance)

  Count bar(std::string_view id) const;  ///< of no data sets where the study has no such bar
};

/// @param planned how many data sets `answers` would have if all were done
StudyTally tally_of(const std::vector<Answered>& answers, std::size_t planned,
                    const StudySize& size);

Document page_of(const StudyTally& tally);

/// Power against strength, and the confusion matrix, as one picture.
plot::Picture picture_of(const StudyTally& tally);

}  // namespace recoil::hidden
