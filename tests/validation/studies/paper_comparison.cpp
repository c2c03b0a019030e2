#include "validation/studies/paper_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/analysis.hpp"
#include "core/numerics.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/predictor.hpp"
#include "experiment/pairing_files.hpp"
#include "predict/simulated_impact.hpp"
#include "report/format.hpp"
#include "report/prediction_report.hpp"
#include "validation/recipe/recipe.hpp"
#include "validation/studies/paper_fit.hpp"

namespace recoil::paper {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> targets = {"molybdenum", "silicon", "mica"};  // of Wall et al.
constexpr double knee = 0.5;            // [m/s] above which e of steel changes little
constexpr double middle_size = 4.9e-6;  // [m] at which the paper calibrates fluorescein
constexpr double small_size = 2.58e-6;  // [m] the smallest of fluorescein

/// Everything that is computed once for all figures.
struct Material {
  std::vector<Fit> fits;
  fs::path root;
  Comparison out;

  const Fit& fit(std::string_view key) const {
    return *std::ranges::find_if(fits, [&](const Fit& one) { return one.key == key; });
  }
  void number(const std::string& id, double value) { out.findings[id].value = value; }
  void claim(const std::string& id, bool holds, Sentence words) {
    out.findings[id] = {std::nullopt, holds, std::move(words)};
  }
};

/// A share [1] as "17 %".
std::string whole_percent(double share) { return text_of(share, in_percent(fixed(0))); }

// ---- Table 1 and Fig. 8: constants -------------------------------------------------------------

/// The contact that follows from E and nu alone.
ContactProperties contact_of_materials(const Dataset& data) {
  ImpactSystem system = data.system;
  system.stiffness_K.reset();
  system.adhesion_energy.reset();
  system.adhesion_force_f0.reset();
  return derive_contact(system, system.reference_diameter.value());
}

/// f0 [N/m] as all points have it, if it is fitted instead of taken from eq. 12.
Sentence fitted_f0_words(const Fit& fit) {
  const std::size_t slot = fit.a.fitted.model.slot_adhesion.at(0);
  for (const ComparisonRow& row : fit.two_point().rows) {
    if (row.row != CalibrationKind::full_f0_free || row.theta.empty()) continue;
    const double error = row.standard_errors.empty() ? 0.0 : row.standard_errors.at(slot);
    return Number{row.theta.at(slot), significant(3), error}.words() + " on " +
           fit.data().system.surface.name;
  }
  return {};
}

void add_constants(Material& all) {
  for (const auto& [key, fit] : {std::pair("molybdenum", "molybdenum"),
                                 {"silicon", "silicon"},
                                 {"mica", "mica"},
                                 {"quartz", "quartz"},
                                 {"steel", "sst65"}}) {
    const ContactProperties contact = contact_of_materials(all.fit(fit).data());
    const std::string id = key;
    all.number(id + "-K", contact.stiffness / units::GPa);
    all.number(id + "-W", contact.adhesion_energy);
    all.number(id + "-r", in_um(contact.reference_diameter) / 2.0);
    all.number(id + "-f0", contact.adhesion_force);
  }
  const ContactProperties printed = all.fit("sst65").a.fitted.model.contacts.at(0);
  PartResult& part = all.out.parts["table-1"];
  part.gain = say("{f0} from the points themselves, with its error");
  part.words =
      say("The row of steel contradicts itself: its E and nu give K = {:.0f} GPa, and the printed "
          "K and W give {f0} = {:.0f} N/m by eq. 12. Two points cannot test {f0}. Fitted to all "
          "points it is, in N/m, {}.",
          *all.out.findings["steel-K"].value, printed.adhesion_force_derived,
          joined(std::vector<std::string>{"molybdenum", "silicon", "mica", "quartz"}, ", ",
                 [&](const std::string& key) { return fitted_f0_words(all.fit(key)); }));
}

/// The exponent of r in f0 with its error, if the points of a fit may choose it.
Number fitted_exponent(const Material& all, const Fit& fit) {
  std::string text = fit.a.spec.text;
  const std::string table = "[model]\n";
  text.insert(text.find(table) + table.size(), "mechanisms = [\"size_law\"]\n");
  FitSpec spec = parse_fit(text, all.root / "fits" / (fit.file + ".toml"));
  const Analysis free = analyse_fit({std::move(spec), fit.a.datasets}, {});
  const auto& slots = free.fitted.model.slots;
  const auto slot = std::ranges::find_if(
      slots, [](const ParameterSlot& one) { return one.label() == "size_exponent"; });
  const auto place = static_cast<std::size_t>(slot - slots.begin());
  return {free.fitted.theta.at(place), significant(3), free.fitted.std_error.at(place)};
}

void add_size_law(Material& all) {
  plot::Plot shown;
  shown.x = {"radius r", "µm"};
  shown.y = {"adhesion force f0", "N/m"};
  shown.key = plot::KeyPlace::below;
  shown.x.logarithmic = shown.y.logarithmic = true;
  std::vector<double> radii, forces;
  std::size_t count = 0;
  Sentence exponents;
  for (const std::string& key : targets) {
    const ContactProperties contact = contact_of_materials(all.fit(key).data());
    plot::Line line{.x = {}, .y = {}, .stroke = {plot::marker(count).colour, 1.7}};
    line.mark = plot::marker(count++).mark;
    line.name = key;
    for (const double diameter : distinct_diameters(all.fit(key).data())) {
      line.x.push_back(in_um(diameter) / 2.0);
      line.y.push_back(contact.adhesion_force_at(contact.adhesion_force, diameter));
    }
    radii.insert(radii.end(), line.x.begin(), line.x.end());
    forces.insert(forces.end(), line.y.begin(), line.y.end());
    all.number("slope-" + key,
               std::log(line.y.back() / line.y.front()) / std::log(line.x.back() / line.x.front()));
    shown.layers.push_back(std::move(line));
    if (!exponents.empty()) exponents += ", ";
    exponents += fitted_exponent(all, all.fit(key)).words() + " on " + key;
  }
  shown.x.set_range(plot::log_range_of(radii, 0.08));
  shown.y.set_range(plot::log_range_of(forces, 0.08));
  shown.x.ticks = {{1.5, "1.5"}, {2.0, "2"}, {2.5, "2.5"}, {3.0, "3"}, {3.5, "3.5"}};
  shown.y.ticks = {{5.0, "5"}, {6.0, "6"}, {7.0, "7"}, {8.0, "8"}, {9.0, "9"}, {10.0, "10"}};
  PartResult& part = all.out.parts["fig-8"];
  part.gain = "the exponent from the points of four sizes";
  part.words =
      say("Eq. 12 has the exponent 1/3 for any material. If the points choose it, it is {}. "
          "The reconstruction has 1/3, and a {C_A} that grows with the size, which such "
          "an exponent absorbs.",
          exponents);
  part.blocks = {
      Figures{{figure("fig-8", "Adhesion force against radius", std::move(shown),
                      say("{f0} by eq. 12 at the four sizes; both axes logarithmic."))}}};
}

// ---- Figs. 3 and 4: events ---------------------------------------------------------------------

/// Events that the instrument would have recorded, and their pairs.
struct Events {
  PairingResult pairs;
  Distributions seen;
  std::size_t spheres = 0;    ///< that came in first and count
  std::size_t rebounded = 0;  ///< of them, with a paired rebound
};

/// @param times as many spheres as the recipe has
Events events_of(const Recipe& recipe, int times) {
  PassageFormat format;
  format.units = {
      {"time", "s"}, {"velocity", "m/s"}, {"tangential_velocity", "m/s"}, {"diameter", "um"}};
  const PassageTable table =
      parse_passages(draw_passages(recipe, recipe.seed, times), "events.csv", "", format);
  PairingOptions options;
  options.height = recipe.pairing.value().height;
  options.angle = recipe.pairing.value().angle;
  Events events;
  events.pairs = pair_passages(table.passages, options);
  events.seen = distributions(table, events.pairs);
  events.spheres = events.seen.incoming_sizes.size();
  events.rebounded = static_cast<std::size_t>(std::ranges::count_if(
      events.pairs.impacts, [](const Impact& impact) { return impact.number == 1; }));
  return events;
}

/// The recipe of a dataset, also after an import has replaced its points.
Recipe recipe_of(const Fit& fit) {
  const fs::path& folder = fit.data().folder;
  return load_recipe(folder,
                     fs::exists(folder / recipe_name) ? recipe_name : set_aside_recipe_name);
}

void add_sizes(Material& all) {
  std::vector<Figure> figures;
  for (const std::string key : {"sst125", "sst65"}) {
    const MeasuredSizes sizes = *sizes_of_dataset(all.fit(key).data().folder);
    all.number(key + "-smallest", in_um(sizes.smallest));
    all.number(key + "-largest", in_um(sizes.largest));
    all.number(key + "-mean", in_um(sizes.mean_diameter()));
    const Events events = events_of(recipe_of(all.fit(key)), 1);
    const std::string name = key == "sst65" ? "SST65" : "SST125";
    plot::Plot shown = histogram_plot(events.seen.incoming_sizes, "diameter", "µm", units::um);
    shown.heading = name;
    figures.push_back(
        figure("fig-3-" + key, "Sizes of " + name, std::move(shown),
               say("{} made spheres in {} bins by Sturges' rule, as in the paper.", events.spheres,
                   sturges(events.seen.incoming_sizes).counts.size())));
  }
  PartResult& part = all.out.parts["fig-3"];
  part.gain = "every point is averaged over these sizes";
  part.words =
      "The paper's calibration gives every sphere the mean diameter. recoil averages each "
      "point over the whole distribution while it fits.";
  part.blocks = {Figures{std::move(figures)}};
}

std::vector<double> incoming(const std::vector<double>& velocities) {
  std::vector<double> down;
  std::ranges::copy_if(velocities, std::back_inserter(down), [](double v) { return v > 0.0; });
  std::ranges::sort(down);
  return down;
}

/// Share of velocities below half the middle one [1].
double slow_share(const std::vector<double>& sorted) {
  const double limit = 0.5 * sorted_quantile(sorted, 0.5);
  return static_cast<double>(std::ranges::lower_bound(sorted, limit) - sorted.begin()) /
         static_cast<double>(sorted.size());
}

void add_velocities(Material& all) {
  constexpr int spheres = 5;  // times the 40 rebounds of one point: 200
  const auto dropped = [&](double height) {
    Recipe recipe = recipe_of(all.fit("sst65"));
    recipe.series.at(0).velocities = {std::sqrt(2.0 * standard_gravity * height)};
    recipe.plan = make_plan(recipe);
    return events_of(recipe, spheres);
  };
  const Events high = dropped(0.22), low = dropped(0.04);
  all.number("free-fall", sorted_quantile(incoming(high.seen.raw_velocities), 0.5));
  const double share = static_cast<double>(high.rebounded) / static_cast<double>(high.spheres);
  all.claim("majority", share > 0.5,
            say("{} of {} rebound and are paired", high.rebounded, high.spheres));
  const std::vector<double> raw = incoming(low.seen.raw_velocities);
  const std::vector<double> paired = incoming(low.seen.paired_velocities);
  all.claim("broadened", slow_share(raw) > 0.02,
            say("{} of {} are slower than half the middle velocity", whole_percent(slow_share(raw)),
                raw.size()));
  all.claim("sorted", slow_share(paired) < 0.01,
            say("{} of {} pairs are, without a threshold", whole_percent(slow_share(paired)),
                paired.size()));
  const auto later = std::ranges::count_if(low.pairs.impacts,
                                           [](const Impact& impact) { return impact.number > 1; });
  std::vector<Figure> figures;
  const auto add = [&](const char* letter, const std::string& heading,
                       const std::vector<double>& velocities) {
    plot::Plot shown = histogram_plot(velocities, "normal velocity", "m/s", 1.0);
    shown.heading = fmt::format("({}) {}", letter, heading);
    figures.push_back(
        figure(fmt::format("fig-4-{}", letter), "Normal velocities, " + heading, std::move(shown),
               say("{} passages. Positive: towards the surface.", velocities.size())));
  };
  add("a", "all passages, from 22 cm", high.seen.raw_velocities);
  add("b", "all passages, from 4 cm", low.seen.raw_velocities);
  add("c", "paired passages, from 4 cm", low.seen.paired_velocities);
  PartResult& part = all.out.parts["fig-4"];
  part.gain = "second impacts found by their flight times, false pairs counted";
  part.words =
      say("Made events of SST65. {} second and later impacts from 4 cm are recognised by "
          "their flight times, so no threshold of velocity is needed. By chance {:.1f} of "
          "{} pairs are false. The measuring plane is found at {} mm; the events have "
          "1 mm.",
          later, low.pairs.expected_false, low.pairs.impacts.size(),
          Number{low.pairs.height / units::mm, significant(3), low.pairs.height_sd / units::mm});
  part.blocks = {Figures{std::move(figures)}};
}

// ---- Figs. 5, 7 and 9: restitution -------------------------------------------------------------

/// The values of e on one side of a velocity.
std::vector<double> restitutions(const Fit& fit, double velocity, bool above) {
  std::vector<double> found;
  for (const ImpactPoint& point : fit.data().points) {
    if ((point.incident_velocity >= velocity) == above) found.push_back(point.restitution);
  }
  return found;
}

/// The lowest and the highest velocity of the points [m/s].
std::pair<double, double> velocities_of(const Fit& fit) {
  const auto [slow, fast] =
      std::ranges::minmax(fit.data().points, {}, &ImpactPoint::incident_velocity);
  return {slow.incident_velocity, fast.incident_velocity};
}

void add_steels(Material& all) {
  const Fit &fine = all.fit("sst65"), &coarse = all.fit("sst125");
  all.number("slowest", std::min(velocities_of(fine).first, velocities_of(coarse).first));
  all.number("fastest", std::max(velocities_of(fine).second, velocities_of(coarse).second));
  std::vector<double> rebounds;
  double farthest = 0.0, drops[2] = {};
  plot::Plot shown = restitution_plot({0.2, 6.0});
  const Fit* const both[] = {&coarse, &fine};
  for (const int k : {0, 1}) {
    const std::vector<double> above = restitutions(*both[k], knee, true);
    for (const double e : above) farthest = std::max(farthest, std::abs(e / mean(above) - 1.0));
    drops[k] = mean(above) - mean(restitutions(*both[k], knee, false));
    for (const ImpactPoint& p : both[k]->data().points) rebounds.push_back(p.events - p.captured);
    const plot::Marker marker{k == 0 ? plot::orange : plot::blue,
                              k == 0 ? plot::Mark::open_square : plot::Mark::square};
    const CurveColumns columns = curve_columns(both[k]->a.uncertainty.curves.at(0));
    shown.layers.push_back(plot::Line{columns.velocity, columns.restitution, {marker.colour, 1.7}});
    shown.layers.push_back(points_of(*both[k], 0.0, marker, k == 0 ? "SST125" : "SST65"));
  }
  std::ranges::sort(rebounds);
  all.number("events", sorted_quantile(rebounds, 0.5));
  all.claim("flat", farthest < 0.2,
            say("all points above are within {} of their mean", whole_percent(farthest)));
  all.claim(
      "falls", drops[0] > 0.0 && drops[1] > 0.0,
      say("the mean below is lower by {:.3f} (SST65) and {:.3f} (SST125)", drops[1], drops[0]));
  all.claim("by-size", drops[1] > drops[0],
            say("it is lower by {:.3f} for SST65 and by {:.3f} for SST125", drops[1], drops[0]));
  PartResult& part = all.out.parts["fig-5"];
  part.gain = "capture velocities with intervals";
  part.words =
      say("The points stop above capture. The fit says where capture begins: at {} m/s for "
          "the mean sphere of SST65 and at {} m/s for that of SST125.",
          capture_words(fine), capture_words(coarse));
  part.blocks = {Figures{{figure("fig-5", "Restitution of both steels", std::move(shown),
                                 "Points: reconstruction ± 1 sd. Lines: the fit to all points, "
                                 "averaged over the rebounds that are seen.")}}};
}

void add_wall(Material& all) {
  const Fit& metal = all.fit("molybdenum");
  const FitResult& fitted = metal.a.fitted;
  double gaps[2] = {}, low = 1.0, points = 0.0;
  std::vector<double> measured, curve;
  for (const Observation& point : fitted.data.points) {
    if (std::abs(point.diameter / small_size - 1.0) > 1e-6) continue;
    const auto at = [&](const std::vector<double>& theta) {
      return predict(fitted.model, theta, 0, point.diameter, point.velocity, false).restitution();
    };
    measured.push_back(point.restitution);
    curve.push_back(at(metal.two_point().result.theta));
    gaps[0] += point.restitution - curve.back();
    gaps[1] += point.restitution - at(fitted.theta);
    low = std::min(low, point.restitution);
    points += 1.0;
  }
  all.claim("slightly-low", gaps[0] > 0.0 && gaps[0] / points < 0.05,
            say("by {:.3f} on average over {:.0f} points; by {:.4f} with all points",
                gaps[0] / points, points, gaps[1] / points));
  const auto highest = [](const std::vector<double>& e) {
    return std::ranges::max_element(e) - e.begin();
  };
  const auto apart = std::abs(highest(measured) - highest(curve));
  all.claim("same-trend", apart <= 2,
            say("both rise and fall, with their highest points {} of {} velocities apart", apart,
                measured.size()));
  const auto missed = [&](const char* key) {
    return all.fit(key).two_point().held_out_rmse.value();
  };
  all.claim("similar", std::max(missed("silicon"), missed("mica")) < 1.5 * missed("molybdenum"),
            say("rms of {e} at the other sizes: {:.3f} and {:.3f}, on molybdenum {:.3f}",
                missed("silicon"), missed("mica"), missed("molybdenum")));
  all.number("wall-fastest", velocities_of(metal).second);
  std::vector<Figure> figures;
  for (const std::string& key : targets) {
    figures.push_back(calibrations_figure(all.fit(key), "fig-7-" + key, {0.3, 130.0}));
  }
  PartResult& part = all.out.parts["fig-7"];
  part.gain = "one fit of all sizes, errors, capture velocities";
  const auto on_each = [&](const auto& words) {
    return joined(targets, ", ",
                  [&](const std::string& key) { return words(all.fit(key)) + " on " + key; });
  };
  part.words = say(
      "Two points of 4.9 {um} give no errors and leave the other 58 points unused. All "
      "points give {C_A} in s/m: {}; and {V*} of 4.9 {um} in m/s: {}.",
      on_each([](const Fit& fit) { return estimate_of(fit, fit.a.fitted.model.slot_C_A).words(); }),
      on_each([](const Fit& fit) { return capture_words(fit); }));
  part.blocks = {Figures{std::move(figures)}, calibration_table(metal),
                 calibration_table(all.fit("silicon")), calibration_table(all.fit("mica"))};
}

void add_quartz(Material& all) {
  const Fit& fit = all.fit("quartz");
  const auto [slow, fast] = velocities_of(fit);
  all.number("quartz-slowest", slow);
  all.number("quartz-fastest", fast);
  const RestitutionCurve& curve = fit.a.uncertainty.curves.at(0);
  const std::vector<double> below = log_spaced(slow, 15.0, 30);
  const std::vector<double> e =
      restitution_curve(fit.a.fitted.model, fit.a.fitted.theta, {0, curve.diameter}, below);
  all.claim("quartz-falls", std::ranges::is_sorted(e),
            say("the fitted curve falls steadily, from {:.3f} to {:.3f}", e.back(), e.front()));
  all.claim("agrees-well", fit.two_point().rmse < 0.02,
            say("rms of {e}: {:.4f} by two points, {:.4f} by all", fit.two_point().rmse,
                fit.a.fitted.rmse));
  PartResult& part = all.out.parts["fig-9"];
  part.gain = "errors, and a capture velocity below the points";
  part.words =
      say("The curves of two and of all points cannot be told apart. All points add the "
          "errors: {V*} = {} m/s, below the slowest point at {:.2g} m/s.",
          capture_words(fit), slow);
  part.blocks = {Figures{{calibrations_figure(fit, "fig-9", {0.7, 45.0})}}, calibration_table(fit)};
}

// ---- Fig. 6: forces ----------------------------------------------------------------------------

SimulatedImpact impact_under(const Fit& fit, const std::vector<double>& theta) {
  ImpactModel model = fit.a.fitted.model;
  for (std::size_t j = 0; j < model.slots.size(); ++j) model.slots[j].initial = theta.at(j);
  return simulate_at(model, fit.a.datasets, {0, middle_size, 5.2});
}

void add_forces(Material& all) {
  const Fit& fit = all.fit("molybdenum");
  const SimulatedImpact full = impact_under(fit, fit.a.fitted.theta);
  const SimulatedImpact two = impact_under(fit, fit.two_point().result.theta);
  // Shares of the incident energy, which is 1/2 [m V^2].
  const auto hertz = [](const SimulatedImpact& s) { return 2.0 * s.impact.energy.hertz_loss; };
  const auto adhesion = [](const SimulatedImpact& s) {
    return 2.0 * s.impact.energy.adhesion_loss;
  };
  all.claim("hertz-small", hertz(two) < 0.1,
            say("it takes {} of the incident energy by two points, {} by all",
                whole_percent(hertz(two)), whole_percent(hertz(full))));
  all.claim("mainly-adhesion", adhesion(two) > hertz(two),
            say("{} against {} of the incident energy by two points, {} against {} by all",
                whole_percent(adhesion(two)), whole_percent(hertz(two)),
                whole_percent(adhesion(full)), whole_percent(hertz(full))));
  const std::vector<HistoryColumn> columns = history_columns(full);
  const auto values = [&](std::string_view name) {
    return std::ranges::find_if(columns, [&](const auto& c) { return c.name == name; })->values;
  };
  double early = 0.0;
  for (const ImpactMoment& moment : full.history) {
    if (moment.approach > 0.0) early = std::max(early, std::abs(moment.adhesion_damping));
  }
  all.claim("rebound-only", early == 0.0,
            say("its force is {:.2g} while the sphere approaches", early));
  plot::Plot shown;
  shown.x = {"contact time", "ns"};
  shown.y = {"force", "µN"};
  shown.key = plot::KeyPlace::below;
  std::vector<double> forces;
  const struct {
    const char *column, *name;
    plot::Stroke stroke;
  } parts[] = {
      {"hertz_force_uN", "Hertz", {plot::blue, 2.0}},
      {"hertz_damping_force_uN", "Hertz dissipation", {plot::sky, 2.0, plot::dashes}},
      {"adhesion_force_uN", "adhesion", {plot::vermillion, 2.0, plot::long_dashes}},
      {"adhesion_damping_force_uN", "adhesion dissipation", {plot::purple, 2.0, plot::dash_dot}}};
  for (const auto& part : parts) {
    plot::Line line{values("time_ns"), values(part.column), part.stroke};
    line.name = part.name;
    forces.insert(forces.end(), line.y.begin(), line.y.end());
    shown.layers.push_back(std::move(line));
  }
  shown.x.set_range({0.0, values("time_ns").back()});
  shown.y.set_range(plot::range_of(forces, 0.05));
  PartResult& part = all.out.parts["fig-6"];
  part.gain = "forces and energies with the parameters of all points";
  part.words =
      say("4.9 {um} on molybdenum at 5.2 m/s, with the parameters of all points: {e} = {:.3f} "
          "({:.3f} by two points), contact for {:.1f} ns.",
          std::sqrt(full.restitution_squared), std::sqrt(two.restitution_squared),
          values("time_ns").back());
  part.blocks = {Figures{{figure("fig-6", "Contact force against time", std::move(shown),
                                 "Positive forces push the sphere away from the surface.", 375)}}};
}

// ---- Figs. 10 to 12: mixtures ------------------------------------------------------------------

/// V* of a sphere of SST65 with its standard error [m/s].
Number capture_of(const Fit& fit, double diameter) {
  const FitResult& fitted = fit.a.fitted;
  const CaptureVelocity found = capture_velocity(fitted.model, fitted.theta, 0, diameter);
  const std::size_t n = fitted.theta.size();
  double variance = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      variance += found.gradient[i] * fitted.covariance[i * n + j] * found.gradient[j];
    }
  }
  return {found.found ? found.value : std::nan(""), significant(3), std::sqrt(variance)};
}

