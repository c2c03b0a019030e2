#include "report/words_dataset.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "core/units.hpp"
#include "data/text.hpp"
#include "document/terminal.hpp"
#include "mechanism/survivors_mean.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

// ---- limits of the model ------------------------------------------------------------------------

constexpr double dmt_limit = 0.1;  // DMT holds for Tabor parameters below this

std::string impact_words(const Validity& v) {
  return fmt::format("{:.3g} m/s, {}", v.velocity, diameter_words(v.diameter));
}

std::string pressure_words(double pressure) {
  return pressure < units::GPa ? fmt::format("{:.2g} MPa", pressure / 1e6)
                               : fmt::format("{:.2g} GPa", pressure / units::GPa);
}

std::string tabor_words(const Validity& v) {
  const char* const model = "the model has the equilibrium of JKR";
  if (!v.exceeded()) return "adhesion acts inside the contact (JKR), as in the model";
  if (v.value < dmt_limit) return fmt::format("adhesion acts around the contact (DMT); {}", model);
  return fmt::format("between DMT, below 0.1, and JKR, above 5; {}", model);
}

const char* short_name(ValidityQuantity quantity) {
  using enum ValidityQuantity;
  static constexpr Phrase<ValidityQuantity> phrases[] = {
      {contact_radius, "contact radius over that of the sphere"},
      {pressure_modulus, "peak pressure over E*"},
      {pressure_yield, "peak pressure over the yield pressure"},
      {tabor, "Tabor parameter"},
      {wave_transits, "contact time over a wave's transit"}};
  return phrase_for(phrases, quantity).words;
}

// ---- import ------------------------------------------------------------------------------------

std::string release_words(const ReleaseCheck& check) {
  return fmt::format("{:g} mm: e = {:.3f} at the first bounce, {:.3f} at the second, {:+.1f} mm",
                     check.height / units::mm, check.first, check.second,
                     check.missing / units::mm);
}

std::string air_sentence(const AirShare& air) {
  return fmt::format(
      "the effect of air drag ({:g} Pa, {:g} K) was removed; it had lowered e by {:.2g} % at "
      "{:.3g} m/s and by {:.2g} % at {:.3g} m/s (--ambient-pressure 0 for vacuum)",
      air.pressure, air.temperature, 100.0 * air.slow_share, air.slow, 100.0 * air.fast_share,
      air.fast);
}

}  // namespace

std::string_view words_of_constant(Constant constant) {
  using enum Constant;
  static constexpr Phrase<Constant> phrases[] = {
      {density, "density"},
      {youngs_modulus, "Young's modulus"},
      {poisson_ratio, "Poisson's ratio"},
      {surface_energy, "surface energy"},
      {gilman_factor, "surface energy by Gilman's estimate"},
      {stiffness_K, "K"},
      {adhesion_energy, "adhesion energy"},
      {adhesion_force_f0, "f0"}};
  return phrase_for(phrases, constant).words;
}

std::string provenance_sentence(Provenance provenance) {
  using enum Provenance;
  static constexpr Phrase<Provenance> phrases[] = {
      {measured, "These points were measured."},
      {digitised, "These points were read off a published figure, which adds a reading error."},
      {reconstruction, "Computed points, not measured: they test the method only."},
      {synthetic, "These points were simulated with known parameters to test the method."}};
  return phrase_for(phrases, provenance).words;
}

std::vector<Block> provenance_banners(const std::vector<Dataset>& datasets) {
  std::vector<Block> banners;
  for (const auto& [label, sentence] : provenances(datasets)) {
    banners.emplace_back(Banner{label, sentence});
  }
  return banners;
}

