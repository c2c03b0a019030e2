#include "report/words_impacts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "experiment/flight.hpp"

namespace recoil {
namespace {

constexpr double degree = M_PI / 180.0;

/// `text` after its label, broken between words at 100 columns; a count at its beginning stays
/// alone to the left.
std::string line(const char* label, const std::string& text) {
  constexpr std::size_t widest = 100;
  std::string out = fmt::format("{:<10} ", label);
  std::size_t column = out.size();
  const std::size_t first = text.find_first_not_of(' ');
  const bool counted = first != std::string::npos && text.find("  ", first) != std::string::npos;
  const std::size_t indent = counted ? text.find("  ", first) + 2 : 0;
  std::size_t at = 0;
  while (at < text.size()) {
    std::size_t end = text.find(' ', std::max(at, at == 0 ? indent : at));
    if (end == std::string::npos) end = text.size();
    if (at > 0 && column + 1 + end - at > widest) {
      out += '\n' + std::string(11 + indent, ' ');
      column = 11 + indent;
    } else if (at > 0) {
      out += ' ';
      ++column;
    }
    out += text.substr(at, end - at);
    column += end - at;
    at = end + 1;
  }
  return out + '\n';
}

double percent(double part, double whole) { return whole > 0.0 ? 100.0 * part / whole : 0.0; }

double as_number(std::size_t n) { return static_cast<double>(n); }

std::string rows_text(const PassageTable& table) {
  std::vector<std::string> units;
  for (const FieldUnit& field : table.units) {
    units.push_back(fmt::format("{} [{}]", field.field, field.unit));
  }
  std::string out =
      line("events", fmt::format("{}: {} passages in {} rows; {}", table.file,
                                 table.passages.size(), table.rows, fmt::join(units, ", ")));
  if (table.damaged > 0) {
    std::string first;
    for (const BadRow& row : table.first_damaged) {
      first +=
          fmt::format("{}{}:{}: {}", first.empty() ? "" : "; ", table.file, row.line, row.problem);
    }
    out += line("", fmt::format("{} damaged row{} left out ({})", table.damaged,
                                table.damaged == 1 ? "" : "s", first));
  }
  if (table.duplicated > 0) {
    std::string first;
    for (const int at : table.first_duplicated) {
      first += fmt::format("{}{}:{}", first.empty() ? "" : ", ", table.file, at);
    }
    out += line("", fmt::format("{} repeated row{} left out ({})", table.duplicated,
                                table.duplicated == 1 ? "" : "s", first));
  }
  if (table.unsorted > 0) {
    out +=
        line("", fmt::format("{} row{} out of order, sorted by time (first: {}:{})", table.unsorted,
                             table.unsorted == 1 ? "" : "s", table.file, table.first_unsorted));
  }
  if (!table.ignored.empty()) {
    out += line("", fmt::format("columns not used: {}", fmt::join(table.ignored, ", ")));
  }
  return out;
}

std::string plane_text(const PairingResult& pairs) {
  std::string out;
  if (pairs.refined) {
    out = line("plane",
               fmt::format("{:.5g} +- {:.2g} mm above the surface, refined from {:g} mm (standard "
                           "error of scatter; an error of the velocity scale comes on top)",
                           pairs.height / units::mm, pairs.height_sd / units::mm,
                           pairs.options.height / units::mm));
    out += line("", fmt::format("one pair's flight time scatters by {:.2g} % of h, its two "
                                "diameters by {:.2g} %",
                                100.0 * pairs.height_spread, 100.0 * pairs.diameter_spread));
  } else {
    out =
        line("plane", fmt::format("{:g} mm above the surface, {}", pairs.height / units::mm,
                                  pairs.options.refine ? "as estimated: too few pairs to refine it"
                                                       : "as stated"));
  }
  return out;
}

std::string pairs_text(const PairingResult& pairs) {
  std::string out = line(
      "passages", fmt::format("{} towards the surface, {} away from it", pairs.down, pairs.up));
  out += plane_text(pairs);
  out +=
      line("impacts",
           fmt::format("{} pairs; {:.2f} % are true ones (estimate: {} of {} foreign passages "
                       "found a partner, and neighbours may have been exchanged)",
                       pairs.impacts.size(), 100.0 * pairs.purity(),
                       static_cast<long>(std::lround(pairs.decoy_share * as_number(pairs.decoys))),
                       pairs.decoys));
  const auto later = std::count_if(pairs.impacts.begin(), pairs.impacts.end(),
                                   [](const Impact& i) { return i.number > 1; });
  if (pairs.returns_usable) {
    out += line("later",
                fmt::format("{} of them are second or further impacts, {}; {} rebounds were seen "
                            "coming down again, {:.0f} of these by chance",
                            later, pairs.options.keep_later ? "used as well" : "kept out",
                            pairs.returns, pairs.expected_returns));
  } else {
    out += line("later",
                "rebounds that come down again do not stand out of chance: second impacts, where "
                "there are any, are among the first");
  }
  return out;
}

struct Selected {
  std::size_t number = 0;
  double restitution = 0.0;
  double diameter = 0.0;
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

/// What the threshold took away, and what that does to the means.
std::string threshold_text(const PassageTable& table, const PairingResult& pairs) {
  if (!pairs.options.threshold) return "";
  const double threshold = *pairs.options.threshold;
  const auto below = [&](const Impact& i) { return table.passages[i.down].velocity < threshold; };
  const Selected first = selected(pairs, [](const Impact& i) { return i.number == 1; });
  const Selected later = selected(pairs, [](const Impact& i) { return i.number > 1; });
  const Selected first_out =
      selected(pairs, [&](const Impact& i) { return i.number == 1 && below(i); });
  const Selected later_out =
      selected(pairs, [&](const Impact& i) { return i.number > 1 && below(i); });
  const Selected kept =
      selected(pairs, [&](const Impact& i) { return i.number == 1 && !below(i); });
  std::string out = line(
      "threshold",
      fmt::format("{:g} m/s at the plane: takes away {} of {} later impacts ({:.1f} %) and {} of "
                  "{} first ones ({:.1f} %)",
                  threshold, later_out.number, later.number,
                  percent(as_number(later_out.number), as_number(later.number)), first_out.number,
                  first.number, percent(as_number(first_out.number), as_number(first.number))));
  if (kept.number > 0) {
    out += line(
        "", fmt::format("selection: among first impacts the mean e goes from {:.4f} to {:.4f}, the "
                        "mean diameter from {:.4g} to {:.4g} um",
                        first.restitution, kept.restitution, first.diameter / units::um,
                        kept.diameter / units::um));
  }
  out += line("",
              "it acts on the incident velocity only, so e above it is not selected; but slow "
              "first impacts, where adhesion shows, are gone");
  return out;
}

std::string angle_text(const PassageTable& table, const PairingResult& pairs) {
  if (!pairs.options.angle) return "";
  if (!table.has_tangential) {
    return line("angle", "not applied: the file has no tangential_velocity");
  }
  const Selected outside =
      selected(pairs, [&](const Impact& i) { return i.angle > *pairs.options.angle; });
  return line("angle",
              fmt::format("{} rebounds leave at more than {:g} degrees from the normal and "
                          "are not used",
                          outside.number, *pairs.options.angle / degree));
}

std::string unpaired_text(const PairingResult& pairs, const Averages& averages) {
  std::string out =
      line("unpaired",
           fmt::format("{} used passages towards the surface have no rebound:", averages.unpaired));
  out += line("", fmt::format("{:8.0f}  lost: {:.1f} % of rebounds go unseen ({}); {} of them are "
                              "proved by a later return",
                              averages.lost, 100.0 * averages.lost_share,
                              pairs.options.lost_share
                                  ? "as stated"
                                  : fmt::format("{} of {} rebounds lack their way down, and the "
                                                "way up is taken to be missed as often",
                                                pairs.orphans, pairs.up),
                              averages.came_back));
  out +=
      line("", fmt::format("{:8.0f}  too slow: below {:.4f} m/s at the surface a rebound does not "
                           "climb to the plane; from the scatter of e of those that do",
                           averages.too_slow, flight::slowest_return(pairs.height)));
  out += line("", fmt::format("{:8}  captured", averages.captured));
  out +=
      line("", fmt::format("{:8.0f}  not assigned: too few in their bins to be told from accident",
                           averages.unresolved));
  out +=
      line("", fmt::format("of the fastest quarter, {:.1f} % of {} have no rebound: if capture is "
                           "over there, this is the share that is lost (--lost-share)",
                           100.0 * averages.fast_unpaired, averages.fast_impacts));
  out += line("",
              "a single passage tells nothing: captured, too slow and lost look alike, and only "
              "their numbers can be estimated. Where few rebounds are left in a bin, captured "
              "includes too slow.");
  return out;
}

std::string points_text(const Averages& averages) {
  std::string out =
      line("points", fmt::format("{}; a bin spans at least {:.2g} % of its velocity, 6 sd of the "
                                 "velocities' error",
                                 averages.points.size(), 100.0 * averages.narrowest));
  if (averages.outside_sizes > 0) {
    out +=
        line("", fmt::format("{} impacts lie outside of the size classes", averages.outside_sizes));
  }
  if (averages.in_small_bins > 0) {
    out += line("", fmt::format("{} impacts stand alone in velocity, fewer than 5 together, and "
                                "are left out",
                                averages.in_small_bins));
  }
  constexpr std::size_t most = 40;
  out += fmt::format("  {:<24} {:>7} {:>9} {:>9} {:>8} {:>8} {:>7} {:>8}\n", "series", "d [um]",
                     "V [m/s]", "e", "sd(e)", "rebounds", "missing", "captured");
  for (std::size_t i = 0; i < averages.points.size() && i < most; ++i) {
    const PointMean& point = averages.points[i];
    out +=
        fmt::format("  {:<24} {:>7.4g} {:>9.4f} {:>9} {:>8} {:>8} {:>7} {:>8}\n", point.series,
                    point.diameter / units::um, point.velocity,
                    point.rebounds > 0 ? fmt::format("{:.4f}", point.restitution) : "-",
                    point.restitution_sd > 0.0 ? fmt::format("{:.4f}", point.restitution_sd) : "-",
                    point.rebounds, point.unpaired, point.captured);
  }
  if (averages.points.size() > most) {
    out += fmt::format("  ... and {} more\n", averages.points.size() - most);
  }
  return out;
}

}  // namespace

std::string describe(const PassageTable& table, const PairingResult& pairs,
                     const Averages& averages) {
  return rows_text(table) + pairs_text(pairs) + threshold_text(table, pairs) +
         angle_text(table, pairs) + unpaired_text(pairs, averages) + points_text(averages);
}

}  // namespace recoil