/// V* of the largest sphere [m/s] if K is that of E and nu, f0 that of eq. 12, and C_A such that
/// the smallest has the printed 0.9 m/s.
double capture_with_stiffness_of_materials(const Fit& fit, double smallest, double largest) {
  Dataset data = fit.data();
  data.system.stiffness_K.reset();
  data.system.adhesion_force_f0.reset();
  const ImpactModel model = make_model(fit.a.spec, {data});
  std::vector<double> theta = model.initial();
  theta.at(model.slot_C_H.at(0)) = estimate_of(fit, fit.a.fitted.model.slot_C_H).value;
  const auto at = [&](double C_A, double diameter) {
    theta.at(model.slot_C_A.at(0)) = C_A;
    const CaptureVelocity found = capture_velocity(model, theta, 0, diameter);
    return found.found ? found.value : 10.0;  // it never rebounds
  };
  const double C_A = find_root([&](double c) { return at(c, smallest) - 0.9; }, 0.01, 2.0, 1e-6);
  return at(C_A, largest);
}

void add_single_sizes(Material& all, const PolydispersePrediction& mixture) {
  const Fit& fit = all.fit("sst65");
  const Number smallest = capture_of(fit, mixture.sizes.smallest);
  const Number largest = capture_of(fit, mixture.sizes.largest);
  all.number("capture-smallest", smallest.value);
  all.number("capture-largest", largest.value);
  const double slope = std::log(smallest.value / largest.value) /
                       std::log(mixture.sizes.smallest / mixture.sizes.largest);
  all.claim("capture-by-size", slope < 0.0, say("it falls as {d}") + exponent(digits(slope, 3)));
  plot::Plot shown = restitution_plot({0.07, 6.0});
  const std::string_view strokes[] = {plot::dots, "", plot::dashes};
  for (std::size_t k = 0; k < mixture.size_curves.size(); ++k) {
    const SizeCurve& curve = mixture.size_curves[k];
    plot::Line line{mixture.velocity, curve.restitution, {plot::marker(k).colour, 1.8, strokes[k]}};
    line.name = diameter_label(curve.diameter);
    shown.layers.push_back(std::move(line));
  }
  shown.layers.push_back(points_of(fit, 0.0, {plot::ink, plot::Mark::square}, "SST65"));
  PartResult& part = all.out.parts["fig-10"];
  part.gain = "errors of the capture velocities; which stiffness was simulated";
  part.words = say(
      "All points give {V*} = {} m/s at 20 {um} and {} m/s at 110 {um}, with the printed K and "
      "{f0}. With K of E and nu, the {C_A} that gives 0.9 m/s at 20 {um} gives {:.2g} m/s at 110 "
      "{um}. So the paper's curves probably have the printed K.",
      smallest, largest,
      capture_with_stiffness_of_materials(fit, mixture.sizes.smallest, mixture.sizes.largest));
  part.blocks = {
      Figures{{figure("fig-10", "Restitution of the smallest, mean and largest sphere",
                      std::move(shown), "Lines: the fit to all points, for one size each.", 375)}}};
}

