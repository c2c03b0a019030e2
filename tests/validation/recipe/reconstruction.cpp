#include "validation/recipe/reconstruction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/files.hpp"
#include "experiment/pairing_files.hpp"
#include "validation/recipe/recipe.hpp"

namespace recoil {
namespace {

bool same(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b); }

void require_same_design(const Dataset& original, const std::vector<GeneratedPoint>& points,
                         const Recipe& recipe) {
  const Location where{(original.folder / "points.csv").string()};
  const std::string suggestion =
      fmt::format("run: ./run study reconstruct {}", recipe.folder.string());
  if (original.points.size() != points.size()) {
    throw InputError(where,
                     fmt::format("there are {} points, but the recipe makes {}",
                                 original.points.size(), points.size()),
                     "", suggestion);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ImpactPoint& there = original.points[i];
    if (same(there.diameter, points[i].diameter) &&
        same(there.incident_velocity, points[i].velocity)) {
      continue;
    }
    throw InputError({where.file, there.line, 0},
                     "this point's diameter or velocity is not that of the recipe", "", suggestion);
  }
}

/// A folder that is there but has no recipe is no reconstruction.
void require_recipe(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder) || std::filesystem::exists(folder / recipe_name)) {
    return;
  }
  const bool replaced = std::filesystem::exists(folder / set_aside_recipe_name);
  throw InputError(
      {folder.string()}, "this is not a reconstruction", fmt::format("it has no {}", recipe_name),
      replaced
          ? fmt::format("its points were replaced; the recipe of the earlier ones is kept in {}",
                        set_aside_recipe_name)
          : std::string("its points are not made by a recipe; name a folder that "
                        "has one"));
}

PairedPoints make_points(const Recipe& recipe) {
  if (recipe.pairing) return pair_passages(recipe);
  std::vector<GeneratedPoint> points = draw_points(recipe, recipe.seed);
  std::string csv = to_csv(recipe, points);
  return {std::move(csv), std::move(points)};
}

/// The first line that differs, for people.
std::string first_difference(const std::string& there, const std::string& made) {
  std::istringstream a(there);
  std::istringstream b(made);
  for (int line = 1;; ++line) {
    std::string left;
    std::string right;
    const bool more_left = static_cast<bool>(std::getline(a, left));
    const bool more_right = static_cast<bool>(std::getline(b, right));
    if (!more_left && !more_right) return "the line endings differ";
    if (left != right || more_left != more_right) {
      return fmt::format("line {}: the file has '{}', the recipe makes '{}'", line,
                         more_left ? left : "nothing", more_right ? right : "nothing");
    }
  }
}

}  // namespace

PairedPoints pair_passages(const Recipe& recipe) {
  PassageFormat format;
  format.units = {
      {"time", "s"}, {"velocity", "m/s"}, {"tangential_velocity", "m/s"}, {"diameter", "um"}};
  const PassageTable table =
      parse_passages(draw_passages(recipe, recipe.seed), "events.csv", "", format);
  const PairingDesign& design = recipe.pairing.value();
  PairingOptions options;
  options.height = design.height;
  options.angle = design.angle;
  AverageOptions by;
  by.per_bin = static_cast<std::size_t>(design.per_bin);
  by.mean_diameter = true;
  const Averages averages =
      average(table.passages, table.series, pair_passages(table.passages, options), by);
  PairedPoints made;
  made.csv = points_csv(averages);
  for (const PointMean& point : averages.points) {
    made.points.push_back({0, point.diameter, point.velocity, point.restitution,
                           point.restitution_sd, static_cast<int>(point.rebounds)});
  }
  return made;
}

Dataset regenerate(const Dataset& original, const Recipe& recipe, std::uint64_t seed) {
  const std::vector<GeneratedPoint> points = draw_points(recipe, seed);
  require_same_design(original, points, recipe);
  Dataset fresh = original;
  for (std::size_t i = 0; i < points.size(); ++i) {
    fresh.points[i].restitution = points[i].restitution;
    fresh.points[i].restitution_sd = points[i].restitution_sd;
    fresh.points[i].events = points[i].events;
    const bool back = points[i].restitution > 0.0;
    fresh.points[i].captured = back ? 0 : points[i].events;
    if (!back) fresh.points[i].restitution_sd.reset();
  }
  fresh.sha256 = sha256_hex(original.sha256 + to_csv(recipe, points));
  return fresh;
}

bool has_model_of_fit(const Recipe& recipe) {
  return recipe.truth.law == TrueAdhesion::ring && recipe.truth.C_A_exponent == 0.0;
}

bool ReconstructionResult::good() const {
  return identical &&
         std::all_of(facts.begin(), facts.end(), [](const FactCheck& f) { return f.holds; });
}

ReconstructionResult reconstruct(const std::filesystem::path& folder, bool check_only) {
  require_recipe(folder);
  if (!check_only) require_writable_folder(folder);
  const Recipe recipe = load_recipe(folder);
  const auto [made, points] = make_points(recipe);
  const std::filesystem::path file = folder / "points.csv";

  ReconstructionResult result;
  result.id = recipe.id;
  result.folder = folder;
  result.seed = recipe.seed;
  result.points = points.size();
  result.from_events = recipe.pairing.has_value();
  result.assumptions = recipe.assumptions;
  if (check_only) {
    const std::string there = read_text_file(file);
    result.identical = there == made;
    if (!result.identical) result.difference = first_difference(there, made);
  } else {
    write_whole_file(file, made, Replacing::data);
    result.written = true;
    result.identical = true;
  }
  result.facts = check_facts(recipe, points);
  return result;
}

}  // namespace recoil
