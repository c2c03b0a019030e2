#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "validation/synthetic/design.hpp"

namespace recoil::hidden {

/// Careless: no effect on what happens, but errors that the table does not state.
enum class EffectKind { physics, measurement, outside, careless };

/// One effect with the one number that says how strong it is.
struct HiddenEffect {
  std::string_view id;  ///< that of the catalogue; outside effects have names of their own
  EffectKind kind = EffectKind::physics;
  std::string_view unit;
  double largest = 0.0;        ///< strength that nature or a careful experimenter still has
  double most_negative = 0.0;  ///< the same below zero; 0: one sign only
  void (*apply)(Effects&, double strength, const Design&) = nullptr;
};

/// All effects that can be hidden. Yielding is turned by 1 GPa / p_Y, all others by the parameter
/// itself (works of adhesion in units of W_A of the two bodies); that of series_offset is the
/// standard deviation between series.
const std::vector<HiddenEffect>& hidden_effects();

/// @throws std::invalid_argument when there is none
const HiddenEffect& find_hidden_effect(std::string_view id);

/// `base` effects plus what belongs to a draw and not to the strength: where a dip lies, which
/// series is off by how much, how far the measuring plane is away.
struct Nuisances {
  double sign = 1.0;
  Effects background;                 ///< strengths zero
  std::vector<double> series_offset;  ///< in standard deviations
};
Nuisances draw_nuisances(const HiddenEffect& effect, const Design& design, std::uint64_t seed);

/// Adds the effect at `strength` >= 0 to `effects`.
void add_effect(Effects& effects, const HiddenEffect& effect, const Nuisances& nuisances,
                const Design& design, double strength);

/// Largest strength for the sign that was drawn.
double largest_strength(const HiddenEffect& effect, const Nuisances& nuisances);

}  // namespace recoil::hidden