/// The value at `velocity` [m/s] of a curve of the mixture.
template <class Value>
double interpolated(const std::vector<double>& at, double velocity, const Value& value) {
  const auto next = std::ranges::upper_bound(at, velocity);
  const auto k = static_cast<std::size_t>(next - at.begin());
  const double part = std::log(velocity / at.at(k - 1)) / std::log(at.at(k) / at.at(k - 1));
  return (1.0 - part) * value(k - 1) + part * value(k);
}

PolydispersePrediction add_mixture(Material& all, const std::string& key, const std::string& id,
                                   const std::string& place) {
  const Fit& fit = all.fit(key);
  const MeasuredSizes sizes = *sizes_of_dataset(fit.data().folder);
  const PolydispersePrediction mixture = predict_sizes(fit.a, sizes, std::nullopt, true, "");
  const PolydispersePrediction spread = predict_sizes(fit.a, sizes, std::nullopt, false, "");
  const ImpactPoint& slowest =
      std::ranges::min(fit.data().points, {}, &ImpactPoint::incident_velocity);
  const auto at_slowest = [&](const auto& value) {
    return interpolated(mixture.velocity, slowest.incident_velocity, value);
  };
  const auto average = [&](std::size_t convention) {
    return at_slowest(
        [&](std::size_t k) { return mixture.average[convention][k].value.value_or(NAN); });
  };
  const double single =
      at_slowest([&](std::size_t k) { return mixture.size_curves[1].restitution[k]; });
  const double captured = at_slowest([&](std::size_t k) { return *mixture.captured[k].value; });
  const double e = slowest.restitution, seen = average(2);
  all.claim(id, std::abs(seen - e) < std::abs(single - e),
            say("at {:.2f} m/s the point has {:.3f}, the average {:.3f} (unseen spheres left out), "
                "the mean size {:.3f}",
                slowest.incident_velocity, e, seen, single));
  Figure shown = mixture_figure(fit.a, mixture);
  shown.id = shown.picture.name = "picture-" + place;
  shown.caption =
      say("The average over {} sizes, at the middles of their bins, under three "
          "conventions. Unseen: rebounds below {:.2f} m/s, which do not reach the "
          "measuring plane.",
          mixture.simulated, mixture.slowest_seen);
  PartResult& part = all.out.parts[place];
  part.gain = "three ways to count captures; the fit averages over sizes";
  part.words = say(
      "At the slowest point {} are captured. The average is {:.3f} if they count as 0, {:.3f} if "
      "they are left out and {:.3f} if unseen rebounds are left out, too. With five sizes in each "
      "bin instead of its middle, the last is {:.3f}. Over all points the rms of {e} is {:.3f} for "
      "it and {:.3f} for the mean size, with the same parameters.",
      whole_percent(captured), average(0), average(1), seen,
      interpolated(spread.velocity, slowest.incident_velocity,
                   [&](std::size_t k) { return spread.average[2][k].value.value_or(NAN); }),
      spread.miss[2].rmse.value_or(NAN), mixture.miss_single.rmse.value_or(NAN));
  part.blocks = {Figures{{std::move(shown)}}};
  return mixture;
}

}  // namespace

