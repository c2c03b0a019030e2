#include "report/words_dataset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "core/units.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

/// Smallest and largest of the values seen so far.
struct Span {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();

  void add(double value) {
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }

  /// "2.58", "1.5 to 98", or "-" when nothing was seen.
  std::string text() const {
    if (lowest > highest) return "-";
    const std::string from = fmt::format("{:.4g}", lowest);
    const std::string to = fmt::format("{:.4g}", highest);
    return from == to ? from : fmt::format("{} to {}", from, to);
  }
};

struct SeriesSummary {
  std::size_t points = 0;
  long long events = 0;
  long long captured = 0;
  Span diameter_um;
  Span velocity;
  Span restitution;  ///< of points with rebounds
};

std::vector<SeriesSummary> summarise(const Dataset& dataset) {
  std::vector<SeriesSummary> summaries(dataset.series.size());
  for (const ImpactPoint& point : dataset.points) {
    SeriesSummary& series = summaries[point.series];
    ++series.points;
    series.events += point.events;
    series.captured += point.captured;
    series.diameter_um.add(point.diameter / units::um);
    series.velocity.add(point.incident_velocity);
    if (!point.all_captured()) series.restitution.add(point.restitution);
  }
  return summaries;
}

std::string describe(const Material& material) {
  std::string text = material.name.empty() ? "unnamed" : material.name;
  if (material.density > 0.0) text += fmt::format(", density {:g} kg/m3", material.density);
  text += fmt::format(", E {:g} GPa, nu {:g}", material.youngs_modulus / units::GPa,
                      material.poisson_ratio);
  text += material.surface_energy
              ? fmt::format(", surface energy {:g} J/m2", *material.surface_energy)
              : std::string(", surface energy by Gilman's estimate");
  return text;
}

std::string overrides(const ImpactSystem& system) {
  std::vector<std::string> stated;
  if (system.stiffness_K)
    stated.push_back(fmt::format("K {:g} GPa", *system.stiffness_K / units::GPa));
  if (system.adhesion_energy) {
    stated.push_back(fmt::format("adhesion energy {:g} J/m2", *system.adhesion_energy));
  }
  if (system.adhesion_force_f0) {
    stated.push_back(fmt::format("f0 {:g} N/m", *system.adhesion_force_f0));
  }
  if (system.reference_diameter) {
    stated.push_back(
        fmt::format("reference diameter {:g} um", *system.reference_diameter / units::um));
  }
  return join(stated);
}

/// Characters, not bytes, so that tables stay straight.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

std::string padded(const std::string& text, std::size_t width) {
  const std::size_t own = width_of(text);
  return text + std::string(width > own ? width - own : 0, ' ');
}

/// `text` broken at blanks into lines of at most `width` characters where that is possible.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines(1);
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    std::string& line = lines.back();
    if (line.empty()) {
      line = word;
    } else if (width_of(line) + 1 + width_of(word) <= width) {
      line += fmt::format(" {}", word);
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

std::string series_table(const Dataset& dataset) {
  std::vector<std::vector<std::string>> rows = {
      {"series", "diameter [um]", "points", "V [m/s]", "e [1]", "events", "captured"}};
  const std::vector<SeriesSummary> summaries = summarise(dataset);
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const SeriesSummary& s = summaries[i];
    rows.push_back({dataset.series[i], s.diameter_um.text(), std::to_string(s.points),
                    s.velocity.text(), s.restitution.text(), std::to_string(s.events),
                    std::to_string(s.captured)});
  }
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line = " ";
    for (std::size_t i = 0; i < row.size(); ++i)
      line += fmt::format(" {}", padded(row[i], widths[i] + 1));
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string list(const std::string& heading, const std::vector<std::string>& lines) {
  if (lines.empty()) return "";
  std::string text = heading + "\n";
  for (const std::string& line : lines) text += fmt::format("  - {}\n", line);
  return text;
}

std::string columns_line(const Dataset& dataset) {
  std::vector<std::string> names;
  for (const DataColumn& column : dataset.columns) {
    names.push_back(column.unit.empty() ? column.name
                                        : fmt::format("{} [{}]", column.name, column.unit));
  }
  return join(names);
}

}  // namespace

std::string provenance_sentence(Provenance provenance) {
  switch (provenance) {
    case Provenance::measured:
      return "These points were measured and stand here as their source gives them.";
    case Provenance::digitised:
      return "These points were read off a published figure, so the error of that reading comes on "
             "top of the error of the experiment.";
    case Provenance::reconstruction:
      return "This is a reconstruction: its points were generated by a committed recipe from "
             "published facts and not one of them was measured, so results fitted to them show "
             "what the method does, not what the experiment found.";
    case Provenance::synthetic:
      return "These points were simulated with known parameters: they test the method and say "
             "nothing about any experiment.";
  }
  return "";
}

std::string warning_sentence(const DatasetWarning& warning) {
  const auto say = [&](const char* what, const char* advice) {
    return fmt::format("{} point{} with {} ({} line {}): {}", warning.count,
                       warning.count == 1 ? "" : "s", what, warning.count == 1 ? "in" : "first in",
                       warning.first_line, advice);
  };
  switch (warning.remark) {
    case PointRemark::restitution_above_one:
      return say("a restitution above 1", "kept, since noise can do this; energy cannot");
    case PointRemark::unmarked_zero:
      return say("a restitution of 0 that is not marked as captured",
                 "taken as the slowest of rebounds; use the column 'captured' for spheres that "
                 "stayed");
    case PointRemark::unusual_diameter:
      return say("a diameter above 1 mm", "kept; if these are microspheres, the unit is wrong");
    case PointRemark::repeated:
      return say("the same series, diameter, velocity and restitution as an earlier one",
                 "kept; a point that was copied by accident would count twice");
  }
  return "";
}

std::string describe(const Dataset& dataset) {
  std::string text;
  const auto entry = [&](const std::string& label, const std::string& value) {
    if (!value.empty()) text += fmt::format("{:<12}{}\n", label, value);
  };
  entry("dataset", dataset.id);
  entry("title", dataset.title);
  entry("provenance", to_string(dataset.provenance));
  for (const std::string& line : wrapped(provenance_sentence(dataset.provenance), 84)) {
    entry("", line);
  }
  entry("particle", describe(dataset.system.particle));
  entry("surface", describe(dataset.system.surface));
  entry("stated", overrides(dataset.system));
  entry("columns", columns_line(dataset));
  entry("points", fmt::format("{} in {} series", dataset.points.size(), dataset.series.size()));
  entry("sha256", dataset.sha256);
  text += fmt::format("\n{}", series_table(dataset));
  if (!dataset.sources.empty() || !dataset.warnings.empty()) text += "\n";
  text += list("sources", dataset.sources);
  std::vector<std::string> warnings;
  for (const DatasetWarning& warning : dataset.warnings) {
    warnings.push_back(warning_sentence(warning));
  }
  text += list("warnings", warnings);
  return text;
}

}  // namespace recoil
