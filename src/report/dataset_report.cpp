#include "report/dataset_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/units.hpp"
#include "data/contact.hpp"
#include "data/text.hpp"
#include "document/terminal.hpp"
#include "estimate/restitution_summary.hpp"
#include "report/format.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

struct Span {
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();

  void add(double value) {
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }

  /// "2.58", "1.5 to 98"; empty if no value was added.
  Cell cell() const {
    if (lowest > highest) return {};
    const std::string from = fmt::format("{:.4g}", lowest);
    const std::string to = fmt::format("{:.4g}", highest);
    if (from == to) return Number{lowest};
    return say("{} to {}", from, to);
  }
};

struct SeriesSummary {
  std::size_t points = 0;
  long long events = 0;
  long long captured = 0;
  Span diameter;     ///< in the unit of `size_unit`
  Span velocity;     ///< [m/s]
  Span restitution;  ///< of points with rebounds
};

std::vector<SeriesSummary> summarise(const Dataset& dataset) {
  std::vector<SeriesSummary> summaries(dataset.series.size());
  const SizeUnit unit = size_unit(std::span(&dataset, 1));
  for (const ImpactPoint& point : dataset.points) {
    SeriesSummary& series = summaries[point.series];
    ++series.points;
    series.events += point.events;
    series.captured += point.captured;
    series.diameter.add(point.diameter / unit.metres);
    series.velocity.add(point.incident_velocity);
    if (!point.all_captured() && !point.counts_only) series.restitution.add(point.restitution);
  }
  return summaries;
}

Sentence material_words(const Material& material) {
  Sentence words = material.name.empty() ? "unnamed" : material.name;
  if (material.density > 0.0) words += say(", density {:g} {kg/m3}", material.density);
  words +=
      say(", E {:g} GPa, nu {:g}", material.youngs_modulus / units::GPa, material.poisson_ratio);
  return words + (material.surface_energy
                      ? say(", surface energy {:g} {J/m2}", *material.surface_energy)
                      : Sentence(", surface energy by Gilman's estimate"));
}

/// The stated values that replace those derived from the materials.
Sentence override_words(const ImpactSystem& system) {
  std::vector<Sentence> stated;
  if (system.stiffness_K) stated.push_back(say("{K} {:g} GPa", *system.stiffness_K / units::GPa));
  if (system.adhesion_energy) {
    stated.push_back(say("adhesion energy {:g} {J/m2}", *system.adhesion_energy));
  }
  if (system.adhesion_force_f0) stated.push_back(say("{f0} {:g} N/m", *system.adhesion_force_f0));
  if (system.reference_diameter) {
    stated.push_back(say("reference diameter {}", diameter_sentence(*system.reference_diameter)));
  }
  return join(stated, ", ");
}

Sentence condition_words(const ImpactSystem& system) {
  std::vector<Sentence> stated;
  for (const Condition condition : values_of<Condition>()) {
    const auto value = system.conditions.of(condition);
    if (!value) continue;
    if (condition == Condition::ambient_pressure && *value == 0.0) {
      stated.push_back("vacuum");
    } else if (info_of(condition).yes_or_no) {
      stated.push_back(
          say("{}: {}", words_of(std::string(name_of(condition))), *value > 0.0 ? "yes" : "no"));
    } else {
      stated.push_back(say("{} {:g}{}", words_of(std::string(name_of(condition))), *value,
                           unit_after_number(info_of(condition).unit)));
    }
  }
  return join(stated, ", ");
}

Sentence column_words(const Dataset& dataset) {
  return joined(dataset.columns, ", ", [](const DataColumn& column) {
    return column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit);
  });
}

/// The entries without repetition, in their order.
std::vector<std::string> distinct(const std::vector<std::string>& entries) {
  std::vector<std::string> found;
  for (const std::string& entry : entries) {
    if (std::ranges::find(found, entry) == found.end()) found.push_back(entry);
  }
  return found;
}

List plain_list(const std::vector<std::string>& entries) {
  return {{entries.begin(), entries.end()}};
}

}  // namespace

Table dataset_table(const Dataset& dataset) {
  return items(
      {{"dataset", Sentence(dataset.id)},
       {"title", Sentence(dataset.title)},
       {"provenance", Sentence(to_string(dataset.provenance))},
       {"particle", material_words(dataset.system.particle)},
       {"surface", material_words(dataset.system.surface)},
       {"stated", override_words(dataset.system)},
       {"known to", Sentence(stated_errors_words(dataset.system))},
       {"conditions", condition_words(dataset.system)},
       {"sizes", Sentence(dataset.mixed_sizes ? mixed_sizes_words(*dataset.mixed_sizes) : "")},
       {"columns", column_words(dataset)},
       {"velocities", Sentence(normal_component_words(dataset))},
       {"points", say("{} in {} series", dataset.points.size(), dataset.series.size())},
       {"sha256", Sentence(dataset.sha256)}});
}

