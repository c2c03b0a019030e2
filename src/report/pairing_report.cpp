#include "report/pairing_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/program.hpp"
#include "core/units.hpp"
#include "data/text.hpp"
#include "document/terminal.hpp"
#include "experiment/flight.hpp"
#include "json/printed_results.hpp"
#include "report/result_json.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

constexpr double degree = M_PI / 180.0;
constexpr std::size_t most_rows = 40;
constexpr double doubtful_purity = 0.9;  // a smaller share of correct pairs causes a warning

double as_number(std::size_t n) { return static_cast<double>(n); }
double percent_of(double part, double whole) { return whole > 0.0 ? 100.0 * part / whole : 0.0; }
Section rows_section(const PassageTable& table) {
  Section section{"file", "Passages"};
  section.blocks = {Paragraph{
      say("{}: {} in {}; {}", table.file, counted(table.passages.size(), "passage"),
          counted(table.rows, "row"), joined(table.units, ", ", [](const FieldUnit& field) {
            return fmt::format("{} [{}]", field.field, field.unit);
          }))}};
  List left_out;
  for (const ImportNote& note : table.notes) left_out.entries.emplace_back(note_sentence(note));
  if (table.damaged > 0) {
    left_out.entries.push_back(say("{} left out ({})", counted(table.damaged, "damaged row"),
                                   joined(table.first_damaged, "; ", [&](const BadRow& row) {
                                     return fmt::format("{}:{}: {}", table.file, row.line,
                                                        row.problem);
                                   })));
  }
  if (table.duplicated > 0) {
    left_out.entries.push_back(say("{} left out ({})", counted(table.duplicated, "repeated row"),
                                   joined(table.first_duplicated, ", ", [&](int line) {
                                     return fmt::format("{}:{}", table.file, line);
                                   })));
  }
  if (table.unsorted > 0) {
    left_out.entries.push_back(say("{} out of order, sorted by time (first: {}:{})",
                                   counted(table.unsorted, "row"), table.file,
                                   table.first_unsorted));
  }
  if (!table.ignored.empty()) {
    left_out.entries.push_back(
        say("columns not used: {}", fmt::format("{}", fmt::join(table.ignored, ", "))));
  }
  section.blocks.emplace_back(std::move(left_out));
  return section;
}

Sentence plane_words(const PairingResult& pairs) {
  if (!pairs.refined) {
    return say("{:g} mm above the surface, {}", pairs.height / units::mm,
               pairs.options.refine ? "as estimated: too few pairs to refine it" : "as stated");
  }
  return say(
      "{:.5g} {+/-} {:.2g} mm above the surface, refined from {:g} mm (standard error from the "
      "scatter; an error of the velocity scale adds to it); one pair's flight time scatters by "
      "{:.2g} % of h, its two diameters by {:.2g} %",
      pairs.height / units::mm, pairs.height_sd / units::mm, pairs.options.height / units::mm,
      100.0 * pairs.height_spread, 100.0 * pairs.diameter_spread);
}

Sentence later_words(const PairingResult& pairs) {
  if (!pairs.returns_usable) {
    return "rebounds that come down again cannot be distinguished from chance; second impacts, if "
           "there are any, count as first ones";
  }
  const auto later =
      std::ranges::count_if(pairs.impacts, [](const Impact& impact) { return impact.number > 1; });
  return say(
      "{} of them are second or further impacts, {}; {} rebounds were seen coming down again, "
      "{:.0f} of these by chance",
      later, pairs.options.keep_later ? "used as well" : "kept out", pairs.returns,
      pairs.expected_returns);
}

struct Selected {
  std::size_t number = 0;
  double restitution = 0.0;
  double diameter = 0.0;  ///< [m]
};

template <class Rule>
Selected selected(const PairingResult& pairs, const Rule& rule) {
  Selected result;
  for (const Impact& impact : pairs.impacts) {
    if (!rule(impact)) continue;
    ++result.number;
    result.restitution += impact.restitution;
    result.diameter += impact.diameter;
  }
  if (result.number == 0) return result;
  result.restitution /= as_number(result.number);
  result.diameter /= as_number(result.number);
  return result;
}

