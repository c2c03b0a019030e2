#include "validation/recipe/paired_points.hpp"

#include "experiment/pairing_files.hpp"
#include "validation/recipe/passages.hpp"

namespace recoil {

PassageTable recipe_passages(const Recipe& recipe, int times) {
  const PassageFormat format = {
      {{"time", "s"}, {"velocity", "m/s"}, {"tangential_velocity", "m/s"}, {"diameter", "um"}},
      {},
      false};
  return parse_passages(draw_passages(recipe, recipe.seed, times), "events.csv", "", format);
}

PairingOptions recipe_pairing(const Recipe& recipe) {
  PairingOptions options;
  options.height = recipe.pairing.value().height;
  options.angle = recipe.pairing.value().angle;
  return options;
}

AverageOptions recipe_averaging(const Recipe& recipe) {
  AverageOptions options;
  options.per_bin = static_cast<std::size_t>(recipe.pairing.value().per_bin);
  options.mean_diameter = true;
  return options;
}

PairedPoints pair_passages(const Recipe& recipe) {
  const PassageTable table = recipe_passages(recipe);
  const PairingResult pairs = pair_passages(table.passages, recipe_pairing(recipe));
  const Averages averages = average(table.passages, table.series, pairs, recipe_averaging(recipe));
  PairedPoints made;
  made.csv = points_csv(averages);
  for (const PointMean& point : averages.points) {
    made.points.push_back({0, point.diameter, point.velocity, point.restitution,
                           point.restitution_sd, static_cast<int>(point.rebounds)});
  }
  return made;
}

}  // namespace recoil