Comparison compare_with_paper(const fs::path& root) {
  Material all{{{"molybdenum", "wall1990-molybdenum"},
                {"silicon", "wall1990-silicon"},
                {"mica", "wall1990-mica"},
                {"quartz", "dahneke1975-quartz"},
                {"sst65", "li1999-sst65-silicon"},
                {"sst125", "li1999-sst125-silicon"}},
               root,
               {}};
  for (Fit& fit : all.fits) {
    AnalysisOptions options;
    options.replicates = 0;
    fit.a = analyse(load_inputs(root / "fits" / (fit.file + ".toml")), options);
  }
  all.out.is_reconstruction = std::ranges::all_of(
      all.fits, [](const Fit& fit) { return fit.data().provenance == Provenance::reconstruction; });
  add_constants(all);
  add_sizes(all);
  add_velocities(all);
  add_steels(all);
  add_forces(all);
  add_wall(all);
  add_size_law(all);
  add_quartz(all);
  const PolydispersePrediction mixture = add_mixture(all, "sst65", "mixture-65", "fig-11");
  all.number("bins", static_cast<double>(mixture.sizes.bins.size()));
  add_single_sizes(all, mixture);
  add_mixture(all, "sst125", "mixture-125", "fig-12");
  return std::move(all.out);
}

}  // namespace recoil::paper