std::string warning_sentence(const DatasetWarning& warning) {
  const auto points_with = [&](const char* what, const char* advice) {
    const bool one = warning.count == 1;
    return fmt::format("{} point{} with {} ({} line {}): {}", warning.count, one ? "" : "s", what,
                       one ? "in" : "first in", warning.first_line, advice);
  };
  switch (warning.remark) {
    case PointRemark::restitution_above_one:
      return points_with("a restitution above 1",
                         "kept, since noise can cause it; energy cannot be gained");
    case PointRemark::unmarked_zero:
      return points_with("a restitution of 0 that is not marked as captured",
                         "taken as a rebound; mark captures in the column 'captured'");
    case PointRemark::unusual_diameter:
      return points_with("a diameter above 1 mm", "kept; check the unit if these are microspheres");
    case PointRemark::repeated:
      return points_with("the same series, diameter, velocity and restitution as an earlier one",
                         "kept; a point copied by accident counts twice");
  }
  return "";
}

std::string mixed_sizes_words(const MeasuredSizes& sizes) {
  const MixedSizes mixed = mixed_sizes_of(sizes);
  std::string words = fmt::format(
      "every point averages over {:.4g} to {:.4g} um (mean {:.4g} um, standard deviation of ln d "
      "{:.3g}{})",
      sizes.smallest / units::um, sizes.largest / units::um, sizes.mean_diameter() / units::um,
      mixed.spread,
      sizes.provenance == name_of(Provenance::reconstruction) ? ", a reconstruction" : "");
  if (mixed.slowest_seen > 0.0) {
    words += fmt::format("; rebounds below {:.3g} m/s are not detected", mixed.slowest_seen);
  }
  return words;
}

std::string stated_errors_words(const ImpactSystem& system) {
  std::string words;
  for (const Body body : values_of<Body>()) {
    std::vector<std::string> stated;
    for (const ConstantError& error : system.errors) {
      if (error.body != body) continue;
      const std::string_view name = words_of_constant(error.constant);
      const double value = system.value_of(error.body, error.constant).value_or(1.0);
      stated.push_back(is_positive(error.constant)
                           ? fmt::format("{} {:.3g} %", name, 100.0 * error.sd / value)
                           : fmt::format("{} {:.3g}", name, error.sd));
    }
    if (stated.empty()) continue;
    words +=
        fmt::format("{}{}: {}", words.empty() ? "" : "; ", name_of(body), fmt::join(stated, ", "));
  }
  return words;
}

std::string left_out_sentence(const std::vector<LeftOverride>& left_out) {
  return "ignored, as the materials contradict it: " +
         joined(left_out, ", ", [](const LeftOverride& one) {
           const double unit = one.key == "stiffness_K" ? units::GPa : 1.0;
           return fmt::format("{} = {:.4g} {name} (derived: {:.4g} {name})", one.key,
                              one.stated / unit, one.derived / unit,
                              fmt::arg("name", one.key == "stiffness_K"       ? "GPa"
                                               : one.key == "adhesion_energy" ? "J/m2"
                                                                              : "N/m"));
         });
}

std::string validity_sentence(const Validity& v) {
  using enum ValidityQuantity;
  static constexpr Phrase<ValidityQuantity> patterns[] = {
      {contact_radius,
       "the contact grows to {value:.2g} of the sphere's radius ({impact}); Hertz' theory holds up "
       "to about {limit:g}"},
      {pressure_modulus,
       "the peak pressure is {value:.2g} E* ({impact}); no solid withstands more than about "
       "{limit:g} E*"},
      {pressure_yield,
       "the peak pressure is {value:.2g} times the yield pressure of {yield}, {source} ({impact}); "
       "above {limit:g} the contact yields, which the base model ignores"},
      {tabor, "the Tabor parameter is {value:.2g} ({diameter}): {tabor}"},
      {wave_transits,
       "a wave crosses the sphere {value:.2g} times in one contact ({impact}); below {limit:g} the "
       "contact is not quasi-static"}};
  return fmt::format(fmt::runtime(phrase_for(patterns, v.quantity).words),
                     fmt::arg("value", v.value), fmt::arg("limit", v.limit),
                     fmt::arg("impact", impact_words(v)),
                     fmt::arg("diameter", diameter_words(v.diameter)),
                     fmt::arg("yield", pressure_words(v.yield_pressure)),
                     fmt::arg("source", v.yield_stated ? "by the stated strength"
                                                       : "taken as 0.03 E of the softer body"),
                     fmt::arg("tabor", tabor_words(v)));
}

