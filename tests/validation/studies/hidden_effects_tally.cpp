#include "validation/studies/hidden_effects_tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/statistics.hpp"

namespace recoil::hidden {
namespace {

using Answers = std::vector<const Answered*>;
using Test = std::function<bool(const Answered&)>;

/// Of the data sets that could be made, those that pass.
Answers those(const std::vector<Answered>& all, const Test& test) {
  Answers some;
  for (const Answered& a : all) {
    if (a.reached && test(a)) some.push_back(&a);
  }
  return some;
}

Count count(const Answers& among, const Test& test) {
  const auto passing =
      std::count_if(among.begin(), among.end(), [&](const Answered* a) { return test(*a); });
  return {static_cast<int>(passing), static_cast<int>(among.size())};
}

Count count(const Bar& bar, const std::vector<Answered>& all) {
  const Answers among = those(all, bar.among);
  if (bar.part == nullptr) return count(among, bar.passes);
  Count points;
  for (const Answered* a : among) {
    points.k += a->*bar.part;
    points.n += a->*bar.whole;
  }
  return points;
}

/// A bar that counts points that are misread, or the others.
Bar points_bar(const char* id, const char* words, double share, bool at_least, int Answered::*part,
               int Answered::*whole) {
  const auto is_odd = [](const Answered& a) { return arm_of(a.order) == Arm::odd; };
  return {id, words, share, at_least, is_odd, {}, {}, part, whole};
}

Test marked(const std::vector<Mark>& marks) {
  return [marks](const Answered& a) {
    return std::find(marks.begin(), marks.end(), mark_of(a)) != marks.end();
  };
}

bool is_visible(const Answered& a) { return a.order.signal_to_noise >= visible; }
/// Named, or its cause of which all that is listed are laws.
bool is_told(const Answered& a) {
  return mark_of(a) == Mark::named || (mark_of(a) == Mark::inside && !a.shared_cause.empty());
}
bool can_be_named(const Answered& a) { return a.ideal && a.ideal->rival.misfit >= separable; }

/// How often an ideal judge names it, if the laws are exact.
double nameable(const Answered& a) { return a.ideal->rival.nameable(); }
/// How often he tells its cause, by its own name or by that of all its laws.
double tellable(const Answered& a) { return a.ideal->other.nameable(); }
/// How often he sees a misfit if the laws may err; or does not.
double seeable(const Answered& a) { return a.ideal->sees; }
double unseeable(const Answered& a) { return 1.0 - a.ideal->sees; }
/// He tells the cause of what he sees: at most so often.
double tellable_and_seeable(const Answered& a) { return std::min(tellable(a), seeable(a)); }

/// Would an ideal judge name it in half of the data sets or more?
bool is_nameable(const Answered& a) { return a.ideal && nameable(a) >= 0.5; }

/// What is hidden is named, if need be on the condition that the laws are exact.
bool is_named_if_exact(const Answered& a) {
  return mark_of(a) == Mark::named || a.exact_named == a.order.effects;
}
bool is_wrong_if_exact(const Answered& a) {
  return !a.exact_named.empty() && a.exact_named != a.order.effects;
}

Test in(Arm arm) {
  return [arm](const Answered& a) { return arm_of(a.order) == arm; };
}
Test seen(Arm arm) {
  return [arm](const Answered& a) { return arm_of(a.order) == arm && is_visible(a); };
}

Test both(Test one, Test other) {
  return [one = std::move(one), other = std::move(other)](const Answered& a) {
    return one(a) && other(a);
  };
}
bool hides(const Answered& a) { return !a.order.effects.empty(); }
bool hides_nothing(const Answered& a) { return a.order.effects.empty(); }
bool sees_structure(const Answered& a) { return a.verdict != "adequate"; }
bool follows_other_law(const Answered& a) { return a.order.other_law; }
bool states_it(const Answered& a) { return states_rounding(a.order); }
bool names_a_cause(const Answered& a) { return a.verdict == "cause_named"; }
bool hints(const Answered& a) { return a.hint; }
/// Named, listed, its shape recognised, or listed as what exact laws would leave.
bool is_hinted(const Answered& a) {
  const Mark mark = mark_of(a);
  return mark == Mark::named || mark == Mark::inside || mark == Mark::resembled ||
         std::find(a.hinted.begin(), a.hinted.end(), a.order.effects.front()) != a.hinted.end();
}
bool tells_of_errors(const Answered& a) { return a.errors_told; }
bool alarms(const Answered& a) { return mark_of(a) != Mark::nothing; }
bool is_wrong(const Answered& a) {
  return mark_of(a) == Mark::wrong || (mark_of(a) == Mark::outside && !a.shared_cause.empty());
}

NotNamed not_named_of(const std::vector<Answered>& all) {
  NotNamed missed;
  for (const Answered* a : those(all, seen(Arm::effect))) {
    if (mark_of(*a) == Mark::named) continue;
    ++missed.n;
    if (can_be_named(*a)) continue;
    ++missed.alike;
    missed.told_by_cause += mark_of(*a) == Mark::inside && !a->shared_cause.empty() ? 1 : 0;
  }
  return missed;
}

std::vector<RivalRow> rivals_of(const std::vector<Answered>& all) {
  std::map<std::pair<std::string, double>, std::pair<RivalRow, std::vector<double>>> rows;
  for (const Answered* a : those(all, in(Arm::effect))) {
    if (!a->ideal || a->ideal->rival.id.empty()) continue;
    auto& [row, misfits] = rows[{a->order.effects.front(), a->order.signal_to_noise}];
    ++row.rivals[a->ideal->rival.id];
    misfits.push_back(a->ideal->rival.misfit);
  }
  std::vector<RivalRow> found;
  for (auto& [key, entry] : rows) {
    auto& [row, misfits] = entry;
    std::sort(misfits.begin(), misfits.end());
    row.hidden = key.first;
    row.signal_to_noise = key.second;
    row.least = misfits.front();
    row.median = misfits[misfits.size() / 2];
    found.push_back(row);
  }
  return found;
}

std::vector<PowerRow> powers_of(const std::vector<Answered>& all) {
  std::map<std::tuple<Arm, std::string, double>, PowerRow> rows;
  for (const Answered& a : all) {
    if (!a.reached) continue;
    std::string name;
    for (const std::string& effect : a.order.effects) name += (name.empty() ? "" : " + ") + effect;
    if (name.empty()) name = "nothing";
    PowerRow& row = rows[{arm_of(a.order), name, a.order.signal_to_noise}];
    row.arm = arm_of(a.order);
    row.hidden = name;
    row.signal_to_noise = a.order.signal_to_noise;
    ++row.designs[a.order.design];
    ++row.marks[std::string(name_of(mark_of(a)))];
    ++row.n;
  }
  std::vector<PowerRow> found;
  for (auto& [key, row] : rows) found.push_back(row);
  return found;
}

std::vector<AlarmRow> alarms_of(const std::vector<Answered>& all) {
  std::vector<AlarmRow> rows;
  for (const std::string_view design : design_ids()) {
    const Answers of = those(all, [&](const Answered& a) {
      return a.order.design == design && a.order.effects.empty() &&
             a.order.readout == Readout::exact;
    });
    rows.push_back({std::string(design), count(of, alarms),
                    count(of, [](const Answered& a) { return a.p_value < 0.05; })});
  }
  return rows;
}

std::vector<UnreachedRow> unreached_of(const std::vector<Answered>& all) {
  std::map<std::pair<std::string, std::string>, std::pair<UnreachedRow, std::map<double, int>>>
      rows;
  for (const Answered& a : all) {
    if (a.reached || a.order.effects.size() != 1) continue;
    auto& [row, not_made] = rows[{a.order.effects.front(), a.order.design}];
    row.hidden = a.order.effects.front();
    row.design = a.order.design;
    ++not_made[a.order.signal_to_noise];
    row.largest = std::max(row.largest, a.signal_to_noise);
  }
  std::vector<UnreachedRow> found;
  for (auto& [key, entry] : rows) {
    found.push_back(std::move(entry.first));
    for (const auto& [strength, n] : entry.second) found.back().not_made.push_back({strength, n});
  }
  return found;
}

std::optional<Times> times_of(const std::vector<Answered>& all) {
  std::vector<double> seconds;
  for (const Answered& a : all) {
    if (a.reached) seconds.push_back(a.seconds);
  }
  if (seconds.empty()) return std::nullopt;
  std::sort(seconds.begin(), seconds.end());
  const auto at = [&](double part) {
    return seconds[static_cast<std::size_t>(part * static_cast<double>(seconds.size() - 1))];
  };
  return Times{at(0.5), at(0.9), seconds.back(), static_cast<int>(seconds.size())};
}

OrAbsent<LoopEffort> loop_of(const std::vector<Answered>& all) {
  LoopEffort effort;
  std::vector<double> events;
  std::vector<double> rounds;
  const Answers loop = those(all, in(Arm::loop));
  for (const Answered* a : loop) {
    if (!is_told(*a)) continue;
    if (a->rounds == 0) {
      ++effort.at_once;
      continue;
    }
    events.push_back(static_cast<double>(a->events));
    rounds.push_back(a->rounds);
  }
  if (loop.empty()) return {};
  effort.n = static_cast<int>(events.size());
  if (effort.n > 0) {
    effort.median_events = median(std::move(events));
    effort.median_rounds = median(std::move(rounds));
  }
  return effort;
}

bool contains(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

/// A method that answers with the mechanisms it takes for true; none: it sees nothing.
MethodRow method_row(const char* method, const Answers& effects, const Answers& nothing,
                     const std::function<std::vector<std::string>(const Answered&)>& ids) {
  const auto truth = [](const Answered& a) { return a.order.effects.front(); };
  return {method, count(effects, [&](const Answered& a) { return ids(a) == a.order.effects; }),
          count(effects, [&](const Answered& a) { return contains(ids(a), truth(a)); }),
          count(effects,
                [&](const Answered& a) {
                  std::vector<std::string> others = ids(a);
                  std::erase(others, truth(a));
                  return !others.empty();
                }),
          count(nothing, [&](const Answered& a) { return !ids(a).empty(); })};
}

OrAbsent<std::vector<MethodRow>> methods_of(const std::vector<Answered>& all) {
  const Test asked = [](const Answered& a) { return a.baseline.has_value(); };
  const Answers effects = those(all, both(seen(Arm::effect), asked));
  const Answers nothing = those(all, both(in(Arm::correct), asked));
  if (effects.empty() && nothing.empty()) return {};
  std::vector<MethodRow> rows = {
      {"recoil", count(effects, marked({Mark::named})),
       count(effects, marked({Mark::named, Mark::inside})), count(effects, is_wrong),
       count(nothing, alarms)},
      method_row("stepwise AICc", effects, nothing,
                 [](const Answered& a) { return a.baseline->stepwise; }),
      method_row("correlation with a Gaussian process", effects, nothing, [](const Answered& a) {
        const std::string& id = a.baseline->correlated;
        return id.empty() ? std::vector<std::string>() : std::vector<std::string>{id};
      })};
  OrAbsent<std::vector<MethodRow>> found;
  found.emplace(std::move(rows));
  return found;
}

Confusion confusion_of(const std::vector<Answered>& answers) {
  Confusion c;
  std::vector<std::string> ids;
  for (const HiddenEffect& effect : hidden_effects()) {
    if (effect.kind == EffectKind::careless) continue;
    c.rows.emplace_back(effect.id);
    if (effect.kind != EffectKind::outside) ids.emplace_back(effect.id);
  }
  c.rows.emplace_back("nothing");
  c.columns = ids;
  const std::vector<Mark> others = {Mark::inside,  Mark::outside,   Mark::unexplained,
                                    Mark::nothing, Mark::resembled, Mark::failed};
  for (const Mark mark : others) c.columns.emplace_back(name_of(mark));
  c.counts.assign(c.rows.size(), std::vector<int>(c.columns.size(), 0));
  const auto index = [](const std::vector<std::string>& list, std::string_view word) {
    return static_cast<std::size_t>(std::find(list.begin(), list.end(), word) - list.begin());
  };
  for (const Answered& a : answers) {
    const Arm arm = arm_of(a.order);
    const bool exact = arm == Arm::effect || arm == Arm::correct || arm == Arm::outside;
    if (!a.reached || !exact) continue;
    if (arm != Arm::correct && a.order.signal_to_noise < visible) continue;
    const std::size_t row =
        index(c.rows, a.order.effects.empty() ? "nothing" : a.order.effects.front());
    const Mark mark = mark_of(a);
    if (std::find(others.begin(), others.end(), mark) != others.end()) {
      ++c.counts[row][index(c.columns, name_of(mark))];
      continue;
    }
    for (const std::string& name : a.named) {
      const std::size_t column = index(c.columns, name);
      if (column < c.columns.size()) ++c.counts[row][column];
    }
  }
  return c;
}

/// The answer if the laws are taken for exact: it is given apart unless the cause is named anyway.
bool exact_names_it(const Answered& a) { return hides(a) && is_named_if_exact(a); }
bool exact_errs(const Answered& a) { return is_wrong(a) || is_wrong_if_exact(a); }

std::vector<AllowanceRow> allowance_of(const std::vector<Answered>& all) {
  const std::vector<std::pair<const char*, Test>> truths = {
      {"exact", seen(Arm::effect)},
      {"bent by 10 %", seen(Arm::bent)},
      {"bent by 20 %", seen(Arm::bent_more)},
      {"another published law", seen(Arm::other_law)},
      {"another published law, of dry contacts beside adhesion", seen(Arm::other_adhesive)},
      {"exact, nothing hidden", in(Arm::correct)},
      {"base bent by 3 %, nothing hidden", in(Arm::base_bent)},
  };
  std::vector<AllowanceRow> rows;
  for (const auto& [truth, among] : truths) {
    const Answers some = those(all, among);
    if (some.empty()) continue;
    const Test named = [](const Answered& a) { return hides(a) && mark_of(a) == Mark::named; };
    rows.push_back({truth, count(some, named), count(some, is_wrong), count(some, exact_names_it),
                    count(some, exact_errs)});
  }
  return rows;
}

/// Of every bar that he is asked of, and whose data sets he knows: his expected number.
OrAbsent<Named<double>> ideal_of(const std::vector<Answered>& all) {
  Named<double> sums;
  for (const Bar& bar : study_bars()) {
    const Answers among = bar.ideal ? those(all, bar.among) : Answers();
    const auto known = [](const Answered* a) { return a->ideal.has_value(); };
    if (among.empty() || !std::all_of(among.begin(), among.end(), known)) continue;
    sums.emplace_back(bar.id, std::accumulate(among.begin(), among.end(), 0.0,
                                              [&](double sum, const Answered* a) {
                                                return sum + bar.ideal(*a);
                                              }));
  }
  OrAbsent<Named<double>> found;
  if (!sums.empty()) found.emplace(std::move(sums));
  return found;
}

}  // namespace

const std::vector<Bar>& study_bars() {
  static const Test effects = seen(Arm::effect);
  static const Test named = marked({Mark::named});
  static const Test listed = marked({Mark::named, Mark::inside});
  static const Test recognised = marked({Mark::named, Mark::inside, Mark::resembled});
  static const Test unexplained = marked({Mark::unexplained});
  static const Test adequate = marked({Mark::nothing});
  static const Test bent = in(Arm::bent);
  static const Test other = in(Arm::other_law);
  static const Test dropped = both(seen(Arm::dropped), hides);
  static const Test rounded = both(seen(Arm::rounded), hides);
  static const std::vector<Bar> bars = {
      {"named", "visible effect named outright", 0.80, true, effects, named, nameable},
      {"separable_named", "the same, where the nearest other cause leaves a misfit of 4 or more",
       0.80, true, both(effects, can_be_named), named},
      {"nameable_named", "the same, where an ideal judge names it in half of the cases or more",
       0.80, true, both(effects, is_nameable), named},
      {"nameable_if_exact", "the same: named, or named on the condition that the laws are exact",
       0.90, true, both(effects, is_nameable), is_named_if_exact},
      {"if_exact_wrong", "visible effect: another cause named on that condition", 0.02, false,
       effects, is_wrong_if_exact},
      {"bent_if_exact_wrong", "the same, law bent by 10 %", 0.08, false, bent, is_wrong_if_exact},
      {"named_or_law", "visible effect named, or the cause of which it and all its rivals are laws",
       0.80, true, effects, is_told, tellable},
      {"listed", "visible effect among named and rivals", 0.95, true, effects, listed, seeable},
      {"wrong", "wrong cause named, or one shared by laws among which it is not", 0.02, false,
       effects, is_wrong},
      {"false_alarm", "false alarms, nothing hidden", 0.05, false, in(Arm::correct), alarms},
      {"outside_unexplained", "outside effect called unexplained", 0.80, true, seen(Arm::outside),
       unexplained},
      {"unstated_named", "unstated errors: a cause named", 0.03, false, in(Arm::careless),
       names_a_cause},
      {"unstated_told", "the same, where structure is seen: told that such errors would explain it",
       0.80, true, both(in(Arm::careless), sees_structure), tells_of_errors},
      {"single_diameter", "one diameter: answered by not_separable", 0.80, true,
       both(in(Arm::single), hides), marked({Mark::inside, Mark::outside}), seeable},
      {"unseen", "visible effect called adequate", 0.05, false, effects, adequate, unseeable},
      {"bent_listed", "law bent by 10 %: among named and rivals, or its shape recognised", 0.90,
       true, bent, recognised, seeable},
      {"hinted",
       "visible effect among named and rivals, its shape recognised, or told as what exact laws "
       "would leave",
       0.95, true, effects, is_hinted},
      {"bent_hinted", "the same, law bent by 10 %", 0.90, true, bent, is_hinted},
      {"false_hint", "nothing hidden: told that exact laws would leave structure", 0.05, false,
       in(Arm::correct), hints},
      {"bent_wrong", "law bent by 10 %: wrong cause named", 0.03, false, bent, is_wrong},
      {"bent_unexplained", "law bent by 10 %: unexplained", 0.10, false, bent, unexplained},
      {"other_listed",
       "made by another published law: among named and rivals, or its shape recognised", 0.90, true,
       other, recognised, seeable},
      {"other_wrong",
       "made by another published law, dry ones beside adhesion included: wrong cause named", 0.03,
       false, follows_other_law, is_wrong},
      {"other_unexplained", "made by another published law: unexplained", 0.10, false, other,
       unexplained},
      {"other_unseen", "made by another published law: called adequate", 0.05, false, other,
       adequate, unseeable},
      {"base_alarm", "nothing hidden, losses of the base model bent by 3 %: alarms", 0.05, false,
       in(Arm::base_bent), alarms},
      {"impossible_named", "effect of impossible size: a cause named", 0.03, false,
       in(Arm::impossible), names_a_cause},
      {"loop_named",
       "after doing what the answer advises, three times at most: named, or the cause told", 0.95,
       true, in(Arm::loop), is_told, tellable_and_seeable},
      {"loop_wrong", "the same: a wrong cause named or told", 0.02, false, in(Arm::loop), is_wrong},
      {"dropped_listed", "drops of spheres of millimetres: among named and rivals", 0.95, true,
       dropped, listed},
      {"dropped_wrong", "the same: wrong cause named", 0.02, false, dropped, is_wrong},
      {"settings_named", "heights set wrong: a cause named", 0.03, false, in(Arm::settings),
       names_a_cause},
      {"rounded_named", "drops read to a finite step, nothing hidden: a cause named", 0.03, false,
       both(in(Arm::rounded), hides_nothing), names_a_cause},
      {"rounded_listed", "the same with an effect: among named and rivals, or its shape recognised",
       0.80, true, rounded, recognised},
      {"rounded_stated_listed", "the same, where the standard deviations include the rounding",
       0.80, true, both(rounded, states_it), recognised},
      {"rounded_wrong", "the same: wrong cause named", 0.03, false, rounded, is_wrong},
      {"odd_named", "a few points misread: a cause named", 0.03, false, in(Arm::odd),
       names_a_cause},
      points_bar("odd_found", "points misread by more than 5 standard deviations: set aside", 0.95,
                 true, &Answered::odd_found, &Answered::odd),
      points_bar("odd_accused", "the points beside them: set aside", 0.01, false,
                 &Answered::accused, &Answered::right)};
  return bars;
}

int PowerRow::marked(Mark mark) const {
  const auto found = marks.find(std::string(name_of(mark)));
  return found == marks.end() ? 0 : found->second;
}

Count StudyTally::bar(std::string_view id) const {
  for (const auto& [name, count] : bars) {
    if (name == id) return count;
  }
  return {};
}

StudyTally tally_of(const std::vector<Answered>& answers, std::size_t planned,
                    const StudySize& size) {
  StudyTally tally;
  tally.seed = size.seed;
  tally.planned = static_cast<int>(planned);
  tally.tried = static_cast<int>(answers.size());
  tally.made = static_cast<int>(those(answers, [](const Answered&) { return true; }).size());
  for (const Bar& bar : study_bars()) tally.bars.emplace_back(bar.id, count(bar, answers));
  tally.not_named = not_named_of(answers);
  tally.ideal = ideal_of(answers);
  tally.rivals = rivals_of(answers);
  tally.powers = powers_of(answers);
  tally.confusion = confusion_of(answers);
  tally.alarms = alarms_of(answers);
  tally.errors_told_astray = count(those(answers, seen(Arm::effect)), tells_of_errors);
  tally.times = times_of(answers);
  tally.loop = loop_of(answers);
  for (const Answered& a : answers) {
    if (a.reached && a.status != 0) {
      tally.complaints.push_back(
          fmt::format("{}: exit status {}: {}", a.order.key(), a.status, a.complaint));
    }
  }
  tally.unreached = unreached_of(answers);
  tally.methods = methods_of(answers);
  tally.allowance = allowance_of(answers);
  return tally;
}

}  // namespace recoil::hidden
