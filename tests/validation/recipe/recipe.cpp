#include "validation/recipe/recipe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/files.hpp"
#include "core/units.hpp"
#include "data/text.hpp"
#include "data/toml_reader.hpp"

namespace recoil {
namespace {

// ---- TOML --------------------------------------------------------------------------------------

/// Strict reading of structs with RECOIL_FIELDS from TOML: every key of a table is a member and
/// every member but an optional one or a map is there. A member `where` is given the table's place.
template <class Value>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               Value& value);

template <int lowest>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               AtLeast<lowest>& value) {
  const std::int64_t read = reader.integer(node, name);
  value.value = static_cast<int>(read);
  if (read >= lowest && read == value.value) return;
  reader.fail(node, fmt::format("{} = {}", name, read),
              fmt::format("it has to be a whole number, {} or more", lowest), "correct it");
}

template <class Value>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               std::vector<Value>& value) {
  for (const toml::node& item : reader.array(node, name, fmt::format("{} = [..]", name))) {
    read_toml(reader, item, fmt::format("{} number {}", name, value.size() + 1),
              value.emplace_back());
  }
}

template <class Value>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               std::map<std::string, Value>& value) {
  for (const auto& [key, item] : reader.table(node, name)) {
    read_toml(reader, item, std::string(key.str()), value[std::string(key.str())]);
  }
}

template <class Value>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               std::optional<Value>& value) {
  Value read{};
  read_toml(reader, node, name, read);
  value = std::move(read);
}

template <class Value>
void read_toml(const TomlReader& reader, const toml::node& node, const std::string& name,
               Value& value) {
  if constexpr (json_detail::HasFields<Value>) {
    const toml::table& table = reader.table(node, name);
    reader.allow_only(table, name, json_detail::keys_of<Value>());
    if constexpr (requires { value.where; }) value.where = reader.at(table.source());
    json_detail::for_each_field(value, [&](const std::string& key, auto& member) {
      if (const toml::node* own = table.get(key)) {
        read_toml(reader, *own, key, member);
      } else if (!json_detail::is_a<std::decay_t<decltype(member)>, std::optional> &&
                 !json_detail::is_named<std::decay_t<decltype(member)>>) {
        throw InputError(reader.at(table.source()),
                         fmt::format("the key '{}' is missing in {}", key, name), "", "add it");
      }
    });
  } else if constexpr (std::is_same_v<Value, std::string>) {
    value = reader.string(node, name, fmt::format("{} = \"...\"", name));
    if (value.empty()) reader.fail(node, fmt::format("'{}' is empty", name), "", "write a text");
  } else if constexpr (std::is_same_v<Value, double>) {
    value = reader.number(node, name);
  } else {
    value.value = reader.number(node, name);
    constexpr bool positive = std::is_same_v<Value, Positive>;
    if (positive ? value > 0.0 : value >= 0.0) return;
    reader.fail(node,
                fmt::format("{} = {:g}, but it {}", name, value.value,
                            positive ? "has to be positive" : "cannot be negative"),
                "", "see the units in the comments");
  }
}

// ---- tables of a recipe ------------------------------------------------------------------------

struct MaterialTable {
  std::string material;
  std::optional<Positive> density;
  Positive youngs_modulus;
  double poisson_ratio = 0.0;
  std::optional<Positive> surface_energy;
  Location where;
  RECOIL_FIELDS(material, density, youngs_modulus, poisson_ratio, surface_energy)
};

struct TruthTable {
  std::string model;
  std::optional<Positive> stiffness_K, adhesion_force_f0, C_A_exponent;
  Positive reference_diameter;
  NotNegative C_H, C_A;
  std::string adhesion_damping_phase;
  Location where;
  RECOIL_FIELDS(model, stiffness_K, adhesion_force_f0, C_A_exponent, reference_diameter, C_H, C_A,
                adhesion_damping_phase)
};

struct VelocityTable {
  Positive from, to;
  AtLeast<2> count;
  RECOIL_FIELDS(from, to, count)
};

struct SeriesTable {
  std::string name;
  Positive diameter;
  std::optional<VelocityTable> velocity;
  std::optional<std::vector<Positive>> drop_heights;
  Location where;
  RECOIL_FIELDS(name, diameter, velocity, drop_heights)
};

struct RecipeTable {
  AtLeast<0> seed;
  std::optional<std::vector<std::string>> assumptions, siblings;
  MaterialTable particle, surface;
  TruthTable truth;
  ImpactNoise noise;
  std::optional<SizeDistribution> sizes;
  std::optional<PassageDesign> passages;
  std::optional<PairingDesign> pairing;
  std::vector<SeriesTable> series;
  std::vector<FactSpec> fact;
  Location where;
  RECOIL_FIELDS(seed, assumptions, siblings, particle, surface, truth, noise, sizes, passages,
                pairing, series, fact)
};

void require(bool right, const Location& where, const std::string& problem, const std::string& why,
             const std::string& suggestion) {
  if (!right) throw InputError(where, problem, why, suggestion);
}

Material material_of(const MaterialTable& table, bool needs_density) {
  require(table.density || !needs_density, table.where, "the density is missing",
          "the sphere's mass follows from it", "add it [kg/m3]");
  require(table.poisson_ratio > -1.0 && table.poisson_ratio <= 0.5, table.where,
          fmt::format("poisson_ratio = {:g}", table.poisson_ratio),
          "an isotropic solid has -1 < nu <= 0.5", "correct it");
  return {table.material, table.density.value_or(0.0), table.youngs_modulus, table.poisson_ratio,
          table.surface_energy ? std::optional<double>(*table.surface_energy) : std::nullopt};
}

