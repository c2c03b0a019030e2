#include "report/words_dataset.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/units.hpp"
#include "data/text.hpp"
#include "mechanism/survivors_mean.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

std::string release_words(const ReleaseCheck& check) {
  return fmt::format("{:g} mm: e = {:.3f} at the first bounce, {:.3f} at the second, {:+.1f} mm",
                     check.height / units::mm, check.first, check.second,
                     check.missing / units::mm);
}

std::string air_sentence(const AirShare& air) {
  const auto share = [](double part, double velocity) {
    return fmt::format("{:.2g} % at {:.3g} m/s", 100.0 * part, velocity);
  };
  const std::string slow = share(air.slow_share, air.slow);
  const std::string fast = share(air.fast_share, air.fast);
  return fmt::format(
      "the effect of air drag ({:g} Pa, {:g} K) was removed; it had lowered e by {} "
      "(--ambient-pressure 0 for vacuum)",
      air.pressure, air.temperature, slow == fast ? slow : slow + " and by " + fast);
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

std::vector<Block> data_banners(const std::vector<Dataset>& datasets) {
  std::vector<Block> banners;
  for (const auto& [label, sentence] : provenances(datasets)) {
    banners.emplace_back(Banner{label, sentence});
  }
  for (const Dataset& dataset : datasets) {
    for (const DatasetWarning& warning : dataset.warnings) {
      using enum PointRemark;
      const bool changes_results = warning.remark == unmarked_zero ||
                                   warning.remark == error_above_velocity ||
                                   warning.remark == tiny_restitution;
      if (!changes_results) continue;
      banners.emplace_back(Paragraph{as_sentence(Sentence(warning_sentence(warning)))});
    }
    const std::string oblique = normal_component_words(dataset);
    if (oblique.empty()) continue;
    const std::string of = datasets.size() > 1 ? dataset.id + ": " : "";
    banners.emplace_back(Paragraph{as_sentence(Sentence(of + oblique))});
  }
  return banners;
}

std::string warning_sentence(const DatasetWarning& warning) {
  const auto points_with = [&](const char* what, const std::string& advice) {
    return fmt::format("{} with {} ({} line {}): {}", counted(warning.count, "point"), what,
                       warning.count == 1 ? "in" : "first in", warning.first_line, advice);
  };
  switch (warning.remark) {
    case PointRemark::restitution_above_one:
      return points_with("a restitution above 1",
                         "kept, since noise can cause it; energy cannot be gained");
    case PointRemark::unmarked_zero:
      return points_with("a restitution of 0 that is not marked as captured",
                         "taken as captured, since no rebound has a velocity of 0");
    case PointRemark::unusual_diameter:
      return points_with("a diameter above 1 mm", "kept; check the unit if these are microspheres");
    case PointRemark::oblique:
      return points_with(
          "an angle of incidence above 8 degrees",
          fmt::format(
              "kept, up to {:.3g} degrees; Li, Dunn & Brach (1999) kept to 8 degrees of the "
              "normal",
              in_degrees(warning.largest)));
    case PointRemark::repeated:
      return points_with("the same series, diameter, velocity and restitution as an earlier one",
                         "kept; a point copied by accident counts twice");
    case PointRemark::error_above_velocity:
      return points_with("a standard deviation of the velocity above the velocity itself",
                         "kept; check the two units");
    case PointRemark::tiny_restitution:
      return points_with("a restitution of 0.02 or less, and none above it",
                         "kept; check whether e is in per cent or a velocity in another unit");
    case PointRemark::other_bytes:
      return "the file of the points has another size or hash than datapackage.json states: it was "
             "changed since; correct 'bytes' and 'hash' there, or remove them";
  }
  return "";
}

std::string normal_component_words(const Dataset& dataset) {
  std::size_t oblique = 0;
  double largest = 0.0;
  for (const ImpactPoint& point : dataset.points) {
    if (!(point.incidence_angle > 0.0)) continue;
    ++oblique;
    largest = std::max(largest, point.incidence_angle);
  }
  if (oblique == 0) return "";
  return fmt::format(
      "V is the normal component of the velocity, incident_velocity times cos(incidence_angle), of "
      "{} at up to {:.3g} degrees",
      counted(static_cast<long long>(oblique), "point"), in_degrees(largest));
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

std::string note_sentence(const ImportNote& note) {
  using enum ImportRemark;
  const std::string names = listed(note.names);
  switch (note.remark) {
    case encoding_assumed:
      return "the file is not UTF-8 and was read as Windows-1252: check names with accents";
    case sheet_read: {
      std::vector<std::string> others = note.names;
      const std::string read = quote(others.front());
      others.erase(others.begin());
      return others.empty()
                 ? fmt::format("the sheet {} was read", read)
                 : fmt::format("the sheet {} was read; --sheet NAME or NUMBER reads another: {}",
                               read, listed(others));
    }
    case columns_known:
      return fmt::format("columns were taken by their names: {}; --map names others", names);
    case decimal_commas:
      return "the numbers have decimal commas";
    case lines_skipped:
      return fmt::format("skipped as a comment or title: {}", names);
    case rows_left_out:
      return fmt::format("left out, because a cell that is needed is empty: {}", names);
    case rebounds_empty:
      return fmt::format(
          "without a rebound: {}. If spheres stuck there, name the column that says so with --map "
          "captured=COLUMN, or write 0 as the rebound",
          names);
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
      return counted(note.count, "pair") +
             " of intervals left out, because a bounce between them is missing";
    case release_heights:
      return fmt::format(
          "check of the release heights (extra fall that makes the first bounce equal the second): "
          "{}. An equal difference at all heights points to an offset of the scale",
          joined(note.releases, "; ", release_words));
    case impacts_skipped:
      return counted(note.count, "impact") +
             " left out: fewer than four samples of free flight on one side";
    case track_fall:
      return fmt::format(
          "the tracks fall with {:.3g} m/s2 instead of {:.5g}: the scale or the frame rate is "
          "wrong; e does not depend on the scale, V does",
          note.fall, note.gravity);
    case axis_points_down:
      return "the heights are taken as measured downward: only so are the flights parabolas of a "
             "fall";
    case impossible_left_out:
      return fmt::format("impacts with e above {:g} were left out, look there: {}",
                         limits::restitution.upper, fmt::join(note.names, ", "));
    case frames_repeated:
      return counted(note.count, "frame") +
             " left out: the film repeats frames, so that the ball stands still in flight";
    case tracks_without_impact:
      return fmt::format("no impact was found in {}", names);
    case frames_mended:
      return "the rows count as frames; " + counted(note.count, "frame") +
             " that the film lost or shows twice, as steps of double or no length tell, were "
             "allowed for";
    case impacts_heard:
      return fmt::format("{} heard; an instant is known to {:.2g} ms (--time-error sets it)",
                         counted(note.count, "impact"), note.time_sd / units::ms);
    case shared_bounces:
      return "successive points of one launch share a measured value; without --time-error a fit "
             "takes their errors as independent";
    case shared_values:
      return "successive points of one launch share a measured value; a fit takes their errors as "
             "independent";
    case mean_of_bounces:
      return "every point is the mean of several bounces, which are taken to have one e";
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

}  // namespace recoil
