// Fits with mechanisms, from the text of a fit file to the answer, on data from formulas and
// integrators that the fitter does not use.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "data/dataset.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/fit.hpp"
#include "estimate/predictor.hpp"
#include "impact/impact.hpp"
#include "mechanism/mechanism.hpp"
#include "mechanism/survivors_mean.hpp"
#include "support/independent_impact.hpp"
#include "support/synthetic.hpp"
#include "validation/truth/elastoplastic_truth.hpp"

namespace recoil {
namespace {

FitSpec parsed(const std::string& mechanisms, const std::string& parameters) {
  return parse_fit(
      "dataset = \"d\"\n[model]\nmechanisms = [" + mechanisms + "]\n[parameters]\n" + parameters,
      "fits/fit.toml");
}

/// The design of `synthetic`, with e^2 from elsewhere.
template <class Square>
Dataset dataset_of(Square square, std::vector<double> diameters = {2.58e-6, 4.9e-6, 6.89e-6}) {
  synthetic::Design design;
  design.diameters = std::move(diameters);
  design.sd = 1e-4;  // the residual allows for a bias of sd^2
  Dataset data = synthetic::dataset(design);
  for (ImpactPoint& point : data.points) {
    const double x = square(point.series, point.diameter, point.incident_velocity);
    point.restitution = std::sqrt(std::max(0.0, x));
    point.captured = x > 0.0 ? 0 : 1;
  }
  return data;
}

double value_of_slot(const FitResult& result, const std::string& label) {
  for (std::size_t j = 0; j < result.theta.size(); ++j) {
    if (result.model.slots[j].label() == label) return result.theta[j];
  }
  ADD_FAILURE() << "no parameter " << label;
  return NAN;
}

double mass(double d) { return 1350.0 * std::numbers::pi / 6.0 * d * d * d; }

TEST(MechanismFit, FindsYieldPressureAndWorkOfAdhesion) {
  const std::vector<Dataset> datasets = {dataset_of([](std::size_t, double d, double v) {
    return elastoplastic_impact({0.75 * 1.789e9, 0.5 * d, mass(d), 0.2, 0.0, 1e8}, v)
        .restitution_squared;
  })};
  const FitSpec spec = parsed("\"plastic_yield\", \"jkr_hysteresis\"",
                              "C_H = { free = false, initial = 0 }\n"
                              "C_A = { free = false, initial = 0 }\n"
                              // (6 pi 0.2 J/m2)^(2/3) (1.789 GPa 2.45 um)^(1/3) / (2 pi)
                              "f0 = { free = false, initial = 6.309085 }\n");
  const FitResult result = fit(make_model(spec, datasets), gather(datasets));
  ASSERT_TRUE(result.usable) << result.failure;
  EXPECT_NEAR(value_of_slot(result, "yield_pressure"), 1e8, 1e4);
  // 0.2 J/m2 in units of W_A = 2 sqrt(E1 E2) (1.3e-10 m / pi)^2 / 2e-10 m = 0.33555 J/m2.
  EXPECT_NEAR(value_of_slot(result, "jkr_factor"), 0.2 / 0.33554639048, 3e-4);
  EXPECT_LT(result.chi2, 1e-3);
  for (const ParameterSlot& slot : result.model.slots) {
    if (slot.parameter->name == "jkr_factor") {
      EXPECT_EQ(slot.parameter->unit, "1");
    }
    if (slot.parameter->name == "yield_pressure") {
      EXPECT_TRUE(slot.log_scale);
    }
  }
}

TEST(MechanismFit, FindsTheRelaxationTimeOfTheBulk) {
  // The independent integrator with both damping terms and the dashpot.
  const double relaxation = 2e-10;
  const double f0 = 8.9;
  const std::vector<Dataset> datasets = {dataset_of([&](std::size_t, double d, double v) {
    const double A = std::sqrt(0.5 * d) * 1.789e9 / mass(d);
    const double scale = std::pow(v * v / A, 0.4);
    const double B =
        2.0 * std::numbers::pi * std::sqrt(0.5 * d) * f0 * std::cbrt(d / 4.9e-6) / mass(d);
    const independent::Groups<double> groups{2e-3 * v, B / (A * scale), 0.03 * v,
                                             1.5 * relaxation * v / scale, true};
    return independent::twice_energy_left(groups, false);
  })};
  const FitSpec spec = parsed("\"bulk_viscoelastic\"", "");
  const FitResult result = fit(make_model(spec, datasets), gather(datasets));
  ASSERT_TRUE(result.usable) << result.failure;
  EXPECT_NEAR(value_of_slot(result, "bulk_relaxation"), relaxation, 1e-3 * relaxation);
  EXPECT_NEAR(value_of_slot(result, "C_H"), 2e-3, 2e-6);
  EXPECT_NEAR(value_of_slot(result, "C_A"), 0.03, 3e-5);
}

TEST(MechanismFit, EverySeriesHasItsOwnOffset) {
  const std::vector<double> offsets = {0.03, -0.02, 0.01};
  Truth truth;
  truth.density = 1350.0;
  truth.stiffness = 1.789e9;
  truth.adhesion_force = 8.9;
  truth.reference_diameter = 4.9e-6;
  truth.C_H = 3e-3;
  truth.C_A = 0.02;
  const std::vector<Dataset> datasets = {dataset_of([&](std::size_t series, double d, double v) {
    return std::pow(true_restitution(truth, d, v) + offsets[series], 2);
  })};
  const FitSpec spec = parsed("\"series_offset\"", "C_H = { free = false, initial = 3e-3 }\n");
  const ImpactModel model = make_model(spec, datasets);
  ASSERT_EQ(model.slots.size(), 6U);
  const FitResult result = fit(model, gather(datasets));
  ASSERT_TRUE(result.usable) << result.failure;
  for (std::size_t s = 0; s < offsets.size(); ++s) {
    EXPECT_NEAR(value_of_slot(result, "series_offset[" + std::to_string(s) + "]"), offsets[s],
                2e-4);
  }
  // Elsewhere than in a series there is no offset.
  const Prediction anywhere = predict(model, result.theta, 0, 4.9e-6, 20.0, true);
  EXPECT_NEAR(anywhere.restitution(), true_restitution(truth, 4.9e-6, 20.0), 2e-4);
  EXPECT_EQ(anywhere.gradient[4], 0.0);
}

TEST(MechanismFit, NullValuesGiveTheBaseModel) {
  const std::vector<Dataset> datasets = {synthetic::dataset({})};
  const ImpactModel base = make_model(parsed("", ""), datasets);
  const ImpactModel extended = make_model(
      parsed("\"plastic_yield\", \"gas_film\", \"survivor_bias\", \"size_law\"", ""), datasets);
  const std::vector<double> theta = without_mechanisms(extended, extended.initial());
  for (const double v : {1.1, 2.0, 30.0}) {
    EXPECT_NEAR(predict(extended, theta, 0, 4.9e-6, v, false).restitution_squared,
                predict(base, base.initial(), 0, 4.9e-6, v, false).restitution_squared, 1e-10);
  }
  EXPECT_EQ(base.initial().size(), 3U);
}

// Every joule is found once.
TEST(WholeImpact, EnergyIsWhatPredictionsLeave) {
  const std::vector<Dataset> datasets = {synthetic::dataset({})};
  const ImpactModel model =
      make_model(parsed("\"plastic_yield\", \"gas_film\", \"hysteretic_loss\"", ""), datasets);
  std::vector<double> theta = model.initial();
  const auto set = [&](const char* name, double value) {
    for (std::size_t j = 0; j < theta.size(); ++j) {
      if (model.slots[j].parameter->name == name) theta[j] = value;
    }
  };
  set("gas_pressure", 1e5);
  set("measuring_distance", 1e-4);
  set("hysteretic_share", 0.1);
  const auto place = [&](const char* id) {
    std::size_t k = 0;
    while (model.chain.at(k)->info.id != id) ++k;
    return k;
  };
  const std::size_t film = place("gas_film"), hysteresis = place("hysteretic_loss");
  for (const double v : {4.0, 20.0}) {
    const PointConditions point = {0, 4.9e-6, v};
    const ContactView view = contact_view(model, theta, point);
    const ImpactResult impact = simulate_impact(view.groups, model.impact_options(false));
    const WholeImpactEnergy energy = whole_impact_energy(model, theta, point, impact);
    EXPECT_NEAR(energy.incident, 0.5 * mass(4.9e-6) * v * v, 1e-9 * energy.incident);
    EXPECT_NEAR(energy.rebound / energy.incident,
                predict(model, theta, 0, 4.9e-6, v, false).restitution_squared, 1e-6);
    double sum = energy.contact + energy.rebound;
    for (std::size_t k = 0; k < 3; ++k) sum += energy.in[k] + energy.out[k];
    EXPECT_NEAR(sum / energy.incident, 1.0, 1e-12);
    EXPECT_GT(energy.in[film], 0.0);  // it slows the sphere on both ways
    EXPECT_GT(energy.out[film], 0.0);
    EXPECT_EQ(energy.in[hysteresis], 0.0);
    EXPECT_GT(energy.out[hysteresis], 0.0);
  }
}

// Where the spheres of a point differ, contact and budget are those of the stated diameter, the
// mean. The sphere in the middle of a lognormal of s = 0.3 is 4 % smaller; that in the middle of
// these bins, at the geometric mean of 2.5 and 9.5 um, is 11 % smaller.
TEST(WholeImpact, IsThatOfTheMeanSphereWhereSpheresDiffer) {
  const std::vector<Dataset> datasets = {synthetic::dataset({})};
  const ImpactModel base = make_model(parsed("", ""), datasets);
  const ImpactModel spread = make_model(parsed("\"polydispersity\", \"survivor_bias\"",
                                               "size_spread = { initial = 0.3 }\n"
                                               "adhesion_spread = { initial = 0.3 }\n"),
                                        datasets);
  ImpactModel stated = spread;
  MeasuredSizes sizes;
  sizes.bins = {{3.5e-6, 0.15, 2e-6}, {5.25e-6, 0.7, 1.5e-6}, {8.5e-6, 0.15, 2e-6}};
  stated.surroundings[0].sizes = mixed_sizes_of(sizes);
  const PointConditions point = {0, 4.9e-6, 4.0};
  const double alone = predict(base, base.initial(), 0, 4.9e-6, 4.0, false).restitution_squared;
  for (const ImpactModel& model : {spread, stated}) {
    const std::vector<double> theta = model.initial();
    const ContactView view = contact_view(model, theta, point);
    EXPECT_DOUBLE_EQ(view.encounter.diameter, 4.9e-6);
    const ImpactResult impact = simulate_impact(view.groups, model.impact_options(false));
    const WholeImpactEnergy energy = whole_impact_energy(model, theta, point, impact);
    EXPECT_NEAR(energy.incident, 0.5 * mass(4.9e-6) * 16.0, 1e-9 * energy.incident);
    EXPECT_NEAR(energy.rebound / energy.incident, alone, 1e-6);
  }
}

TEST(MechanismCapture, FollowsTheExtendedModelAndForgetsTheMeasurement) {
  const std::vector<Dataset> datasets = {synthetic::dataset({})};
  // JKR alone on a conservative sphere: V_s = (2 * 7.0922 / m)^(1/2) (W^5 R^4 / E*^2)^(1/6).
  const FitSpec spec = parsed("\"jkr_hysteresis\", \"probe_plane\", \"velocity_offset\"",
                              "C_H = { free = false, initial = 0 }\n"
                              "C_A = { free = false, initial = 0 }\n"
                              "jkr_factor = { initial = 0.6 }\n"
                              "plane_height = { initial = 5e-3 }\n");
  const ImpactModel model = make_model(spec, datasets);
  const std::vector<double> theta = model.initial();
  const double d = 4.9e-6;
  const double E = 0.75 * 1.789e9;
  const double expected =
      std::sqrt(2.0 * 7.0922 / mass(d)) *
      std::pow(std::pow(0.6 * 0.33554639048, 5) * std::pow(0.5 * d, 4) / (E * E), 1.0 / 6.0);
  const CaptureVelocity found = capture_velocity(model, theta, 0, d);
  ASSERT_TRUE(found.found);
  EXPECT_NEAR(found.value, expected, 1e-6 * expected);
  for (std::size_t j = 0; j < theta.size(); ++j) {
    // d ln V* / d ln W = 5/6; the instrument's errors do not move it.
    const std::string_view name = model.slots[j].parameter->name;
    if (name == "jkr_factor") {
      EXPECT_NEAR(found.gradient[j] * 0.6 / expected, 5.0 / 6.0, 1e-6);
    }
    if (name == "plane_height" || name == "velocity_error") {
      EXPECT_EQ(found.gradient[j], 0.0);
    }
  }
  // Nothing sticks without a loss.
  std::vector<double> none = without_mechanisms(model, theta);
  const CaptureVelocity nowhere = capture_velocity(model, none, 0, d);
  EXPECT_TRUE(nowhere.found);
  EXPECT_EQ(nowhere.value, 0.0);
}

void expect_refused(const std::string& mechanisms, const std::string& parameters,
                    const std::vector<std::string>& parts) {
  try {
    parsed(mechanisms, parameters);
    ADD_FAILURE() << "accepted: " << mechanisms << " / " << parameters;
  } catch (const InputError& error) {
    for (const std::string& part : parts) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << part << " is not in: " << error.what();
    }
  }
}

TEST(MechanismSpec, MistakesNameTheNearestKnownWord) {
  expect_refused("\"plastic_yeild\"", "", {"fit.toml:3:15: ", "did you mean 'plastic_yield'?"});
  expect_refused("\"plastic_yield\", \"plastic_yield\"", "", {"fit.toml:3:32: ", "twice"});
  expect_refused("\"plastic_yield\"", "yield_presure = { initial = 1e8 }",
                 {"fit.toml:5:1: ", "did you mean 'yield_pressure'?"});
  expect_refused(
      "\"plastic_yield\"", "jkr_factor = { initial = 0.1 }",
      {"fit.toml:5:", "belongs to the mechanism 'jkr_hysteresis'", "\"jkr_hysteresis\""});
  expect_refused("\"plastic_yield\"", "yield_pressure = { initial = 10 }",
                 {"fit.toml:5:", "the formula of 'plastic_yield' holds from 100000 to 1e+12"});
  expect_refused("\"velocity_offset\"", "velocity_error = { bounds = [-20, 1] }",
                 {"fit.toml:5:", "'velocity_offset' holds from -10 to 10"});
  expect_refused("\"velocity_offset\"", "rebound_sign = { initial = -3 }",
                 {"fit.toml:5:", "'initial' of 'rebound_sign' is -3 (the"});
}

TEST(MechanismSpec, NegativeValuesAreFineWhereTheyMeanSomething) {
  const FitSpec spec =
      parsed("\"velocity_offset\"", "velocity_error = { initial = -0.01, bounds = [-0.1, 0.1] }");
  ASSERT_EQ(spec.parameters.size(), 5U);
  EXPECT_EQ(spec.parameters[3].parameter->name, "velocity_error");
  EXPECT_EQ(spec.parameters[3].initial, -0.01);
  EXPECT_EQ(spec.parameters[3].lower, -0.1);
  EXPECT_TRUE(spec.parameters[3].free);
}

TEST(MechanismSpec, ParametersMayBelongToEachDataset) {
  std::vector<Dataset> datasets = {synthetic::dataset({}), synthetic::dataset({})};
  datasets[1].id = "other";
  const ImpactModel model = make_model(
      parsed("\"jkr_hysteresis\", \"series_offset\"", "jkr_factor = { per = \"dataset\" }"),
      datasets);
  std::vector<std::string> labels;
  for (const ParameterSlot& slot : model.slots) labels.push_back(slot.label());
  const std::vector<std::string> expected = {
      "C_H", "C_A", "f0[synthetic]", "f0[other]", "jkr_factor[synthetic]", "jkr_factor[other]",
      "series_offset[synthetic/0]", "series_offset[synthetic/1]", "series_offset[other/0]",
      "series_offset[other/1]",
      // of the W_A that jkr_factor multiplies
      "particle.gilman_factor", "surface.gilman_factor"};
  EXPECT_EQ(labels, expected);
}

// Simulated spheres of many sizes, one by one, in every point (log-normal with 0.35; C_A + 2 C_H =
// 0.035 s/m): either the mechanism says how they differ, or the counts of captures do, not both.
TEST(MechanismFit, SizesInOnePointAreNotCountedTwice) {
  FitSpec spec = load_fit(RECOIL_SOURCE_DIR "/fits/li1999-sst65-silicon.toml");
  spec.mechanisms = {"polydispersity"};
  spec.parameters.push_back(default_of(find_mechanism("polydispersity")->info.parameters.front()));
  spec.parameters.back().initial = 0.2;
  const std::vector<Dataset> datasets = {load_dataset(spec.datasets.front())};
  const FitResult result = fit(make_model(spec, datasets), gather(datasets, spec.noise));
  ASSERT_TRUE(result.usable) << result.failure;
  EXPECT_EQ(result.weights.noise.event_spread, 0.0);
  EXPECT_NEAR(value_of_slot(result, "size_spread"), 0.35, 0.12);  // two standard errors
  // As C_H and C_A trade for one another, the sum is known best: to 0.0022 s/m by its error, 0.003
  // from one simulated stream to the next. On the average of eight (the recipe with other seeds) it
  // comes out at 0.0305: without the instrument's acceptance of 8 degrees 0.0314, and without that
  // and with the plane at 0.1 mm in the place of 1 mm, from where hardly a rebound is too slow to
  // be seen, 0.0336. So what low rebounds are missing for the plane counts twice as much as what
  // the angle cuts off, and the rest is within the error. This stream is a standard deviation
  // lower.
  EXPECT_NEAR(value_of_slot(result, "C_A") + 2.0 * value_of_slot(result, "C_H"), 0.0305, 0.006);
  EXPECT_LT(result.chi2, 22.4);  // 11 degrees of freedom: 2 % of correct models exceed it
  ASSERT_TRUE(result.unused_counts);
  EXPECT_EQ(result.unused_counts->mechanism->info.id, "polydispersity");
  EXPECT_GT(result.unused_counts->points, 0);
}

}  // namespace
}  // namespace recoil
