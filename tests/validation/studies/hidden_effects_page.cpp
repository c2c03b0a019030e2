#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

#include "core/statistics.hpp"
#include "validation/studies/hidden_effects_tally.hpp"
#include "validation/studies/study.hpp"

namespace recoil::hidden {
namespace {

/// "83 % (73 to 91), 58 of 70": with the 95 % limits of the share.
Sentence share(const Count& count) {
  if (count.n == 0) return "none";
  const ShareLimits limits = share_limits(count.k, count.n);
  return fmt::format("{:.0f} % ({:.0f} to {:.0f}), {} of {}", 100.0 * count.k / count.n,
                     100.0 * limits.lower, 100.0 * limits.upper, count.k, count.n);
}

Sentence verdict_words(const Bar& bar, const Count& count) {
  if (count.n == 0) return "not studied";
  const double part = static_cast<double>(count.k) / count.n;
  return (bar.at_least ? part >= bar.share : part <= bar.share) ? Sentence("reached")
                                                                : strong("missed");
}

Sentence ideal_share(const StudyTally& tally, const Bar& bar) {
  const int n = tally.bar(bar.id).n;
  if (!tally.ideal || n == 0) return {};
  for (const auto& [id, number] : *tally.ideal) {
    if (id == bar.id) return fmt::format("{:.0f} %, {:.0f}", 100.0 * number / n, number);
  }
  return {};
}

Table bars_table(const StudyTally& tally) {
  std::vector<Bar> counted;
  for (const Bar& bar : study_bars()) {
    const bool found =
        std::ranges::any_of(tally.bars, [&](const auto& one) { return one.first == bar.id; });
    if (found) counted.push_back(bar);
  }
  return study_table<Bar>(
      counted,
      {{"bar", [](const Bar& bar) { return word_cell(bar.words); }, true},
       {"wanted",
        [](const Bar& bar) {
          return word_cell(fmt::format("{} {:.0f} %", bar.at_least ? "≥" : "≤", 100.0 * bar.share));
        }},
       {"found (95 % interval)", [&](const Bar& bar) { return share(tally.bar(bar.id)); }, true},
       {"an ideal judge", [&](const Bar& bar) { return ideal_share(tally, bar); }},
       {"verdict", [&](const Bar& bar) { return verdict_words(bar, tally.bar(bar.id)); }, true}});
}

Table methods_table(const std::vector<MethodRow>& methods) {
  return study_table<MethodRow>(
      methods, {{"method", [](const MethodRow& row) { return word_cell(row.method); }, true},
                {"named", [](const MethodRow& row) { return share(row.named); }},
                {"named or listed", [](const MethodRow& row) { return share(row.listed); }},
                {"wrong", [](const MethodRow& row) { return share(row.wrong); }},
                {"alarms", [](const MethodRow& row) { return share(row.alarms); }}});
}

std::string listed(const std::map<std::string, int>& counts) {
  std::string words;
  for (const auto& [name, n] : counts) {
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", name, n);
  }
  return words;
}

using MarkColumn = std::pair<const char*, Mark>;
constexpr std::array<MarkColumn, 9> mark_columns = {{{"named", Mark::named},
                                                     {"one of several", Mark::part},
                                                     {"listed", Mark::inside},
                                                     {"wrong", Mark::wrong},
                                                     {"not listed", Mark::outside},
                                                     {"unexplained", Mark::unexplained},
                                                     {"resembles", Mark::resembled},
                                                     {"adequate", Mark::nothing},
                                                     {"no answer", Mark::failed}}};

/// Number of data sets of each mark, as `cell` writes it.
void add_marks(std::vector<StudyColumn<PowerRow>>& columns,
               const std::function<Cell(const PowerRow&, int)>& cell) {
  for (const auto& [heading, mark] : mark_columns) {
    columns.push_back({heading, [cell, mark = mark](const PowerRow& row) {
                         return cell(row, row.marked(mark));
                       }});
  }
  columns.push_back({"n", [](const PowerRow& row) { return word_cell(std::to_string(row.n)); }});
}

Cell strength_cell(const PowerRow& row) {
  return word_cell(fmt::format("{:g}", row.signal_to_noise));
}

/// All effects of an arm together: shares of the data sets of one strength.
Table strength_table(const StudyTally& tally, Arm arm) {
  std::map<double, PowerRow> sums;
  for (const PowerRow& row : tally.powers) {
    if (row.arm != arm) continue;
    PowerRow& sum = sums[row.signal_to_noise];
    sum.signal_to_noise = row.signal_to_noise;
    sum.n += row.n;
    for (const auto& [mark, count] : row.marks) sum.marks[mark] += count;
  }
  std::vector<PowerRow> rows;
  for (const auto& [strength, sum] : sums) rows.push_back(sum);
  std::vector<StudyColumn<PowerRow>> columns = {{"snr", strength_cell}};
  add_marks(columns, [](const PowerRow& row, int n) {
    return word_cell(fmt::format("{:.0f} %", 100.0 * n / row.n));
  });
  return study_table(rows, columns);
}

Table power_table(const StudyTally& tally, Arm arm) {
  std::vector<PowerRow> rows = tally.powers;
  std::erase_if(rows, [arm](const PowerRow& row) { return row.arm != arm; });
  std::vector<StudyColumn<PowerRow>> columns = {
      {"hidden", [](const PowerRow& row) { return word_cell(row.hidden); }, true},
      {"designs", [](const PowerRow& row) { return word_cell(listed(row.designs)); }, true},
      {"snr", strength_cell}};
  add_marks(columns, [](const PowerRow&, int n) {
    return n == 0 ? Cell(Sentence()) : word_cell(std::to_string(n));
  });
  return study_table(rows, columns);
}

Table rivals_table(const StudyTally& tally) {
  using Row = const RivalRow&;
  return study_table<RivalRow>(
      tally.rivals,
      {{"hidden", [](Row row) { return word_cell(row.hidden); }, true},
       {"snr", [](Row row) { return word_cell(fmt::format("{:g}", row.signal_to_noise)); }},
       {"nearest other cause", [](Row row) { return word_cell(listed(row.rivals)); }, true},
       {"misfit it leaves: least, median",
        [](Row row) { return word_cell(fmt::format("{:.1f}, {:.1f}", row.least, row.median)); }}});
}

Table confusion_table(const Confusion& confusion) {
  Table table;
  table.columns = {{"hidden \\ answered", {}, true}};
  for (const std::string& column : confusion.columns) table.columns.push_back({column});
  for (std::size_t r = 0; r < confusion.rows.size(); ++r) {
    std::vector<Cell> cells = {Sentence(confusion.rows[r])};
    for (const int n : confusion.counts[r]) {
      cells.push_back(Sentence(n == 0 ? std::string() : std::to_string(n)));
    }
    table.rows.push_back(std::move(cells));
  }
  return table;
}

Table alarms_table(const StudyTally& tally) {
  using Row = const AlarmRow&;
  return study_table<AlarmRow>(
      tally.alarms,
      {{"design", [](Row row) { return word_cell(row.design); }, true},
       {"verdict other than adequate", [](Row row) { return share(row.alarms); }, true},
       {"p below 5 %", [](Row row) { return share(row.low_p); }, true}});
}

Table unreached_table(const StudyTally& tally) {
  using Row = const UnreachedRow&;
  return study_table<UnreachedRow>(
      tally.unreached,
      {{"effect", [](Row row) { return word_cell(row.hidden); }, true},
       {"design", [](Row row) { return word_cell(row.design); }, true},
       {"data sets not made, by wanted snr",
        [](Row row) {
          std::string list;
          for (const auto& [strength, n] : row.not_made) {
            list += fmt::format("{}{:g}: {}", list.empty() ? "" : ", ", strength, n);
          }
          return word_cell(list);
        },
        true},
       {"largest snr met", [](Row row) { return word_cell(fmt::format("{:.1f}", row.largest)); }}});
}

Sentence careless_words(const StudyTally& tally) {
  return say(
      "Nothing hidden, but the printed velocities are 3 % off, each by itself ({}), or the stated "
      "standard deviations are two thirds of the true ones ({}). To name a cause would be wrong; "
      "{} with a remark on such errors is right. The remark was there in {} of those in which "
      "structure was seen; of the visible effects of the catalogue, where it would mislead, in {}.",
      code("velocities"), code("deviations"), code("unexplained"),
      share(tally.bar("unstated_told")), share(tally.errors_told_astray));
}

/// What nobody could do better; empty for results that were made without it.
Sentence ideal_words(const StudyTally& tally) {
  if (!tally.ideal) return {};
  return "The ideal judge knows the noise of the points, and what may be hidden, with its size. He "
         "names a cause if its odds against the nearest rival (or, where a common cause counts, "
         "against the nearest that is no law of it) are e² or more; the laws are exact then. He "
         "sees a misfit by the most powerful test that allows errors of the laws of 3 to 12 % and "
         "raises a false alarm in 5 % of such data. After experiments he has the same further "
         "impacts, and does both. ";
}

Sentence missed_words(const StudyTally& tally) {
  return say(
      "{}Of the {} visible effects that were not named outright, {} have a neighbour in the "
      "catalogue that leaves a misfit below {:g} with all its parameters fitted (a table follows); "
      "in {} of these all that is listed are laws of one cause ({}: JKR's work, hysteresis per "
      "area and crack rate are adhesion hysteresis; spreads of size and of adhesion are unequal "
      "impacts averaged in one point), which is then told by name.",
      ideal_words(tally), tally.not_named.n, tally.not_named.alike, separable,
      tally.not_named.told_by_cause, code("shared_cause"));
}

std::vector<Block> foreword(const StudyTally& tally) {
  const auto seed = static_cast<long long>(tally.seed);
  const Sentence kinds = tally.whole.empty() ? Sentence()
                                             : say(", and all of the kinds {}",
                                                   fmt::format("{}", fmt::join(tally.whole, ", ")));
  const Sentence made =
      tally.tried < tally.planned
          ? say("Seed {}; {} of {} data sets, {} of them made: a random sample{}.", seed,
                tally.tried, tally.planned, tally.made, kinds)
          : say("Seed {}; {} data sets, {} of them made.", seed, tally.tried, tally.made);
  std::vector<Block> blocks = {
      Paragraph{
          say("Data in which an effect is hidden, made by separate physics ({}: the contact in "
              "time with explicit forces, 40 or 100 noisy events per point, values printed as in a "
              "table's columns), and diagnosed by the built command, which sees the dataset folder "
              "and a fit file. Strength is the signal-to-noise of the misfit that is left when the "
              "base model has been refitted, sqrt(sum ((e - e_base) / sd)^2) on data without "
              "noise; from {:g} on it counts as visible. Designs: {} 4 diameters x 15 velocities, "
              "{} 4 x 2 batches x 8, {} 4 x 15 steel spheres, and with one diameter {} 1 x 15 and "
              "{} 1 x 20; {} are 3 x 5 heights x 4 drops. Every strength lies within what nature "
              "or a careful experimenter has; "
              "what would need more is not made, and listed at the end.",
              code("tests/validation/synthetic"), visible, code("wall"), code("wall-batches"),
              code("li"), code("wall-one"), code("dahneke"), code("drops"))},
      Paragraph{made}};
  append(blocks, stamp_blocks(tally.stamp));
  return blocks;
}

Table allowance_table(const std::vector<AllowanceRow>& rows) {
  using Row = const AllowanceRow&;
  return study_table<AllowanceRow>(
      rows, {{"the laws were", [](Row row) { return word_cell(row.truth); }, true},
             {"named", [](Row row) { return share(row.named); }},
             {"wrong", [](Row row) { return share(row.wrong); }},
             {"named, laws taken for exact", [](Row row) { return share(row.exact_named); }},
             {"wrong, laws taken for exact", [](Row row) { return share(row.exact_wrong); }}});
}

std::vector<Block> allowance_blocks(const StudyTally& tally) {
  std::vector<Block> blocks;
  if (tally.allowance) {
    blocks.emplace_back(Paragraph{
        "Every explanation is averaged over the errors that the laws may have, of the base model "
        "from 3 to 12 % of its losses, and of a mechanism 10 % of its effect. What this costs is "
        "power where the laws are exact; what it brings is fewer wrong names where they are not. "
        "Visible effects; beside it the answer of one who takes all laws for exact:"});
    blocks.emplace_back(allowance_table(*tally.allowance));
  }
  blocks.emplace_back(Paragraph{"All effects together, by strength; the laws were exact here:"});
  blocks.emplace_back(strength_table(tally, Arm::effect));
  return blocks;
}

Sentence times_words(const std::optional<Times>& times) {
  if (!times) return "No diagnosis was made.";
  return say(
      "One diagnosis on one thread, others at work beside it: median {:.1f} s, nine of ten below "
      "{:.1f} s, longest {:.1f} s; {} diagnoses.",
      times->median, times->nine_of_ten, times->longest, times->n);
}

Sentence loop_words(const StudyTally& tally) {
  const LoopEffort effort = tally.loop.value_or(LoopEffort{});
  return say(
      "Where no cause is certain, the first of {} is done, simulated by the hidden truth with the "
      "same noise per impact, and all points are diagnosed again. {} were told at once; {} after "
      "further impacts, {:g} in the median, in {:g} rounds.",
      code("next_experiment"), effort.at_once, effort.n, effort.median_events,
      effort.median_rounds);
}

Block complaints_block(const StudyTally& tally) {
  if (tally.complaints.empty()) return Paragraph{"Every diagnosis gave an answer."};
  List list;
  for (const std::string& complaint : tally.complaints) list.entries.push_back(code(complaint));
  return list;
}

// ---- the picture -----------------------------------------------------------------------------

struct Curve {
  const char* label;
  std::vector<Mark> marks;
  bool without;  ///< all but these
};

const std::vector<Curve>& curves() {
  static const std::vector<Curve> all = {
      {"misfit seen", {Mark::nothing, Mark::failed}, true},
      {"named or listed", {Mark::named, Mark::inside}, false},
      {"named outright", {Mark::named}, false},
      {"wrong cause named", {Mark::wrong}, false},
  };
  return all;
}

constexpr int width = 1240;
constexpr int height = 640;

/// The share of the data sets of one strength that a curve counts [%]; none where there are none.
std::optional<double> share_of(const std::vector<PowerRow>& powers, const Curve& curve,
                               double strength) {
  int n = 0;
  int hits = 0;
  for (const PowerRow& row : powers) {
    if (row.arm != Arm::effect || row.signal_to_noise != strength) continue;
    n += row.n;
    for (const Mark mark : curve.marks) hits += row.marked(mark);
  }
  if (n == 0) return std::nullopt;
  return 100.0 * (curve.without ? n - hits : hits) / n;
}

plot::Plot power_panel(const StudyTally& tally) {
  plot::Plot panel;
  panel.frame = plot::Frame{0.07 * width, 0.33 * width, 0.30 * height, 0.86 * height};
  panel.heading = "One effect, several diameters";
  panel.x = {"signal-to-noise of the misfit left"};
  panel.x.logarithmic = true;
  panel.x.set_range({4.5, 45.0});
  panel.x.ticks = {{5.0, "5"}, {10.0, "10"}, {20.0, "20"}, {40.0, "40"}};
  panel.y = {"data sets", "%"};
  panel.y.set_range({0.0, 102.0});
  panel.key = plot::KeyPlace::below;
  for (std::size_t k = 0; k < curves().size(); ++k) {
    const plot::Marker& marker = plot::marker(k);
    plot::Line line{{}, {}, {marker.colour, 2.0}, marker.mark, 0.9};
    line.name = curves()[k].label;
    for (const double strength : study_strengths) {
      const std::optional<double> share = share_of(tally.powers, curves()[k], strength);
      line.x.push_back(strength);
      line.y.push_back(share.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    panel.layers.push_back(std::move(line));
  }
  return panel;
}

plot::Plot heat_panel(const Confusion& c) {
  plot::Plot panel = table_plot(c.rows, c.columns, 10.0);
  panel.frame = plot::Frame{0.50 * width, 0.91 * width, 0.30 * height, 0.92 * height};
  panel.heading = "Hidden (rows) and answered (columns), snr 10 and more";
  auto& cells = std::get<plot::Boxes>(panel.layers.front());
  for (std::size_t r = 0; r < c.rows.size(); ++r) {
    const double sum = std::accumulate(c.counts[r].begin(), c.counts[r].end(), 0.0);
    for (std::size_t k = 0; k < c.columns.size(); ++k) {
      add_cell(cells, r, k).values.push_back(sum > 0.0 ? 100.0 * c.counts[r][k] / sum : 0.0);
    }
  }
  panel.colours = plot::ColourScale{
      "", {0.0, 100.0}, {{0.0, "#ffffff"}, {0.01, "#e8f1f8"}, {1.0, plot::blue}}, " %"};
  return panel;
}

}  // namespace

Document page_of(const StudyTally& tally) {
  Document page;
  page.heading = "Hidden effects: what the diagnosis finds";
  page.foreword = foreword(tally);
  const auto section = [&page](Sentence title, std::vector<Block> blocks) {
    Section made;
    made.title = std::move(title);
    made.blocks = std::move(blocks);
    page.sections.push_back(std::move(made));
  };
  Figure figure;
  figure.id = "hidden-effects";
  figure.caption = "Power and confusion";
  section("The bars",
          {Paragraph{"Designs with several diameters, snr 10 and more, unless said otherwise."},
           bars_table(tally), Paragraph{missed_words(tally)}, Figures{{figure}},
           Paragraph{say(
               "Whether an effect can be named at all depends on its neighbours in the catalogue: "
               "{} and {} (a charge that grows as d²) take the same from v² at every velocity and "
               "size, and no data on one target tell them apart. So the other mechanisms were "
               "fitted to each visible case without noise; the nearest one leaves the misfit "
               "stated here, and where that is small an honest answer lists both. (The spreads of "
               "size and of adhesion, slow to fit, were tried on one another and on what else "
               "happens near capture.)",
               code("probe_plane"), code("electrostatic_image"))},
           rivals_table(tally)});
  if (tally.methods) {
    section("Beside plain methods",
            {Paragraph{"The same data sets, visible effects in designs of several diameters, and "
                       "data with nothing hidden. Stepwise: of the same catalogue the mechanism "
                       "that lowers AICc most is added, twice at most. Correlation: the mechanism "
                       "whose effect on e correlates most with a Gaussian-process discrepancy of "
                       "the base model, where AIC wants one. Neither knows limits of what is "
                       "possible, errors of laws or held-out points."},
             methods_table(*tally.methods)});
  }
  // A study of some arms only says nothing of the others.
  const auto arms_section = [&](Sentence title, std::vector<Block> blocks,
                                std::initializer_list<Arm> arms) {
    const std::size_t words = blocks.size();
    for (const Arm arm : arms) {
      Table table = power_table(tally, arm);
      if (!table.rows.empty()) blocks.emplace_back(std::move(table));
    }
    if (blocks.size() > words) section(std::move(title), std::move(blocks));
  };
  section("What the errors of the laws cost", allowance_blocks(tally));
  arms_section("Power against strength, effect by effect", {}, {Arm::effect});
  arms_section(
      "Laws that are wrong by some per cent",
      {Paragraph{"What the effect does to e² is multiplied by a smooth random factor of V and d, "
                 "first of 10 %, then of 20 %."}},
      {Arm::bent, Arm::bent_more});
  arms_section(
      "Made by another published law",
      {Paragraph{"Yielding by Jackson, Green & Marghitu (2010), losses in the bulk to second "
                 "order by Ramirez et al. (1999), the thin plate by Boettcher et al. "
                 "(2017), the film of gas to leading order by Barnocky & Davis (1988)."}},
      {Arm::other_law});
  arms_section(
      "Laws of dry contacts beside adhesion",
      {Paragraph{
          "The same laws of yielding, of the bulk and of the plate, where adhesion holds the "
          "spheres as well. Dahneke's balance of energies joins the two, which is good far "
          "above capture only: a test of what is said where no law of the catalogue is near."}},
      {Arm::other_adhesive});
  arms_section("Effects of impossible size",
               {Paragraph{"At three times the largest strength that nature or a careful "
                          "experimenter still has."}},
               {Arm::impossible});
  arms_section("Doing what the answer advises", {Paragraph{loop_words(tally)}}, {Arm::loop});
  arms_section("A condition is known",
               {Paragraph{"First what the effect depends on is stated for all points (the pressure "
                          "of the gas, the thickness of the plate); then nothing of that, but the "
                          "whole experiment is made again under a change that takes the effect "
                          "away, which the points state."}},
               {Arm::stated, Arm::varied});
  section("Confusion",
          {Paragraph{say("What was answered (several causes named count once each; {} by whether "
                         "the truth is listed).",
                         code("not_separable"))},
           confusion_table(tally.confusion)});
  section("Nothing hidden", {alarms_table(tally)});
  arms_section("Two at once", {Paragraph{"Each as strong as it would be alone."}}, {Arm::pair});
  arms_section("Effects that are not in the catalogue", {}, {Arm::outside});
  arms_section("Unstated errors", {Paragraph{careless_words(tally)}}, {Arm::careless});
  arms_section("Drops of spheres of millimetres",
               {Paragraph{say("Three diameters of 3 to 12 mm without adhesion, five heights, four "
                              "drops from each ({}, method stated). First with an effect in them; "
                              "then with heights that were set wrong by 4 %, each by itself: in "
                              "every second data set a column names the heights.",
                              code("drops"))}},
               {Arm::dropped, Arm::settings});
  arms_section("Drops that are read to a finite step",
               {Paragraph{say("Spheres of 3 to 12 mm ({}) and of 12 to 40 mm ({}). Heights of "
                              "rebounds read to 1 or 5 mm, or times of flight to 1 ms or to frames "
                              "of a video (240 in a second). The standard deviations of two data "
                              "sets in four know of the rounding, and in two a column names the "
                              "settings.",
                              code("drops"), code("balls"))}},
               {Arm::rounded});
  arms_section("A few points are misread",
               {Paragraph{"Six points in a hundred, by 6 to 15 standard deviations."}}, {Arm::odd});
  arms_section("One diameter", {}, {Arm::single});
  section("Time", {Paragraph{times_words(tally.times)}});
  section("Without an answer", {complaints_block(tally)});
  section("Too weak in nature to be made", {unreached_table(tally)});
  return page;
}

plot::Picture picture_of(const StudyTally& tally) {
  plot::Picture picture;
  picture.name = "hidden-effects";
  picture.title = "Power of the diagnosis against strength, and what is taken for what";
  picture.width = width;
  picture.height = height;
  picture.plots = {power_panel(tally), heat_panel(tally.confusion)};
  return picture;
}

}  // namespace recoil::hidden
