#include "cli/event_points.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"
#include "experiment/pairing_files.hpp"
#include "reconstruction/passages.hpp"

namespace recoil {

EventTable recipe_events(const Recipe& recipe, int times) {
  const EventFormat format = {
      {{"time", "s"}, {"velocity", "m/s"}, {"tangential_velocity", "m/s"}, {"diameter", "um"}},
      {},
      false};
  return parse_events(draw_passages(recipe, recipe.seed, times), "events.csv", "", format);
}

PairOptions recipe_pairing(const Recipe& recipe) {
  PairOptions options;
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
  const EventTable table = recipe_events(recipe);
  const PairResult pairs = pair_events(table.events, recipe_pairing(recipe));
  const Averages averages = average(table.events, table.series, pairs, recipe_averaging(recipe));
  PairedPoints made;
  made.csv = points_csv(averages);
  for (const PointMean& point : averages.points) {
    made.points.push_back({0, point.diameter, point.velocity, point.restitution,
                           point.restitution_sd, static_cast<int>(point.rebounds)});
  }
  return made;
}

KnownEvents known_events(const Recipe& recipe, int times) {
  const std::map<std::string, double> truth = true_parameters(recipe);
  KnownEvents known;
  known.table = recipe_events(recipe, times);
  known.rebounds_per_velocity = static_cast<double>(times) * recipe.noise.events;
  known.velocities = recipe.series.front().velocities;
  known.diameter = recipe.series.front().diameter;
  known.C_H = truth.at("C_H");
  known.C_A = truth.at("C_A");
  known.capture_velocity = true_capture_velocity(recipe.truth, known.diameter);
  known.restitution = [law = recipe.truth](double diameter, double velocity) {
    return true_restitution(law, diameter, velocity);
  };
  return known;
}

std::vector<CorrectionStudy> study_recipe(const FitSpec& spec, const Recipe& recipe,
                                          const Dataset& like, int many_times,
                                          std::size_t many_classes) {
  if (!recipe.pairing || true_parameters(recipe).empty()) return {};
  const PairOptions pairing = recipe_pairing(recipe);
  AverageOptions averaging = recipe_averaging(recipe);
  std::vector<CorrectionStudy> studies;
  studies.push_back(study_corrections(spec, like, known_events(recipe, 1), pairing, averaging));
  averaging.per_bin *= static_cast<std::size_t>(many_times);
  averaging.per_bin /= many_classes;
  averaging.size_classes = many_classes;
  averaging.mean_diameter = false;
  studies.push_back(
      study_corrections(spec, like, known_events(recipe, many_times), pairing, averaging));
  return studies;
}

std::string pair_command_words(const Recipe& recipe) {
  const PairingDesign& pairing = recipe.pairing.value();
  return fmt::format(
      "  The same by hand, {0} being this folder:\n"
      "    recoil reconstruct {0} --passages events.csv\n"
      "    recoil pair events.csv --unit time=s,velocity=m/s,tangential_velocity=m/s,diameter=um "
      "\\\n"
      "        --height {1:g} --angle {2:.6g} --per-bin {3} --mean-diameter --out points.csv\n",
      recipe.id, pairing.height / units::mm, pairing.angle * 180.0 / M_PI, pairing.per_bin);
}

}  // namespace recoil