/// How many impacts the threshold removes, and its effect on the means.
Sentence threshold_words(const PassageTable& table, const PairingResult& pairs) {
  if (!pairs.options.threshold) return {};
  const double threshold = *pairs.options.threshold;
  const auto below = [&](const Impact& impact) {
    return table.passages[impact.down].velocity < threshold;
  };
  const auto is_first = [](const Impact& impact) { return impact.number == 1; };
  const Selected first = selected(pairs, is_first);
  const Selected later = selected(pairs, [&](const Impact& i) { return !is_first(i); });
  const Selected first_out =
      selected(pairs, [&](const Impact& i) { return is_first(i) && below(i); });
  const Selected later_out =
      selected(pairs, [&](const Impact& i) { return !is_first(i) && below(i); });
  const Selected kept = selected(pairs, [&](const Impact& i) { return is_first(i) && !below(i); });
  Sentence words =
      say("{:g} m/s at the plane: removes {} of {} later impacts ({:.1f} %) and {} of {} first "
          "ones ({:.1f} %). ",
          threshold, later_out.number, later.number,
          percent_of(as_number(later_out.number), as_number(later.number)), first_out.number,
          first.number, percent_of(as_number(first_out.number), as_number(first.number)));
  if (kept.number > 0) {
    words += say(
        "Selection: among first impacts the mean {e} goes from {:.4f} to {:.4f}, the mean diameter "
        "from {:.4g} to {:.4g} {um}. ",
        first.restitution, kept.restitution, first.diameter / units::um, kept.diameter / units::um);
  }
  return words + say("It acts on the incident velocity only, so it does not select by {e}; but it "
                     "leaves out slow first impacts, in which adhesion matters.");
}

Sentence angle_words(const PassageTable& table, const PairingResult& pairs) {
  if (!pairs.options.angle) return {};
  if (!table.has_tangential) return "not applied: the file has no tangential_velocity";
  const Selected outside =
      selected(pairs, [&](const Impact& impact) { return impact.angle > *pairs.options.angle; });
  return say("{} rebounds leave at more than {:g} degrees from the normal and are not used",
             outside.number, *pairs.options.angle / degree);
}

Section impacts_section(const PassageTable& table, const PairingResult& pairs) {
  std::vector<std::pair<Sentence, Cell>> entries = {
      {"passages", say("{} towards the surface, {} away from it", pairs.down, pairs.up)},
      {"measuring plane", plane_words(pairs)},
      {"impacts",
       say("{} pairs, of which an estimated {:.2f} % are correct ({} of {} decoy passages found a "
           "partner; possible exchanges between neighbours are included)",
           pairs.impacts.size(), 100.0 * pairs.purity(),
           std::lround(pairs.decoy_share * as_number(pairs.decoys)), pairs.decoys)},
      {"later", later_words(pairs)},
      {"threshold", threshold_words(table, pairs)},
      {"angle", angle_words(table, pairs)}};
  Section section{"impacts", "Impacts", {}, {items(entries)}};
  if (pairs.purity() < doubtful_purity) {
    section.blocks.push_back(Banner{
        "warning",
        say("Only {:.1f} % of the pairs are correct: the points come from unrelated passages. "
            "First check the height of the measuring plane (--height) and the times.",
            100.0 * pairs.purity())});
  }
  return section;
}

/// Estimated numbers of lost, slow and captured spheres among the passages without a rebound.
Table unpaired_table(const PairingResult& pairs, const Averages& averages) {
  const std::string seen = pairs.options.lost_share
                               ? std::string("as stated")
                               : fmt::format(
                                     "{} of {} rebounds were not seen on their way down, and "
                                     "rebounds on their way up are assumed to be missed as often",
                                     pairs.orphans, pairs.up);
  Table table;
  table.columns = {{"taken for"}, {"passages"}, {"because", "", true}};
  table.rows = {{"lost", Number{averages.lost, fixed(0)},
                 say("{:.1f} % of rebounds are not detected ({}); a later return proves {} of them",
                     100.0 * averages.lost_share, seen, averages.came_back)},
                {"too slow", Number{averages.too_slow, fixed(0)},
                 say("a rebound below {:.4f} m/s at the surface does not reach the plane; "
                     "estimated from the scatter of {e} of the others",
                     flight::slowest_return(pairs.height))},
                {"captured", whole(averages.captured), {}},
                {"not assigned", Number{averages.unresolved, fixed(0)},
                 "too few in their bins to be distinguished from chance"}};
  return table;
}

Section unpaired_section(const PairingResult& pairs, const Averages& averages) {
  Section section{"unpaired", "Without a rebound"};
  section.blocks = {
      Paragraph{say("{} used passages towards the surface have no rebound:", averages.unpaired)},
      unpaired_table(pairs, averages),
      Paragraph{say("Of the fastest quarter, {:.1f} % of {} have no rebound: if nothing is "
                    "captured there, this is the share that is lost (--lost-share).",
                    100.0 * averages.fast_unpaired, averages.fast_impacts)},
      Paragraph{
          "A single passage cannot be classified: captured, too slow and lost look alike, and only "
          "their numbers are estimated. In bins with few rebounds, captured includes too slow."}};
  return section;
}

