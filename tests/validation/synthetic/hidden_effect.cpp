#include "validation/synthetic/hidden_effect.hpp"

#include <cmath>
#include <stdexcept>

namespace recoil::hidden {
namespace {

using E = Effects;
using D = Design;
using enum EffectKind;

/// Sets one of the effects, or one of those in the contact, to its strength.
template <double E::*Member>
void sets(E& e, double s, const D&) {
  e.*Member = s;
}
template <double ContactExtras::*Member>
void sets_contact(E& e, double s, const D&) {
  e.contact.*Member = s;
}

/// Could these velocities be those of a fall from the height of a house?
bool are_dropped(const Design& design) { return design.rows.front().highest < 20.0; }

}  // namespace

const std::vector<HiddenEffect>& hidden_effects() {
  static const std::vector<HiddenEffect> all = {
      // Nothing yields below some 15 MPa, the softest organic solids.
      {"plastic_yield", physics, "GPa/p_Y", 60.0, 0.0,
       [](E& e, double s, const D&) { e.contact.yield_pressure = s > 0.0 ? 1e9 / s : 0.0; }},
      {"jkr_hysteresis", physics, "W_A", 3.0, 0.0,
       [](E& e, double s, const D& d) { e.jkr_work = s * d.base.adhesion_energy(); }},
      {"adhesion_hysteresis", physics, "W_A", 3.0, 0.0,
       [](E& e, double s, const D& d) {
         e.contact.hysteresis_energy = s * d.base.adhesion_energy();
       }},
      {"crack_rate", physics, "W_A", 15.0, 0.0,
       [](E& e, double s, const D& d) { e.contact.crack_energy = s * d.base.adhesion_energy(); }},
      {"bulk_viscoelastic", physics, "s", 3e-9, 0.0, sets_contact<&ContactExtras::bulk_relaxation>},
      {"elastic_waves", physics, "1", 3.0, 0.0, sets_contact<&ContactExtras::wave_radiation>},
      {"plate_flexure", physics, "s/kg", 1000.0, 0.0, sets_contact<&ContactExtras::plate_mobility>},
      {"gas_film", physics, "Pa", 1.05e5, 0.0, sets<&E::gas_pressure>},
      {"electrostatic_image", physics, "V/m", 3e6, 0.0, sets<&E::surface_field>},
      {"capillary", physics, "m", 2e-8, 0.0, sets<&E::bridge_length>},
      {"asperity_loss", physics, "J", 1e-11, 0.0, sets<&E::asperity_energy>},
      {"hysteretic_loss", physics, "1", 0.6, 0.0, sets_contact<&ContactExtras::hysteretic_share>},
      {"van_der_waals_approach", physics, "J", 5e-19, 0.0, sets<&E::hamaker_constant>},
      {"flight_drag", physics, "Pa", 1.05e5, 0.0,
       [](E& e, double s, const D& d) {
         e.flight_pressure = are_dropped(d) ? s : 0.0;
         e.flights_timed = reads_times(d.readout);
       }},
      // Points on a sphere are no further apart than its diameter: that of the smallest.
      {"height_origin", measurement, "diameters", 1.0, 1.0,
       [](E& e, double s, const D& d) { e.height_error = s * d.rows.front().diameter; }},
      {"probe_plane", measurement, "m", 5e-3, 2e-3, sets<&E::plane_height>},
      {"velocity_offset", measurement, "m/s", 0.1, 0.1, sets<&E::velocity_error>},
      {"size_calibration", measurement, "1", 0.15, 0.15, sets<&E::diameter_error>},
      {"polydispersity", measurement, "1", 0.4, 0.0, sets<&E::size_spread>},
      {"survivor_bias", measurement, "1", 0.5, 0.0, sets<&E::adhesion_spread>},
      {"rebound_truncation", measurement, "m/s", 0.5, 0.0, sets<&E::slowest_rebound>},
      {"outliers", measurement, "1", 0.2, 0.0, sets<&E::outlier_share>},
      {"series_offset", measurement, "1", 0.05, 0.0,
       [](E& e, double s, const D&) {
         for (double& offset : e.series_offset) offset *= s;
       }},
      {"dip", outside, "1", 1.0, 0.0, sets<&E::oddity_size>},
      {"kink", outside, "1", 0.5, 0.0, sets<&E::oddity_size>},
      {"wave", outside, "1", 0.5, 0.0, sets<&E::oddity_size>},
      {"velocities", careless, "1", 0.03, 0.0, sets<&E::velocity_scatter>},
      {"deviations", careless, "1", 0.5, 0.0, sets<&E::deviations_short>},
      {"settings", careless, "1", 0.04, 0.0, sets<&E::height_scatter>},
      {"odd_points", careless, "1", 0.06, 0.0, sets<&E::odd_share>},
  };
  return all;
}

const HiddenEffect& find_hidden_effect(std::string_view id) {
  for (const HiddenEffect& effect : hidden_effects()) {
    if (effect.id == id) return effect;
  }
  throw std::invalid_argument("no effect '" + std::string(id) + "'");
}

Nuisances draw_nuisances(const HiddenEffect& effect, const Design& design, std::uint64_t seed) {
  RandomStream random(seed, hidden_purpose, 1);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random.uniform();
  };
  Nuisances nuisances;
  if (random.uniform() < 0.5 && effect.most_negative > 0.0) nuisances.sign = -1.0;
  E& e = nuisances.background;
  // Every draw is made for every effect: what one draws does not move another.
  e.gas_distance = between(1e-5, 3e-5);
  e.contact.crack_exponent = between(0.4, 0.6);
  const double place = between(0.35, 0.65);
  const double width = between(0.0, 1.0);
  const double phase = random.uniform();
  for (std::size_t i = 0; i < design.rows.size(); ++i)
    nuisances.series_offset.push_back(random.normal());
  const double from = design.id == "li" ? 0.4 : design.id == "dahneke" ? 2.5 : 2.0;
  const double to = design.rows.front().highest;
  e.oddity_centre = from * std::pow(to / from, place);
  if (effect.id == "dip") {
    e.oddity = Oddity::dip;
    e.oddity_width = 0.2 + 0.2 * width;
  } else if (effect.id == "kink") {
    e.oddity = Oddity::kink;
  } else if (effect.id == "wave") {
    e.oddity = Oddity::wave;
    e.oddity_width = 0.8 + 0.7 * width;
    e.oddity_centre = from * std::exp(phase * e.oddity_width);
  }
  e.rebound_error_sign = random.uniform() < 0.5 ? -1.0 : 1.0;
  if (effect.id != "series_offset") nuisances.series_offset.clear();
  return nuisances;
}

void add_effect(Effects& effects, const HiddenEffect& effect, const Nuisances& nuisances,
                const Design& design, double strength) {
  if (effect.id == "gas_film") effects.gas_distance = nuisances.background.gas_distance;
  if (effect.id == "crack_rate") {
    effects.contact.crack_exponent = nuisances.background.contact.crack_exponent;
  }
  if (effect.id == "velocity_offset") {
    effects.rebound_error_sign = nuisances.background.rebound_error_sign;
  }
  if (effect.kind == outside) {
    effects.oddity = nuisances.background.oddity;
    effects.oddity_centre = nuisances.background.oddity_centre;
    effects.oddity_width = nuisances.background.oddity_width;
  }
  if (effect.id == "series_offset") effects.series_offset = nuisances.series_offset;
  effect.apply(effects, nuisances.sign * strength, design);
}

double largest_strength(const HiddenEffect& effect, const Nuisances& nuisances) {
  return nuisances.sign < 0.0 ? effect.most_negative : effect.largest;
}

}  // namespace recoil::hidden
