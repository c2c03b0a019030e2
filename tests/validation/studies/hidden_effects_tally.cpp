#include "validation/studies/hidden_effects_tally.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "core/statistics.hpp"

namespace hidden {
namespace {

using recoil::Json;

using recoil::name_of;
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

/// Of points instead of data sets.
Count points_of(const Answers& among, int Answered::*part, int Answered::*all) {
  Count points;
  for (const Answered* a : among) {
    points.k += a->*part;
    points.n += a->*all;
  }
  return points;
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
bool can_be_named(const Answered& a) { return a.nearest_rival.misfit >= separable; }

Test in(Arm arm) {
  return [arm](const Answered& a) { return arm_of(a.order) == arm; };
}
Test seen(Arm arm) {
  return [arm](const Answered& a) { return arm_of(a.order) == arm && is_visible(a); };
}

std::map<Bar, Count> bars_of(const std::vector<Answered>& all) {
  const Answers effects = those(all, seen(Arm::effect));
  const Answers nameable =
      those(all, [](const Answered& a) { return seen(Arm::effect)(a) && can_be_named(a); });
  const Answers structured =
      those(all, [](const Answered& a) { return in(Arm::careless)(a) && a.verdict != "adequate"; });
  const Answers single =
      those(all, [](const Answered& a) { return in(Arm::single)(a) && !a.order.effects.empty(); });
  const Answers bent = those(all, in(Arm::bent));
  const Answers other = those(all, in(Arm::other_law));
  const Answers any_other = those(all, [](const Answered& a) { return a.order.other_law; });
  const Test named = marked({Mark::named});
  const Answers loop = those(all, in(Arm::loop));
  const Answers odd = those(all, in(Arm::odd));
  const Answers dropped = those(
      all, [](const Answered& a) { return seen(Arm::dropped)(a) && !a.order.effects.empty(); });
  const Answers unhidden =
      those(all, [](const Answered& a) { return in(Arm::rounded)(a) && a.order.effects.empty(); });
  const Answers beside_rounding = those(
      all, [](const Answered& a) { return seen(Arm::rounded)(a) && !a.order.effects.empty(); });
  const Test names_a_cause = [](const Answered& a) { return a.verdict == "cause_named"; };
  const Test wrong = [](const Answered& a) {
    return mark_of(a) == Mark::wrong || (mark_of(a) == Mark::outside && !a.shared_cause.empty());
  };
  return {{Bar::named, count(effects, named)},
          {Bar::separable_named, count(nameable, named)},
          {Bar::named_or_law, count(effects, is_told)},
          {Bar::loop_named, count(loop, is_told)},
          {Bar::loop_wrong, count(loop, wrong)},
          {Bar::listed, count(effects, marked({Mark::named, Mark::inside}))},
          {Bar::wrong, count(effects, wrong)},
          {Bar::false_alarm, count(those(all, in(Arm::correct)),
                                   [](const Answered& a) { return mark_of(a) != Mark::nothing; })},
          {Bar::outside_unexplained,
           count(those(all, seen(Arm::outside)), marked({Mark::unexplained}))},
          {Bar::unstated_named, count(those(all, in(Arm::careless)), names_a_cause)},
          {Bar::unstated_told, count(structured, [](const Answered& a) { return a.errors_told; })},
          {Bar::single_diameter, count(single, marked({Mark::inside, Mark::outside}))},
          {Bar::unseen, count(effects, marked({Mark::nothing}))},
          {Bar::bent_listed, count(bent, marked({Mark::named, Mark::inside, Mark::resembled}))},
          {Bar::bent_wrong, count(bent, wrong)},
          {Bar::bent_unexplained, count(bent, marked({Mark::unexplained}))},
          {Bar::other_listed, count(other, marked({Mark::named, Mark::inside, Mark::resembled}))},
          {Bar::other_wrong, count(any_other, wrong)},
          {Bar::other_unexplained, count(other, marked({Mark::unexplained}))},
          {Bar::other_unseen, count(other, marked({Mark::nothing}))},
          {Bar::base_alarm, count(those(all, in(Arm::base_bent)),
                                  [](const Answered& a) { return mark_of(a) != Mark::nothing; })},
          {Bar::impossible_named, count(those(all, in(Arm::impossible)), names_a_cause)},
          {Bar::dropped_listed, count(dropped, marked({Mark::named, Mark::inside}))},
          {Bar::dropped_wrong, count(dropped, wrong)},
          {Bar::settings_named, count(those(all, in(Arm::settings)), names_a_cause)},
          {Bar::rounded_named, count(unhidden, names_a_cause)},
          {Bar::rounded_listed,
           count(beside_rounding, marked({Mark::named, Mark::inside, Mark::resembled}))},
          {Bar::rounded_wrong, count(beside_rounding, wrong)},
          {Bar::odd_named, count(odd, names_a_cause)},
          {Bar::odd_found, points_of(odd, &Answered::odd_found, &Answered::odd)},
          {Bar::odd_accused, points_of(odd, &Answered::accused, &Answered::right)}};
}

void count_missed(const std::vector<Answered>& all, StudyTally& tally) {
  for (const Answered* a : those(all, seen(Arm::effect))) {
    if (mark_of(*a) == Mark::named) continue;
    ++tally.not_named;
    if (can_be_named(*a)) continue;
    ++tally.alike;
    tally.told_by_cause += mark_of(*a) == Mark::inside && !a->shared_cause.empty() ? 1 : 0;
  }
}

std::vector<RivalRow> rivals_of(const std::vector<Answered>& all) {
  std::map<std::pair<std::string, double>, std::pair<RivalRow, std::vector<double>>> rows;
  for (const Answered* a : those(all, in(Arm::effect))) {
    if (a->nearest_rival.id.empty()) continue;
    auto& [row, misfits] = rows[{a->order.effects.front(), a->order.signal_to_noise}];
    ++row.rivals[a->nearest_rival.id];
    misfits.push_back(a->nearest_rival.misfit);
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

std::vector<MarginRow> margins_of(const std::vector<Answered>& all) {
  const Answers effects = those(all, seen(Arm::effect));
  std::vector<MarginRow> rows;
  for (const double margin : {0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 9.0}) {
    MarginRow row;
    row.margin = margin;
    row.n = static_cast<int>(effects.size());
    for (const Answered* a : effects) {
      const Mark mark = mark_with_margin(*a, margin);
      row.named += mark == Mark::named ? 1 : 0;
      row.wrong += mark == Mark::wrong ? 1 : 0;
      row.listed += mark == Mark::named || mark == Mark::inside ? 1 : 0;
    }
    rows.push_back(row);
  }
  return rows;
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
    ++row.marks[mark_of(a)];
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
    rows.push_back({std::string(design),
                    count(of, [](const Answered& a) { return mark_of(a) != Mark::nothing; }),
                    count(of, [](const Answered& a) { return a.p_value < 0.05; })});
  }
  return rows;
}

std::vector<UnreachedRow> unreached_of(const std::vector<Answered>& all) {
  std::map<std::pair<std::string, std::string>, UnreachedRow> rows;
  for (const Answered& a : all) {
    if (a.reached || a.order.effects.size() != 1) continue;
    UnreachedRow& row = rows[{a.order.effects.front(), a.order.design}];
    row.hidden = a.order.effects.front();
    row.design = a.order.design;
    ++row.not_made[a.order.signal_to_noise];
    row.largest = std::max(row.largest, a.signal_to_noise);
  }
  std::vector<UnreachedRow> found;
  for (auto& [key, row] : rows) found.push_back(row);
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

std::optional<LoopEffort> loop_of(const std::vector<Answered>& all) {
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
  if (loop.empty()) return std::nullopt;
  effort.n = static_cast<int>(events.size());
  if (effort.n > 0) {
    effort.median_events = recoil::median(std::move(events));
    effort.median_rounds = recoil::median(std::move(rounds));
  }
  return effort;
}

// ---- JSON ------------------------------------------------------------------------------------

Json json_of(const Count& count) { return {{"k", count.k}, {"n", count.n}}; }
Count count_of(const Json& json) { return {json.at("k"), json.at("n")}; }

template <class Enum>
Enum value_of(const std::string& name) {
  const std::optional<Enum> value = recoil::value_named<Enum>(name);
  if (!value) throw std::invalid_argument("'" + name + "' is unknown");
  return *value;
}

Json json_of(const std::map<std::string, int>& counts) {
  Json json = Json::object();
  for (const auto& [name, n] : counts) json[name] = n;
  return json;
}
std::map<std::string, int> counts_of(const Json& json) {
  std::map<std::string, int> counts;
  for (const auto& [name, n] : json.items()) counts[name] = n;
  return counts;
}

Json json_of(const PowerRow& row) {
  Json marks = Json::object();
  for (const auto& [mark, n] : row.marks) marks[std::string(name_of(mark))] = n;
  return {{"arm", name_of(row.arm)},
          {"hidden", row.hidden},
          {"signal_to_noise", row.signal_to_noise},
          {"designs", json_of(row.designs)},
          {"marks", marks},
          {"n", row.n}};
}
PowerRow power_of(const Json& json) {
  PowerRow row;
  row.arm = value_of<Arm>(json.at("arm"));
  row.hidden = json.at("hidden");
  row.signal_to_noise = json.at("signal_to_noise");
  row.designs = counts_of(json.at("designs"));
  for (const auto& [name, n] : json.at("marks").items()) row.marks[value_of<Mark>(name)] = n;
  row.n = json.at("n");
  return row;
}

Json json_of(const UnreachedRow& row) {
  Json not_made = Json::array();
  for (const auto& [strength, n] : row.not_made) {
    not_made.push_back({{"signal_to_noise", strength}, {"n", n}});
  }
  return {{"hidden", row.hidden},
          {"design", row.design},
          {"not_made", not_made},
          {"largest", row.largest}};
}
UnreachedRow unreached_row_of(const Json& json) {
  UnreachedRow row;
  row.hidden = json.at("hidden");
  row.design = json.at("design");
  for (const Json& cell : json.at("not_made"))
    row.not_made[cell.at("signal_to_noise")] = cell.at("n");
  row.largest = json.at("largest");
  return row;
}

StudyTally tally_from(const Json& json) {
  StudyTally tally;
  tally.stamp = recoil::stamp_of(json);
  tally.seed = json.at("seed");
  tally.planned = json.at("planned");
  tally.tried = json.at("tried");
  tally.made = json.at("made");
  for (const auto& [name, count] : json.at("bars").items()) {
    tally.bars[value_of<Bar>(name)] = count_of(count);
  }
  const Json& missed = json.at("not_named");
  tally.not_named = missed.at("n");
  tally.alike = missed.at("alike");
  tally.told_by_cause = missed.at("told_by_cause");
  for (const Json& row : json.at("rivals")) {
    tally.rivals.push_back({row.at("hidden"), row.at("signal_to_noise"),
                            counts_of(row.at("rivals")), row.at("least"), row.at("median")});
  }
  for (const Json& row : json.at("margins")) {
    tally.margins.push_back(
        {row.at("margin"), row.at("named"), row.at("wrong"), row.at("listed"), row.at("n")});
  }
  for (const Json& row : json.at("powers")) tally.powers.push_back(power_of(row));
  const Json& confusion = json.at("confusion");
  tally.confusion = {confusion.at("rows").get<std::vector<std::string>>(),
                     confusion.at("columns").get<std::vector<std::string>>(),
                     confusion.at("counts").get<std::vector<std::vector<int>>>()};
  for (const Json& row : json.at("alarms")) {
    tally.alarms.push_back(
        {row.at("design"), count_of(row.at("alarms")), count_of(row.at("low_p"))});
  }
  tally.errors_told_astray = count_of(json.at("errors_told_astray"));
  if (const Json& times = json.at("times"); !times.is_null()) {
    tally.times =
        Times{times.at("median"), times.at("nine_of_ten"), times.at("longest"), times.at("n")};
  }
  if (json.contains("loop") && !json["loop"].is_null()) {
    const Json& loop = json["loop"];
    tally.loop = LoopEffort{loop.at("median_events"), loop.at("median_rounds"), loop.at("at_once"),
                            loop.at("n")};
  }
  tally.complaints = json.at("complaints").get<std::vector<std::string>>();
  for (const Json& row : json.at("unreached")) tally.unreached.push_back(unreached_row_of(row));
  return tally;
}

}  // namespace

Wanted wanted_of(Bar bar) {
  switch (bar) {
    case Bar::listed:
    case Bar::loop_named:
    case Bar::dropped_listed:
    case Bar::odd_found:
      return {0.95, true};
    case Bar::bent_listed:
    case Bar::other_listed:
      return {0.90, true};
    case Bar::odd_accused:
      return {0.01, false};
    case Bar::wrong:
    case Bar::loop_wrong:
    case Bar::dropped_wrong:
      return {0.02, false};
    case Bar::bent_wrong:
    case Bar::other_wrong:
    case Bar::unstated_named:
    case Bar::impossible_named:
    case Bar::settings_named:
    case Bar::rounded_named:
    case Bar::rounded_wrong:
    case Bar::odd_named:
      return {0.03, false};
    case Bar::false_alarm:
    case Bar::base_alarm:
    case Bar::unseen:
    case Bar::other_unseen:
      return {0.05, false};
    case Bar::bent_unexplained:
    case Bar::other_unexplained:
      return {0.10, false};
    default:
      return {0.80, true};
  }
}

StudyTally tally_of(const std::vector<Answered>& answers, std::size_t planned,
                    const StudySize& size) {
  StudyTally tally;
  tally.seed = size.seed;
  tally.planned = static_cast<int>(planned);
  tally.tried = static_cast<int>(answers.size());
  tally.made = static_cast<int>(those(answers, [](const Answered&) { return true; }).size());
  tally.bars = bars_of(answers);
  count_missed(answers, tally);
  tally.rivals = rivals_of(answers);
  tally.margins = margins_of(answers);
  tally.powers = powers_of(answers);
  tally.confusion = confusion_of(answers);
  tally.alarms = alarms_of(answers);
  tally.errors_told_astray =
      count(those(answers, seen(Arm::effect)), [](const Answered& a) { return a.errors_told; });
  tally.times = times_of(answers);
  tally.loop = loop_of(answers);
  for (const Answered& a : answers) {
    if (a.reached && a.status != 0) {
      tally.complaints.push_back(a.order.key() + ": exit status " + std::to_string(a.status) +
                                 ": " + a.complaint);
    }
  }
  tally.unreached = unreached_of(answers);
  return tally;
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

std::string tally_json(const StudyTally& tally) {
  Json json = recoil::json_of(tally.stamp);
  json["seed"] = tally.seed;
  json["planned"] = tally.planned;
  json["tried"] = tally.tried;
  json["made"] = tally.made;
  json["bars"] = Json::object();
  for (const auto& [bar, count] : tally.bars)
    json["bars"][std::string(name_of(bar))] = json_of(count);
  json["not_named"] = {
      {"n", tally.not_named}, {"alike", tally.alike}, {"told_by_cause", tally.told_by_cause}};
  json["rivals"] = Json::array();
  for (const RivalRow& row : tally.rivals) {
    json["rivals"].push_back({{"hidden", row.hidden},
                              {"signal_to_noise", row.signal_to_noise},
                              {"rivals", json_of(row.rivals)},
                              {"least", row.least},
                              {"median", row.median}});
  }
  json["margins"] = Json::array();
  for (const MarginRow& row : tally.margins) {
    json["margins"].push_back({{"margin", row.margin},
                               {"named", row.named},
                               {"wrong", row.wrong},
                               {"listed", row.listed},
                               {"n", row.n}});
  }
  json["powers"] = Json::array();
  for (const PowerRow& row : tally.powers) json["powers"].push_back(json_of(row));
  json["confusion"] = {{"rows", tally.confusion.rows},
                       {"columns", tally.confusion.columns},
                       {"counts", tally.confusion.counts}};
  json["alarms"] = Json::array();
  for (const AlarmRow& row : tally.alarms) {
    json["alarms"].push_back(
        {{"design", row.design}, {"alarms", json_of(row.alarms)}, {"low_p", json_of(row.low_p)}});
  }
  json["errors_told_astray"] = json_of(tally.errors_told_astray);
  json["times"] = nullptr;
  if (tally.times) {
    json["times"] = {{"median", tally.times->median},
                     {"nine_of_ten", tally.times->nine_of_ten},
                     {"longest", tally.times->longest},
                     {"n", tally.times->n}};
  }
  if (tally.loop) {
    json["loop"] = {{"median_events", tally.loop->median_events},
                    {"median_rounds", tally.loop->median_rounds},
                    {"at_once", tally.loop->at_once},
                    {"n", tally.loop->n}};
  }
  json["complaints"] = tally.complaints;
  json["unreached"] = Json::array();
  for (const UnreachedRow& row : tally.unreached) json["unreached"].push_back(json_of(row));
  return json.dump(1) + "\n";
}

StudyTally read_tally(const std::filesystem::path& file) {
  try {
    return tally_from(Json::parse(recoil::read_text_file(file)));
  } catch (const recoil::InputError&) {
    throw;
  } catch (const std::exception& problem) {
    throw recoil::InputError({file.string()}, "this is no study of hidden effects", problem.what(),
                             "let ./run study hidden-effects write it again");
  }
}

}  // namespace hidden