std::vector<std::string> exceeded_limits(const std::vector<Validity>& validity,
                                         const std::vector<Dataset>& datasets) {
  std::vector<Validity> worst;  // one for each quantity
  for (const Validity& one : validity) {
    if (one.exceeded()) keep_worst(one, worst);
  }
  std::vector<std::string> sentences;
  for (const Validity& one : worst) {
    sentences.push_back(validity_sentence(one));
    if (datasets.size() < 2 || one.dataset >= datasets.size()) continue;
    sentences.back() =
        fmt::format("on {}, {}", short_name(datasets, one.dataset), sentences.back());
  }
  return sentences;
}

Table validity_table(const std::vector<Validity>& validity) {
  Table table;
  if (validity.empty()) return table;
  table.caption = "where the model holds:";
  table.columns = {{}, {"value"}, {"valid", "", true}};
  for (const Validity& one : validity) {
    table.rows.push_back({Sentence(short_name(one.quantity)), Number{one.value, significant(3)},
                          Sentence(fmt::format("{} {:g}{}", one.limit_is_least() ? "from" : "up to",
                                               one.limit, one.exceeded() ? ": outside" : ""))});
  }
  return table;
}

std::string note_sentence(const ImportNote& note) {
  using enum ImportRemark;
  const std::string names = listed(note.names);
  switch (note.remark) {
    case encoding_assumed:
      return "the file is not UTF-8 and was read as Windows-1252: check names with accents";
    case workbook_converted:
      return fmt::format("the first sheet of the workbook was read by {}", names);
    case lines_skipped:
      return fmt::format("skipped as a comment or title: {}", names);
    case rows_left_out:
      return fmt::format("left out, because a cell that is needed is empty: {}", names);
    case signed_velocities:
      return "the signs of the velocities were taken as directions";
    case first_bounces_missed:
      return fmt::format(
          "bounces between the release and the first one listed were missed, by launch: {}. The "
          "release height is not used there",
          names);
    case bounces_suspected:
      return fmt::format(
          "a bounce may be missing before {}: e is there the square of the others. If so, put a "
          "row with an empty cell in its place: the launch is then split there",
          names);
    case first_bounces_not_used:
      return "the bounces after the release are not used as points, as no error of the release "
             "height is stated: state it with --drop-error 2mm";
    case diameter_not_used:
      return "--diameter was not used: the file has a diameter for every point";
    case diameters_from_names:
      return fmt::format("diameters were taken from the names of the series: {}", names);
    case columns_not_used:
      return fmt::format("columns not used: {}", names);
    case no_reading_error:
      return "no reading error is stated: --axis x=log,1,100 --axis y=linear,0,1 --reading-error "
             "0.5% converts one into velocity_sd and restitution_sd";
    case reading_error_alone:
      return "restitution_sd contains the reading error only: add the scatter of the experiment "
             "with --scatter 10%, or let the fit estimate it ([noise] variance)";
    case few_drops:
      return "some heights have fewer than five drops, too few for a standard error; "
             "--rebound-error sets the least";
    case no_drop_error:
      return "no error of the drop height is stated: state it with --drop-error 1mm";
    case without_air:
      return "V = sqrt(2 g h) ignores the air; both heights must refer to the same point of the "
             "ball";
    case same_point:
      return "both heights must refer to the same point of the ball";
    case air_drag:
      return air_sentence(note.air);
    case turbulent_air:
      return fmt::format(
          "the Reynolds number of the fastest impact, {:.2g}, is beyond the drag law (up to 2e5)",
          note.air.reynolds);
    case bounces_missing:
      return fmt::format("{} {} of intervals left out, because a bounce between them is missing",
                         note.count, note.count == 1 ? "pair" : "pairs");
    case release_heights:
      return fmt::format(
          "check of the release heights (extra fall that makes the first bounce equal the second): "
          "{}. An equal difference at all heights points to an offset of the scale",
          joined(note.releases, "; ", release_words));
    case impacts_skipped:
      return fmt::format("{} impact{} left out: fewer than four samples of free flight on one side",
                         note.count, note.count == 1 ? "" : "s");
    case track_fall:
      return fmt::format(
          "the tracks fall with {:.3g} m/s2 instead of {:.5g}: the scale or the frame rate is "
          "wrong, or air drag is large; e does not depend on the scale, V does",
          note.fall, note.gravity);
    case drag_stays:
      return "the effect of air drag on the tracks was not removed";
    case shared_bounces:
      return "successive points of one launch share a flight; a fit takes their errors as "
             "independent";
    case no_source:
      return "no source is stated: add --source \"Author (year), journal, figure\"";
    case licence_removed:
      return "the licence of the reconstruction was removed, as it does not cover these points";
    case recipe_set_aside:
      return fmt::format("the folder is no longer a reconstruction; its {} is kept as {}",
                         recipe_name, set_aside_recipe_name);
    case overrides_left_out:
      return left_out_sentence(note.left_out);
    case adhesion_left_out:
      return "adhesion is neglected: it takes less than 1e-6 of the energy of every impact "
             "(--adhesion-energy sets it)";
  }
  return "";
}

