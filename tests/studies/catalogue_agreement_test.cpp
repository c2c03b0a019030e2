// Two descriptions of the same effect, written apart: the generator's and the catalogue's. On data
// without noise the fitter, given the right mechanism, must leave little of the misfit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "analysis/analysis.hpp"
#include "core/files.hpp"
#include "estimate/law_average.hpp"
#include "mechanism/mechanism.hpp"
#include "validation/synthetic/case.hpp"
#include "validation/synthetic/hidden_effect.hpp"

namespace {

using namespace recoil::hidden;
namespace fs = std::filesystem;

struct Pairing {
  const char* effect;
  const char* design;
  std::uint64_t index;
  double signal_to_noise;
  const char* parameter;  ///< of the catalogue
  double factor;          ///< parameter = factor * strength, or factor / strength when inverse
  bool inverse;
  double value_within;       ///< relative
  double misfit_within;      ///< of the misfit that the effect left in the base model
  const char* variant = "";  ///< of the law, as a line under [parameters]
};

void PrintTo(const Pairing& pairing, std::ostream* out) {
  *out << pairing.design << " " << pairing.effect;
}

class Agreement : public testing::TestWithParam<Pairing> {};

TEST_P(Agreement, TheCatalogueTakesTheEffectUp) {
  const Pairing& p = GetParam();
  Case made = make_case({p.design, {p.effect}, p.signal_to_noise, p.index});
  ASSERT_TRUE(made.reached) << "largest misfit " << made.refit.signal_to_noise;
  for (std::size_t i = 0; i < made.points.size(); ++i) {
    made.readings[i] = made.points[i].restitution;
  }
  made.design.decimals = 6;
  const ScratchFolder scratch;
  const fs::path fit = write_case(made, scratch.path());
  std::string text = recoil::read_text_file(fit);
  const std::string model = "[model]\n";
  text.insert(text.find(model) + model.size(),
              "mechanisms = [\"" + std::string(p.effect) + "\"]\n");
  const std::string parameters = "[parameters]\n";
  text.insert(text.find(parameters) + parameters.size(), p.variant);
  recoil::write_whole_file(fit, text, recoil::Replacing::data);
  const recoil::FitInputs inputs = recoil::load_inputs(fit);
  const recoil::FitResult fitted =
      recoil::fit_as_stated(inputs.spec, recoil::make_model(inputs.spec, inputs.datasets),
                            recoil::gather(inputs.datasets, inputs.spec));
  ASSERT_TRUE(fitted.usable) << fitted.failure;
  const double left = std::sqrt(fitted.chi2);
  EXPECT_LT(left, p.misfit_within * made.refit.signal_to_noise);
  const double strength = made.strengths.front();
  const double expected = p.inverse ? p.factor / strength : p.factor * strength;
  const auto& slots = fitted.model.slots;
  const auto slot = std::ranges::find(slots, p.parameter, &recoil::ParameterSlot::label);
  ASSERT_NE(slot, slots.end());
  const double value = fitted.theta[static_cast<std::size_t>(slot - slots.begin())];
  EXPECT_NEAR(value / expected, 1.0, p.value_within) << value << " for " << expected;
}

// Velocities are printed with three digits, which alone leaves a misfit of 0.3 or so. The catalogue
// leaves out that adhesion bends a thin plate too, and does not know how far the measuring plane is
// away: a parameter may be off by the factor given here while the shape of the effect is taken up.
// rebound_truncation in the design `wall` is missing: one or two points of the largest spheres
// carry all of it, and there the readings scatter by more than the tenth that the catalogue
// assumes. The exponent of the crack is fixed at 0.5 and the hidden one is between 0.4 and 0.6.
INSTANTIATE_TEST_SUITE_P(
    Catalogue, Agreement,
    testing::Values(
        Pairing{"plastic_yield", "wall", 0, 10.0, "yield_pressure", 1e9, true, 0.02, 0.1},
        Pairing{"plastic_yield", "li", 0, 10.0, "yield_pressure", 1e9, true, 0.02, 0.1},
        Pairing{"jkr_hysteresis", "wall", 0, 10.0, "jkr_factor", 1.0, false, 0.05, 0.1},
        Pairing{"adhesion_hysteresis", "wall", 0, 10.0, "hysteresis_factor", 1.0, false, 0.05, 0.1},
        Pairing{"adhesion_hysteresis", "li", 0, 10.0, "hysteresis_factor", 1.0, false, 0.05, 0.1},
        Pairing{"crack_rate", "wall", 0, 10.0, "crack_factor", 1.0, false, 0.2, 0.1},
        Pairing{"crack_rate", "li", 0, 10.0, "crack_factor", 1.0, false, 0.2, 0.1},
        Pairing{"bulk_viscoelastic", "li", 0, 10.0, "bulk_relaxation", 1.0, false, 0.05, 0.1},
        Pairing{"plate_flexure", "li", 0, 10.0, "plate_mobility", 1.0, false, 0.6, 0.2},
        Pairing{"gas_film", "wall", 0, 10.0, "gas_pressure", 1.0, false, 0.25, 0.2},
        Pairing{"capillary", "wall", 0, 10.0, "bridge_length", 1.0, false, 0.05, 0.1},
        Pairing{"asperity_loss", "wall", 0, 10.0, "asperity_energy", 1.0, false, 0.05, 0.1},
        Pairing{"hysteretic_loss", "wall", 0, 10.0, "hysteretic_share", 1.0, false, 0.1, 0.2},
        Pairing{"hysteretic_loss", "li", 0, 10.0, "hysteretic_share", 1.0, false, 0.1, 0.2},
        Pairing{"flight_drag", "li", 0, 10.0, "flight_pressure", 1.0, false, 0.2, 0.2},
        // Errors of no more than one diameter leave a misfit of 2.4 here.
        Pairing{"height_origin", "li", 0, 2.0, "height_error", 30e-6, false, 0.1, 0.3},
        Pairing{"velocity_offset", "wall-batches", 4, 10.0, "velocity_error", 1.0, false, 0.05,
                0.1},
        Pairing{"velocity_offset", "li", 0, 10.0, "velocity_error", 1.0, false, 0.05, 0.1,
                "rebound_sign = { initial = -1 }\n"},
        Pairing{"size_calibration", "wall", 0, 10.0, "diameter_error", 1.0, false, 0.05, 0.1},
        Pairing{"survivor_bias", "wall", 0, 10.0, "adhesion_spread", 1.0, false, 0.1, 0.2},
        Pairing{"rebound_truncation", "li", 0, 10.0, "slowest_rebound", 1.0, false, 0.1, 0.2},
        Pairing{"outliers", "li", 0, 10.0, "outlier_share", 1.0, false, 0.05, 0.1}));

TEST(Limits, WhatTheStudyHidesIsPossibleToTheCatalogue) {
  int compared = 0;
  for (const HiddenEffect& effect : hidden_effects()) {
    const recoil::Mechanism* const known = recoil::find_mechanism(effect.id);
    if (known == nullptr) continue;
    const recoil::Parameter& strength = known->info.parameters.front();
    if (strength.unit != effect.unit) continue;
    EXPECT_LE(effect.largest, strength.plausible.upper) << effect.id;
    EXPECT_GE(-effect.most_negative, strength.plausible.lower) << effect.id;
    ++compared;
  }
  EXPECT_GE(compared, 12);
}

}  // namespace
