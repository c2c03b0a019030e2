#include "validation/recipe/recipe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/files.hpp"
#include "core/units.hpp"
#include "data/text.hpp"
#include "validation/recipe/facts.hpp"
#include "validation/recipe/plan.hpp"
#include "validation/recipe/toml_table.hpp"

namespace recoil {
namespace {

Material read_material(TomlTable table, bool needs_density) {
  Material material;
  material.name = table.text("material");
  material.density =
      needs_density ? table.positive("density") : table.optional_positive("density").value_or(0.0);
  material.youngs_modulus = table.positive("youngs_modulus");
  material.poisson_ratio = table.number("poisson_ratio");
  if (!(material.poisson_ratio > -1.0 && material.poisson_ratio <= 0.5)) {
    table.fail("poisson_ratio", fmt::format("poisson_ratio = {:g}", material.poisson_ratio),
               "an isotropic solid has -1 < nu <= 0.5", "correct it");
  }
  material.surface_energy = table.optional_positive("surface_energy");
  table.finish();
  return material;
}

Truth read_ring_adhesion_truth(TomlTable& table, const Recipe& recipe) {
  const DerivedContact derived = derive_recipe_contact(recipe.particle, recipe.surface);
  RingAdhesionTruth truth;
  truth.density = recipe.particle.density;
  truth.stiffness = table.optional_positive("stiffness_K").value_or(derived.stiffness);
  truth.reference_diameter = table.positive("reference_diameter");
  truth.adhesion_force =
      table.optional_positive("adhesion_force_f0")
          .value_or(recipe_adhesion_force(truth.stiffness, derived.adhesion_energy,
                                          truth.reference_diameter));
  truth.C_H = table.not_negative("C_H");
  truth.C_A = table.not_negative("C_A");
  truth.C_A_exponent = table.optional_positive("C_A_exponent").value_or(0.0);
  const std::string phase = table.text("adhesion_damping_phase");
  if (phase != "rebound" && phase != "both") {
    table.fail("adhesion_damping_phase", fmt::format("unknown phase {}", quote(phase)),
               "adhesion is damped on rebound or in both phases", "write \"rebound\" or \"both\"");
  }
  truth.damped_in_both_phases = phase == "both";
  return truth;
}

Truth read_truth(TomlTable table, const Recipe& recipe) {
  const std::string model = table.text("model");
  if (model != "ring-adhesion") {
    table.fail("model", fmt::format("unknown truth {}", quote(model)), "",
               "write \"ring-adhesion\"");
  }
  Truth truth = read_ring_adhesion_truth(table, recipe);
  table.finish();
  return truth;
}

ImpactNoise read_noise(TomlTable table) {
  ImpactNoise noise;
  noise.relative = table.not_negative("relative");
  noise.floor = table.not_negative("floor");
  noise.events = static_cast<int>(table.whole("events", 1));
  noise.decimals = static_cast<int>(table.whole("decimals", 1));
  if (noise.relative == 0.0 && noise.floor == 0.0) {
    table.fail("relative", "'relative' and 'floor' are both 0",
               "a point without noise has no standard deviation", "give one of them a value");
  }
  if (noise.decimals > 9) {
    table.fail("decimals", fmt::format("decimals = {}", noise.decimals), "at most 9 are printed",
               "write 3");
  }
  table.finish();
  return noise;
}

SizeDistribution read_sizes(TomlTable table) {
  SizeDistribution sizes;
  sizes.lower = table.positive("lower");
  sizes.upper = table.positive("upper");
  sizes.median = table.positive("median");
  sizes.log_sd = table.positive("log_sd");
  sizes.probe_height = table.not_negative("probe_height");
  table.finish();
  const long first = std::lround(sizes.lower / units::um);
  const long last = std::lround(sizes.upper / units::um);
  if (first < 1 || last <= first || last > 10000) {
    table.fail("upper", "'lower' and 'upper' do not hold whole micrometres from 1 to 10000", "",
               "write both in metres, 'upper' above 'lower'");
  }
  double total = 0.0;
  for (long d = first; d <= last; ++d) {
    const double diameter = static_cast<double>(d) * units::um;
    const double z = std::log(diameter / sizes.median) / sizes.log_sd;
    sizes.diameters.push_back(diameter);
    sizes.weights.push_back(std::exp(-0.5 * z * z) / diameter);
    total += sizes.weights.back();
  }
  for (double& weight : sizes.weights) weight /= total;
  return sizes;
}

PassageDesign read_passages(TomlTable table) {
  PassageDesign design;
  design.rate = table.positive("rate");
  design.velocity_sd = table.not_negative("velocity_sd");
  design.diameter_sd = table.not_negative("diameter_sd");
  design.volume_sd = table.not_negative("volume_sd");
  design.angle_sd = table.not_negative("angle_sd");
  design.seen = table.positive("seen");
  design.return_time = table.positive("return_time");
  if (design.seen > 1.0) {
    table.fail("seen", fmt::format("seen = {:g}", design.seen), "it is a share of all passages",
               "write at most 1");
  }
  table.finish();
  return design;
}

PairingDesign read_pairing(TomlTable table) {
  PairingDesign design;
  design.height = table.positive("height");
  design.angle = table.positive("angle");
  design.per_bin = static_cast<int>(table.whole("per_bin", 2));
  table.finish();
  return design;
}

/// A value with three significant digits, as a table prints it.
double three_digits(double value) { return std::stod(fmt::format("{:.3g}", value)); }

std::vector<double> log_spaced(TomlTable table) {
  const double from = table.positive("from");
  const double to = table.positive("to");
  const auto count = table.whole("count", 2);
  table.finish();
  if (!(to > from)) table.fail("to", "'to' is not above 'from'", "", "swap them");
  std::vector<double> velocities;
  for (std::int64_t i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count - 1);
    velocities.push_back(three_digits(from * std::pow(to / from, part)));
  }
  return velocities;
}

RecipeSeries read_series(TomlTable table) {
  RecipeSeries series;
  series.name = table.text("name");
  series.diameter = table.positive("diameter");
  if (series.name.find_first_of(",\"\n") != std::string::npos) {
    table.fail("name",
               fmt::format("the name {} has a comma, a quote or a line break", quote(series.name)),
               "it becomes a cell of points.csv", "choose another");
  }
  const bool spaced = table.has("velocity");
  if (spaced == table.has("drop_heights")) {
    table.fail(spaced ? "drop_heights" : "velocity",
               spaced ? "both 'velocity' and 'drop_heights' are given"
                      : "neither 'velocity' nor 'drop_heights' is given",
               "the velocities come from one of the two",
               "give velocity = { from, to, count } or drop_heights = [..]");
  }
  if (spaced) {
    series.velocities = log_spaced(table.table("velocity"));
  } else {
    const std::vector<double> heights = *table.optional_positives("drop_heights");
    for (const double height : heights) {
      series.velocities.push_back(three_digits(std::sqrt(2.0 * standard_gravity * height)));
    }
  }
  table.finish();
  return series;
}

FactSpec read_fact(TomlTable table) {
  FactSpec fact;
  fact.id = table.text("id");
  fact.statement = table.text("statement");
  fact.source = table.text("source");
  fact.where = table.where("id");
  if (auto limits = table.optional_table("limits")) {
    for (const std::string& key : limits->keys()) fact.limits[key] = limits->number(key);
  }
  table.finish();
  require_known_fact(fact);
  return fact;
}

std::vector<FactSpec> read_facts(TomlTable& root) {
  std::vector<FactSpec> facts;
  for (TomlTable& table : root.tables("fact")) {
    facts.push_back(read_fact(std::move(table)));
    const FactSpec& fact = facts.back();
    const auto same = [&](const FactSpec& other) { return other.id == fact.id; };
    if (std::count_if(facts.begin(), facts.end(), same) > 1) {
      throw InputError(fact.where, fmt::format("the fact '{}' is given twice", fact.id),
                       "each check has one set of limits", "remove one");
    }
  }
  return facts;
}

void read_root(TomlTable& root, Recipe& recipe) {
  recipe.seed = static_cast<std::uint64_t>(root.whole("seed", 0));
  recipe.assumptions = root.optional_texts("assumptions").value_or(std::vector<std::string>{});
  recipe.siblings = root.optional_texts("siblings").value_or(std::vector<std::string>{});
  recipe.particle = read_material(root.table("particle"), true);
  recipe.surface = read_material(root.table("surface"), false);
  recipe.truth = read_truth(root.table("truth"), recipe);
  recipe.noise = read_noise(root.table("noise"));
  if (auto sizes = root.optional_table("sizes")) recipe.sizes = read_sizes(*sizes);
  if (auto passages = root.optional_table("passages")) recipe.passages = read_passages(*passages);
  if (auto pairing = root.optional_table("pairing")) {
    if (!recipe.passages || !recipe.sizes) {
      root.fail("pairing", "[pairing] without [passages] and [sizes]", "there is nothing to pair",
                "add them");
    }
    recipe.pairing = read_pairing(*pairing);
  }
  for (TomlTable& table : root.tables("series")) {
    recipe.series.push_back(read_series(std::move(table)));
  }
  if (recipe.series.empty()) {
    root.fail("series", "there is no [[series]]", "there is nothing to make", "add one");
  }
  recipe.facts = read_facts(root);
  root.finish();
}

}  // namespace

double SizeDistribution::mean() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < diameters.size(); ++i) sum += weights[i] * diameters[i];
  return sum;
}

double SizeDistribution::slowest_seen() const {
  return std::sqrt(2.0 * standard_gravity * probe_height);
}

Recipe load_recipe(const std::filesystem::path& folder, const std::string& name) {
  Recipe recipe;
  recipe.folder = folder;
  recipe.file = folder / name;
  // An absolute path has a last component also for "." and "dir/".
  recipe.id = (std::filesystem::absolute(folder) / "recipe.toml")
                  .lexically_normal()
                  .parent_path()
                  .filename()
                  .string();
  const std::string file = recipe.file.string();
  const std::string text = read_text_file(recipe.file, 1024 * 1024);
  const TomlReader reader(file);
  const toml::table parsed = reader.parse(text);
  TomlTable root(parsed, reader, "the recipe");
  read_root(root, recipe);
  recipe.plan = make_plan(recipe);
  return recipe;
}

}  // namespace recoil