namespace {

constexpr std::size_t most_series = 4;  // listed in a sentence
constexpr double shown_level = 0.05;    // a smaller p-value is reported as a difference

/// The name of a series, with its size if its name is not unique, and with its dataset if there are
/// several.
std::string series_words(const RestitutionMean& mean, const RestitutionSummary& summary,
                         const std::vector<Dataset>& datasets) {
  const Dataset& dataset = datasets[mean.dataset];
  std::string name = dataset.series[mean.series];
  const auto same =
      std::count_if(summary.means.begin(), summary.means.end(), [&](const RestitutionMean& other) {
        return !other.velocity && other.dataset == mean.dataset && other.series == mean.series;
      });
  if (same > 1) name += " " + diameter_words(mean.diameter);
  return datasets.size() > 1 ? fmt::format("{} of {}", name, dataset.id) : name;
}

bool spans_a_decade(const RestitutionSummary& summary) {
  return summary.velocities[1] >= 10.0 * summary.velocities[0];
}

Sentence mean_words(const RestitutionMean& mean) {
  Number value{mean.value, padded(3)};
  if (mean.interval) value.band = {(*mean.interval)[0], (*mean.interval)[1]};
  return value.words();
}

Sentence ends_words(const TestedEffect& effect, double sign) {
  const double a = sign * (*effect.interval)[0];
  const double b = sign * (*effect.interval)[1];
  return say("[{:.2g}, {:.2g}]", std::min(a, b), std::max(a, b));
}

/// The dependence of e on V. If V spans a decade, the sentence includes the range of e.
Sentence dependence_words(const RestitutionSummary& summary) {
  const TestedEffect& effect = summary.velocity;
  if (!effect.p_value) {
    std::string why = effect.why;
    why.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(why.front())));
    return say("{}: the dependence of {e} on {V} is unknown.", why);
  }
  const std::string p = p_words(*effect.p_value);
  const bool steady = *effect.p_value < shown_level;
  const bool bent = summary.bend.value_or(1.0) < shown_level;
  if (!steady && !bent) {
    return say("No dependence of {e} on {V} is detected: {:.2g} {} per decade of {V} ({}).",
               *effect.value, ends_words(effect, 1.0), p);
  }
  const double sign = *effect.value < 0.0 ? -1.0 : 1.0;
  const char* const goes = sign < 0.0 ? "falls" : "rises";
  const Sentence slope =
      say("by {:.2g} {} per decade of {V} ({})", sign * *effect.value, ends_words(effect, sign), p);
  const Sentence no_slope =
      say("without a steady rise or fall ({})", p_words(summary.bend.value_or(1.0)));
  if (!spans_a_decade(summary)) {
    return steady ? say("{e} {} {}.", goes, slope) : say("{e} varies with {V}, {}.", no_slope);
  }
  const Sentence range =
      say("{e} depends on {V}: {:.3f} to {:.3f} for {V} = {:.3g} to {:.3g} m/s", summary.values[0],
          summary.values[1], summary.velocities[0], summary.velocities[1]);
  return steady ? range + say("; it {} {}.", goes, slope) : range + say(", {}.", no_slope);
}

}  // namespace