Table series_table(const Dataset& dataset) {
  Table table;
  table.columns = {{"series"},        {"diameter", size_unit(std::span(&dataset, 1)).name},
                   {"points"},        {say("{V}"), "m/s"},
                   {say("{e}"), "1"}, {"impacts"},
                   {"captured"}};
  const std::vector<SeriesSummary> summaries = summarise(dataset);
  for (std::size_t i = 0; i < summaries.size(); ++i) {
    const SeriesSummary& s = summaries[i];
    table.rows.push_back({Sentence(dataset.series[i]), s.diameter.cell(), whole(s.points),
                          s.velocity.cell(), s.restitution.cell(), whole(s.events),
                          whole(s.captured)});
  }
  return table;
}

plot::Picture restitution_picture(const Dataset& dataset, int width) {
  constexpr std::size_t most_marks = 2000;
  const std::size_t stride = dataset.points.size() / most_marks + 1;
  const std::size_t series = dataset.series.size();
  std::vector<plot::Points> marks(series);
  std::vector<std::vector<double>> sd(series);
  std::vector<double> velocities, values;
  for (std::size_t i = 0; i < dataset.points.size(); i += stride) {
    const ImpactPoint& point = dataset.points[i];
    if (point.all_captured() || point.counts_only) continue;
    marks[point.series].x.push_back(point.incident_velocity);
    marks[point.series].y.push_back(point.restitution);
    sd[point.series].push_back(point.restitution_sd.value_or(0.0));
    velocities.push_back(point.incident_velocity);
    for (const double by : {-sd[point.series].back(), sd[point.series].back()}) {
      values.push_back(point.restitution + by);
    }
  }
  constexpr double margin = 0.06;
  plot::Plot shown;
  shown.x = {.label = "incident velocity V", .unit = "m/s"};
  shown.y = {.label = "restitution e"};
  shown.x.set_range(plot::range_of(velocities, margin));
  shown.key = plot::KeyPlace::above;
  for (const RestitutionMean& mean : summarise_restitution({dataset}).means) {
    const std::vector<double>& own = marks[mean.series].x;
    if (!mean.interval || mean.velocity || own.empty()) continue;  // others are of settings
    const auto [lower, upper] = *mean.interval;
    const auto [slowest, fastest] = std::ranges::minmax(own);
    shown.layers.emplace_back(plot::Band{{slowest, fastest},
                                         {lower, lower},
                                         {upper, upper},
                                         {std::string(plot::marker(mean.series).colour), 0.25}});
    values.insert(values.end(), {lower, upper});
  }
  shown.y.set_range(plot::range_of(values, margin));
  for (std::size_t s = 0; s < series; ++s) {
    marks[s].marker = plot::marker(s);
    if (series <= plot::markers.size()) marks[s].name = dataset.series[s];
    shown.layers.emplace_back(marks[s].with_sd(sd[s]));
  }
  return {.name = "bounces",
          .title = "Restitution against incident velocity, " + dataset.id,
          .width = width,
          .height = width * 7 / 10,
          .plots = {std::move(shown)}};
}

std::vector<Section> dataset_sections(const Dataset& dataset) {
  std::vector<std::string> warnings;
  for (const DatasetWarning& warning : dataset.warnings) {
    warnings.push_back(warning_sentence(warning));
  }
  if (!dataset.points.empty()) {
    const std::vector<double> sizes = distinct_diameters(dataset);
    const ContactProperties contact = derive_contact(dataset.system, sizes[sizes.size() / 2]);
    warnings.insert(warnings.end(), contact.contradictions.begin(), contact.contradictions.end());
  }
  return {
      detail_section("dataset", "Dataset",
                     {dataset_table(dataset), Paragraph{provenance_sentence(dataset.provenance)}}),
      shown_section("series", "Series", {series_table(dataset)}),
      shown_section("warnings", "Warnings", {plain_list(warnings)}),
      detail_section("sources", "Sources", {plain_list(distinct(dataset.sources))})};
}

std::string dataset_text(const Dataset& dataset, Importance least) {
  return terminal_text(dataset_sections(dataset), least);
}

}  // namespace recoil