Truth truth_of(const TruthTable& table, const Recipe& recipe) {
  require(table.model == "ring-adhesion", table.where,
          fmt::format("unknown truth {}", quote(table.model)), "", "write \"ring-adhesion\"");
  const std::string& phase = table.adhesion_damping_phase;
  require(phase == "rebound" || phase == "both", table.where,
          fmt::format("unknown phase {}", quote(phase)),
          "adhesion is damped on rebound or in both phases", "write \"rebound\" or \"both\"");
  const DerivedContact derived = derive_recipe_contact(recipe.particle, recipe.surface);
  Truth truth;
  truth.density = recipe.particle.density;
  truth.stiffness = table.stiffness_K.value_or(derived.stiffness);
  truth.reference_diameter = table.reference_diameter;
  truth.adhesion_force = table.adhesion_force_f0.value_or(Positive{
      recipe_adhesion_force(truth.stiffness, derived.adhesion_energy, truth.reference_diameter)});
  truth.C_H = table.C_H;
  truth.C_A = table.C_A;
  truth.C_A_exponent = table.C_A_exponent.value_or(0.0);
  truth.damped_in_both_phases = phase == "both";
  return truth;
}

void add_weights(SizeDistribution& sizes) {
  const long first = std::lround(sizes.lower / units::um);
  const long last = std::lround(sizes.upper / units::um);
  require(first >= 1 && last > first && last <= 10000, sizes.where,
          "'lower' and 'upper' do not hold whole micrometres from 1 to 10000", "",
          "write both in metres, 'upper' above 'lower'");
  double total = 0.0;
  for (long d = first; d <= last; ++d) {
    const double diameter = static_cast<double>(d) * units::um;
    const double z = std::log(diameter / sizes.median) / sizes.log_sd;
    sizes.diameters.push_back(diameter);
    sizes.weights.push_back(std::exp(-0.5 * z * z) / diameter);
    total += sizes.weights.back();
  }
  for (double& weight : sizes.weights) weight /= total;
}

/// A value with three significant digits, as a table prints it.
double three_digits(double value) { return std::stod(fmt::format("{:.3g}", value)); }

RecipeSeries series_of(const SeriesTable& table) {
  require(table.name.find_first_of(",\"\n") == std::string::npos, table.where,
          fmt::format("the name {} has a comma, a quote or a line break", quote(table.name)),
          "it becomes a cell of points.csv", "choose another");
  require(table.velocity.has_value() != table.drop_heights.has_value(), table.where,
          fmt::format("{} 'velocity' and 'drop_heights' are given", table.velocity ? "both" : "no"),
          "the velocities come from one of the two",
          "give velocity = { from, to, count } or drop_heights = [..]");
  RecipeSeries series{table.name, table.diameter, {}};
  if (table.velocity) {
    const auto& [from, to, count] = *table.velocity;
    require(to > from, table.where, "'to' is not above 'from'", "", "swap them");
    for (int i = 0; i < count; ++i) {
      series.velocities.push_back(
          three_digits(from * std::pow(to / from, i / static_cast<double>(count - 1))));
    }
  } else {
    for (const double height : *table.drop_heights) {
      series.velocities.push_back(three_digits(std::sqrt(2.0 * standard_gravity * height)));
    }
    require(!series.velocities.empty(), table.where, "'drop_heights' is an empty list", "",
            "write [1, 2]");
  }
  return series;
}

void require_facts(const std::vector<FactSpec>& facts) {
  for (const FactSpec& fact : facts) {
    require_known_fact(fact);
    const auto same = [&](const FactSpec& other) { return other.id == fact.id; };
    require(std::count_if(facts.begin(), facts.end(), same) == 1, fact.where,
            fmt::format("the fact '{}' is given twice", fact.id),
            "each check has one set of limits", "remove one");
  }
}

void take(RecipeTable table, Recipe& recipe) {
  recipe.seed = static_cast<std::uint64_t>(int{table.seed});
  recipe.assumptions = table.assumptions.value_or(std::vector<std::string>{});
  recipe.siblings = table.siblings.value_or(std::vector<std::string>{});
  recipe.particle = material_of(table.particle, true);
  recipe.surface = material_of(table.surface, false);
  recipe.truth = truth_of(table.truth, recipe);
  recipe.noise = table.noise;
  require(recipe.noise.relative > 0.0 || recipe.noise.floor > 0.0, recipe.noise.where,
          "'relative' and 'floor' are both 0", "a point without noise has no standard deviation",
          "give one of them a value");
  require(recipe.noise.decimals <= 9, recipe.noise.where, "'decimals' is above 9",
          "at most 9 are printed", "write 3");
  recipe.sizes = std::move(table.sizes);
  if (recipe.sizes) add_weights(*recipe.sizes);
  recipe.passages = table.passages;
  require(!recipe.passages || recipe.passages->seen <= 1.0, table.where, "'seen' is above 1",
          "it is a share of all passages", "write at most 1");
  recipe.pairing = table.pairing;
  require(!recipe.pairing || (recipe.passages && recipe.sizes), table.where,
          "[pairing] without [passages] and [sizes]", "there is nothing to pair", "add them");
  for (const SeriesTable& series : table.series) recipe.series.push_back(series_of(series));
  require(!recipe.series.empty(), table.where, "there is no [[series]]", "there is nothing to make",
          "add one");
  recipe.facts = std::move(table.fact);
  require_facts(recipe.facts);
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
  RecipeTable table;
  read_toml(reader, reader.parse(text), "the recipe", table);
  take(std::move(table), recipe);
  recipe.plan = make_plan(recipe);
  return recipe;
}

}  // namespace recoil