std::vector<Sentence> restitution_sentences(const RestitutionSummary& summary,
                                            const std::vector<Dataset>& datasets) {
  std::vector<Sentence> means;
  double least = INFINITY, most = 0.0;
  for (const RestitutionMean& mean : summary.means) {
    if (mean.velocity) continue;
    least = std::min(least, mean.value);
    most = std::max(most, mean.value);
    const std::string count =
        fmt::format(" ({} point{})", mean.points, mean.points == 1 ? "" : "s");
    means.push_back(summary.several_series ? say("{} {}{}", series_words(mean, summary, datasets),
                                                 mean_words(mean), count)
                                           : mean_words(mean) + count);
  }
  if (means.empty()) return {};
  std::vector<Sentence> sentences;
  const bool depends = summary.velocity.p_value.value_or(1.0) < shown_level ||
                       summary.bend.value_or(1.0) < shown_level;
  if (!depends || !spans_a_decade(summary)) {
    sentences.push_back(means.size() > most_series ? say("Mean {e} of {} series: {:.3f} to {:.3f}.",
                                                         means.size(), least, most)
                                                   : say("Mean {e}: {}.", join(means, "; ")));
  }
  sentences.push_back(dependence_words(summary));
  const TestedEffect& differ = summary.series;
  if (differ.p_value) {
    const std::string p = p_words(*differ.p_value);
    const auto name = [&](std::size_t k) {
      return series_words(summary.means[summary.most_different[k]], summary, datasets);
    };
    if (*differ.p_value >= shown_level) {
      sentences.push_back(say("No difference between the series is detected ({}).", p));
    } else if (means.size() > most_series) {
      sentences.push_back(say("The series differ in {e} ({}), by up to {:.2g}.", p, *differ.value));
    } else {
      sentences.push_back(say("The series differ in {e} ({}): {} and {} by {:.2g} {}.", p, name(0),
                              name(1), *differ.value, ends_words(differ, 1.0)));
    }
  }
  return sentences;
}

Table restitution_table(const RestitutionSummary& summary, const std::vector<Dataset>& datasets) {
  Table table;
  if (summary.means.size() < 2) return table;
  const SizeUnit sizes = size_unit(datasets);
  table.caption = say("Mean {e} of every series and setting, with 95 % intervals");
  table.columns = {{"series", "", true},  {say("{d}"), sizes.name},
                   {"setting", "", true}, {say("{V}"), "m/s"},
                   {say("{e}")},          {"points"}};
  for (const RestitutionMean& mean : summary.means) {
    table.rows.push_back({Sentence(datasets[mean.dataset].series[mean.series]),
                          Sentence(size_text(mean.diameter, sizes)),
                          mean.setting.empty() ? Cell() : Cell(Sentence(mean.setting)),
                          mean.velocity ? Cell(Number{*mean.velocity, significant(4)}) : Cell(),
                          mean_words(mean), whole(mean.points)});
  }
  return table;
}

// ---- tables ------------------------------------------------------------------------------------

namespace {

/// The range of the added values.
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
  if (system.adhesion_force_f0) {
    stated.push_back(say("{f0} {:g} N/m", *system.adhesion_force_f0));
  }
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

std::vector<Section> dataset_sections(const Dataset& dataset) {
  std::vector<std::string> warnings;
  for (const DatasetWarning& warning : dataset.warnings) {
    warnings.push_back(warning_sentence(warning));
  }
  return {
      shown_section("dataset", "Dataset",
                    {dataset_table(dataset), Paragraph{provenance_sentence(dataset.provenance)}}),
      shown_section("series", "Series", {series_table(dataset)}),
      shown_section("sources", "Sources", {plain_list(dataset.sources)}),
      shown_section("warnings", "Warnings", {plain_list(warnings)})};
}

std::string dataset_text(const Dataset& dataset) {
  return terminal_text(dataset_sections(dataset));
}

}  // namespace recoil
