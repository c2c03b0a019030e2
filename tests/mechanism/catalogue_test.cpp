// What every mechanism owes: an entry that is complete, a null value that leaves the base model, an
// effect away from it, and derivatives that are those of its values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "estimate/fit_spec.hpp"
#include "mechanism/mechanism.hpp"
#include "one_point.hpp"

namespace recoil {
namespace {

using one_point::Answer;
using one_point::ask;
using one_point::Base;
using one_point::kBase;
using one_point::kDiameter;
using one_point::kSoft;

std::vector<double> values_of(const Mechanism& m, double Parameter::*which) {
  std::vector<double> values;
  for (const Parameter& p : m.info.parameters) values.push_back(p.*which);
  return values;
}

/// Values at which the mechanism is at work: its starts, and what starts at its null value moved.
std::vector<double> at_work(const Mechanism& m) {
  std::vector<double> values = values_of(m, &Parameter::initial);
  if (m.info.id == "series_offset") values = {0.03};
  if (m.info.id == "size_law") values = {0.5};
  if (m.info.id == "probe_plane") values = {2e-3};
  if (m.info.id == "rebound_truncation") values = {0.7, 0.1};
  if (m.info.id == "plastic_yield") values = {1.2e8, 0.1, 0.7, 0.3};
  if (m.info.id == "elastic_waves") values = {100.0};
  if (m.info.id == "plate_flexure") values = {1e4};
  if (m.info.id == "van_der_waals_approach") values = {1e-17};
  if (m.info.id == "height_origin") values = {5e-3, 0.3};
  if (m.info.id == "flight_drag") values = {0.1};
  if (m.info.id == "liquid_film") values = {2e-5, 1e-6, 1e-7};
  return values;
}

TEST(Catalogue, HoldsTheIdsThatPeopleScriptAgainst) {
  const std::set<std::string_view> expected = {
      "plastic_yield",   "jkr_hysteresis",         "adhesion_hysteresis", "crack_rate",
      "elastic_waves",   "bulk_viscoelastic",      "plate_flexure",       "gas_film",
      "capillary",       "electrostatic_image",    "asperity_loss",       "probe_plane",
      "velocity_offset", "size_calibration",       "polydispersity",      "survivor_bias",
      "outliers",        "rebound_truncation",     "series_offset",       "size_law",
      "hysteretic_loss", "van_der_waals_approach", "height_origin",       "flight_drag",
      "liquid_film"};
  std::set<std::string_view> found;
  for (const Mechanism& m : mechanism_catalogue()) found.insert(m.info.id);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(find_mechanism("size_law")->info.kind, MechanismKind::description);
  EXPECT_EQ(find_mechanism("survivor_bias")->info.kind, MechanismKind::measurement);
  EXPECT_EQ(find_mechanism("gas_film")->info.kind, MechanismKind::physics);
  EXPECT_EQ(find_mechanism("magic"), nullptr);
}

TEST(Catalogue, EntriesAreCompleteAndConsistent) {
  std::set<std::string_view> names;
  for (const Parameter& entry : base_parameters()) names.insert(entry.name);
  std::size_t directions = base_directions;
  for (const Mechanism& m : mechanism_catalogue()) {
    for (const std::string_view text :
         {m.info.title, m.info.formula, m.info.source, m.info.fingerprint}) {
      EXPECT_GT(text.size(), 7U) << m.info.id;
    }
    ASSERT_FALSE(m.info.parameters.empty()) << m.info.id;
    for (const Parameter& p : m.info.parameters) {
      EXPECT_TRUE(names.insert(p.name).second) << p.name << " is there twice";
      EXPECT_FALSE(p.unit.empty() || p.meaning.empty() || p.plausible.why.empty()) << p.name;
      EXPECT_EQ(p.limit.of == nullptr, p.limit.quantity.empty()) << p.name;
      EXPECT_EQ(p.limit.of == nullptr, p.limit.why.empty()) << p.name;
      EXPECT_LT(p.limit.lower, p.limit.upper) << p.name;
      EXPECT_LT(p.lower, p.upper) << p.name;
      std::vector<double> inside = p.starts;
      inside.insert(inside.end(), {p.initial, p.null_value, p.plausible.lower, p.plausible.upper});
      for (const double value : inside) {
        EXPECT_TRUE(value >= p.lower && value <= p.upper) << p.name << " " << value;
      }
      EXPECT_TRUE(!p.log_scale || p.lower > 0.0) << p.name;
      ++directions;
    }
  }
  EXPECT_LE(directions, ManyDirections().slope.size()) << "ManyDirections is too narrow";
}

TEST(Catalogue, TheChainDoesNotDependOnTheOrderInTheFile) {
  const auto one = chain_of({"jkr_hysteresis", "probe_plane", "size_law", "series_offset"});
  const auto other = chain_of({"series_offset", "size_law", "probe_plane", "jkr_hysteresis"});
  ASSERT_EQ(one, other);
  EXPECT_EQ(one.front()->info.id, "size_law");
  EXPECT_EQ(one.back()->info.id, "series_offset");
}

TEST(Catalogue, TwoDescriptionsOfOneLossAreNotCombined) {
  EXPECT_EQ(rival_among({"gas_film", "crack_rate"}, "adhesion_hysteresis")->info.id, "crack_rate");
  EXPECT_EQ(rival_among({"adhesion_hysteresis"}, "crack_rate")->info.id, "adhesion_hysteresis");
  EXPECT_EQ(rival_among({"gas_film", "adhesion_hysteresis"}, "capillary"), nullptr);
  try {
    parse_fit("dataset = \"x\"\n[model]\nmechanisms = [\"crack_rate\", \"adhesion_hysteresis\"]\n",
              "fit.toml");
    FAIL() << "the two were accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("crack_rate and adhesion_hysteresis together"),
              std::string::npos);
  }
}

class EveryMechanism : public testing::TestWithParam<std::string> {};

TEST_P(EveryMechanism, VanishesAtItsNullValue) {
  const Mechanism& m = *find_mechanism(GetParam());
  // A mechanism vanishes when the first of its parameters does, whatever the others are.
  std::vector<double> own = values_of(m, &Parameter::initial);
  own.front() = m.info.parameters.front().null_value;
  for (const double V : {0.4, 0.9, 1.27, 1.5, 6.0, 90.0}) {
    ImpactConditions c{2.58e-6, V, kSoft.density, kSoft.stiffness, 0.0, kBase.C_H, kBase.C_A};
    c.adhesion_force = kBase.f0 * std::cbrt(c.diameter / 4.9e-6);
    const double base = simulate_impact_fast(impact_groups(c), {}).restitution_squared;
    const Answer answer = ask(kSoft, {GetParam()}, own, c.diameter, V, kBase);
    ASSERT_TRUE(answer.usable);
    // To what the solver's step control makes of a last digit of the groups.
    EXPECT_NEAR(answer.square, base, 1e-10 * std::max(1.0, std::abs(base))) << V;
    for (const double slope : answer.slopes) EXPECT_TRUE(std::isfinite(slope)) << V;
  }
}

TEST_P(EveryMechanism, HasAnEffectAwayFromIt) {
  const Mechanism& m = *find_mechanism(GetParam());
  double largest = 0.0;
  for (const double V : {1.3, 1.5, 3.0, 6.0, 30.0}) {
    largest = std::max(largest,
                       std::abs(one_point::square(kSoft, {GetParam()}, at_work(m), 7e-6, V, kBase) -
                                one_point::square(kSoft, {}, {}, 7e-6, V, kBase)));
  }
  EXPECT_GT(largest, 1e-3);
}

TEST_P(EveryMechanism, DerivativesAreThoseOfItsValues) {
  const Mechanism& m = *find_mechanism(GetParam());
  const std::vector<double> own = at_work(m);
  // Well above capture, close to it, and below.
  for (const double V : {0.7, 1.45, 2.0, 40.0}) {
    const Answer answer = ask(kSoft, {GetParam()}, own, kDiameter, V, kBase);
    ASSERT_TRUE(answer.usable);
    ASSERT_EQ(answer.slopes.size(), 5 + own.size());
    for (std::size_t k = 0; k < answer.slopes.size(); ++k) {
      const auto moved = [&](double factor) {
        double v = V, d = kDiameter;
        Base base = kBase;
        std::vector<double> its = own;
        double* const at[] = {&v, &d, &base.C_H, &base.C_A, &base.f0};
        (k < 5 ? *at[k] : its[k - 5]) *= factor;
        return one_point::square(kSoft, {GetParam()}, its, d, v, base);
      };
      const double h = 2e-5;
      const double difference = (moved(1.0 + h) - moved(1.0 - h)) / (2.0 * h);
      const double values[] = {V, kDiameter, kBase.C_H, kBase.C_A, kBase.f0};
      const double slope = answer.slopes[k] * (k < 5 ? values[k] : own[k - 5]);
      EXPECT_NEAR(slope, difference, 2e-4 * std::abs(difference) + 2e-5) << "V " << V << " k " << k;
    }
  }
}

std::vector<std::string> all_ids() {
  std::vector<std::string> ids;
  for (const Mechanism& m : mechanism_catalogue()) ids.emplace_back(m.info.id);
  return ids;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryMechanism, testing::ValuesIn(all_ids()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace recoil
