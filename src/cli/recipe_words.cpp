#include "cli/recipe_words.hpp"

#include <fmt/format.h>

#include "core/units.hpp"
#include "reconstruction/recipe.hpp"

namespace recoil {
namespace {

std::string truth_words(const Truth& truth) {
  if (std::holds_alternative<RingAdhesionTruth>(truth)) return "the base model itself";
  const auto& at = std::get<ElastoplasticTruth>(truth);
  std::string words =
      fmt::format("plastic yield (yield pressure {:.3g} Pa", at.static_yield_pressure);
  words += at.rate_exponent > 0.0
               ? fmt::format(
                     ", rising with the rate of straining V^(3/5) / d to the power "
                     "{:.2g})",
                     5.0 / 3.0 * at.rate_exponent)
               : ")";
  if (at.adhesion_energy > 0.0)
    words += fmt::format(", JKR adhesion ({:.3g} J/m2)", at.adhesion_energy);
  if (at.hysteresis_factor > 0.0) {
    words += fmt::format(" and adhesion hysteresis ({:.3g} of that at 1 m/s", at.hysteresis_factor);
    words += at.hysteresis_exponent > 0.0
                 ? fmt::format(", rising with V to the power {:.2g})", at.hysteresis_exponent)
                 : ")";
  }
  return words + ", and none of the base model's damping";
}

std::string sizes_words(const SizeDistribution& sizes) {
  std::string words = fmt::format(
      "; spheres of many sizes ({:.3g} to {:.3g} um) are averaged in every point under one "
      "diameter, and only rebounds count",
      sizes.lower / units::um, sizes.upper / units::um);
  if (sizes.probe_height > 0.0) {
    words += fmt::format(" that are faster than {:.2g} m/s", sizes.slowest_seen());
  }
  return words;
}

}  // namespace

std::vector<std::string> recipe_remarks(const std::vector<Dataset>& datasets) {
  std::vector<std::string> remarks;
  for (const Dataset& dataset : datasets) {
    if (dataset.provenance != Provenance::reconstruction) continue;
    const Recipe recipe = load_recipe(dataset.folder);
    std::string made = truth_words(recipe.truth);
    if (recipe.sizes) made += sizes_words(*recipe.sizes);
    if (recipe.pairing) {
      made += "; its points come from simulated passages, paired by recoil pair";
    }
    remarks.push_back(fmt::format(
        "{} is a reconstruction, and its recipe made the points with {}. Whatever a diagnosis "
        "finds in them, the recipe put there: it shows that the method works, and says nothing "
        "about the experiment.",
        dataset.id, made));
  }
  return remarks;
}

}  // namespace recoil