Section points_section(const Averages& averages) {
  Section section{"points", "Points"};
  section.blocks = {
      Paragraph{say("{}; a bin spans at least {:.2g} % of its velocity, 6 standard deviations of "
                    "the velocities' error",
                    averages.points.size(), 100.0 * averages.narrowest)}};
  List left_out;
  if (averages.outside_sizes > 0) {
    left_out.entries.push_back(counted(averages.outside_sizes, "impact lies", "impacts lie") +
                               " outside the size classes");
  }
  if (averages.single > 0) {
    left_out.entries.push_back(counted(averages.single, "impact has", "impacts have") +
                               " fewer than 5 at the same velocity: each is a point");
  }
  append(section.blocks, {std::move(left_out), averages_table(averages)});
  if (averages.points.size() > most_rows) {
    section.blocks.emplace_back(
        Paragraph{say("... and {} more", averages.points.size() - most_rows)});
  }
  return section;
}

}  // namespace

Table averages_table(const Averages& averages) {
  Table table;
  table.columns = {{"series"},       {say("{d}"), "um"}, {say("{V}"), "m/s"}, {say("{e}")},
                   {say("sd({e})")}, {"rebounds"},       {"missing"},         {"captured"}};
  for (std::size_t i = 0; i < std::min(averages.points.size(), most_rows); ++i) {
    const PointMean& point = averages.points[i];
    table.rows.push_back(
        {Sentence(point.series), Number{point.diameter / units::um, significant(4)},
         Number{point.velocity, fixed(4)},
         point.rebounds > 0 ? Cell(Number{point.restitution, fixed(4)}) : Cell(),
         point.restitution_sd > 0.0 ? Cell(Number{point.restitution_sd, fixed(4)}) : Cell(),
         whole(point.rebounds), whole(point.unpaired), whole(point.captured)});
  }
  return table;
}

std::string pairing_text(const PassageTable& table, const PairingResult& pairs,
                         const Averages& averages) {
  return terminal_text({rows_section(table), impacts_section(table, pairs),
                        unpaired_section(pairs, averages), points_section(averages)});
}

std::string pairing_json(const PassageTable& table, const PairingResult& pairs,
                         const Averages& averages) {
  const auto count_of_impacts = [&](const auto& condition) {
    return static_cast<std::size_t>(std::ranges::count_if(pairs.impacts, condition));
  };
  const auto if_known = [](double value) {
    return value > 0.0 ? OrNull<double>(value) : std::nullopt;
  };
  PairingFile out;
  out.recoil_version = version();
  out.passages = {.file = table.file,
                  .rows = table.rows,
                  .passages = table.passages.size(),
                  .damaged = table.damaged,
                  .repeated = table.duplicated,
                  .out_of_order = table.unsorted,
                  .columns_not_used = table.ignored,
                  .provenance = table.provenance};
  out.plane = {.height_m = pairs.height,
               .height_sd_m = pairs.refined ? OrNull<double>(pairs.height_sd) : std::nullopt,
               .refined = pairs.refined};
  out.impacts = {.down = pairs.down,
                 .up = pairs.up,
                 .pairs = pairs.impacts.size(),
                 .used = count_of_impacts([](const Impact& impact) { return impact.used; }),
                 .later = count_of_impacts([](const Impact& impact) { return impact.number > 1; }),
                 .purity = pairs.purity(),
                 .returns = pairs.returns,
                 .expected_returns = pairs.expected_returns};
  out.without_rebound = {.passages = averages.unpaired,
                         .lost = averages.lost,
                         .too_slow = averages.too_slow,
                         .captured = averages.captured,
                         .not_assigned = averages.unresolved,
                         .lost_share = averages.lost_share};
  for (const PointMean& point : averages.points) {
    out.points.push_back(
        {.series = point.series,
         .diameter_um = point.diameter / units::um,
         .incident_velocity = point.velocity,
         .velocity_sd = if_known(point.velocity_sd),
         .restitution = point.rebounds > 0 ? OrNull<double>(point.restitution) : std::nullopt,
         .restitution_sd = if_known(point.restitution_sd),
         .rebounds = point.rebounds,
         .unpaired = point.unpaired,
         .captured = point.captured,
         .events = point.events()});
  }
  return text_of(out);
}

}  // namespace recoil
