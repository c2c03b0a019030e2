// The calibration on two points: its curve goes through them, whatever acts, and it finds the
// dampings of the simulator of the reconstructions, which shares no code with the fitter.
#include "estimate/two_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "estimate/predictor.hpp"
#include "mechanism/mechanism.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

using synthetic::Design;

TwoPointResult two_point_of(const Dataset& data) {
  const std::vector<Dataset> datasets = {data};
  const ImpactModel model = make_model(synthetic::spec(), datasets);
  return two_point(model, gather(datasets), 0, 4.9e-6);
}

TEST(TwoPoint, RecoversTheTruthFromTwoNoiselessPoints) {
  const Design design;
  const TwoPointResult result = two_point_of(synthetic::dataset(design));
  ASSERT_EQ(result.status, TwoPointStatus::converged);
  EXPECT_NEAR(result.theta[0] / design.C_H, 1.0, 1e-6);
  EXPECT_NEAR(result.theta[1] / design.C_A, 1.0, 1e-6);
  EXPECT_EQ(result.diameter, 4.9e-6);
  EXPECT_GT(result.iterations, 2);
}

TEST(TwoPoint, FindsTheSameFromNearby) {
  const std::vector<Dataset> datasets = {synthetic::dataset(Design{})};
  const ImpactModel model = make_model(synthetic::spec(), datasets);
  const Observations data = gather(datasets);
  const TwoPointResult far = two_point(model, data, 0, 4.9e-6);
  std::vector<double> near = far.theta;
  near[0] *= 1.2;
  near[1] *= 0.8;
  const TwoPointResult again = two_point(model, data, 0, 4.9e-6, near);
  ASSERT_EQ(again.status, TwoPointStatus::converged);
  EXPECT_EQ(again.iterations, 1);
  EXPECT_NEAR(again.theta[0] / far.theta[0], 1.0, 1e-7);
  EXPECT_NEAR(again.theta[1] / far.theta[1], 1.0, 1e-7);
}

TEST(TwoPoint, SaysWhenNoHertzDampingIsLeftOver) {
  Design design;
  design.diameters = {4.9e-6};
  Dataset data = synthetic::dataset(design);
  data.points.front().restitution = 0.45;  // strong adhesion damping at the lowest velocity ...
  data.points.back().restitution = 0.97;   // ... and hardly any loss at the highest
  const TwoPointResult result = two_point_of(data);
  EXPECT_EQ(result.status, TwoPointStatus::no_hertz_damping);
  EXPECT_EQ(result.theta[0], 0.0);
}

TEST(TwoPoint, SaysWhenNoAdhesionDampingFits) {
  Design design;
  design.diameters = {4.9e-6};
  Dataset data = synthetic::dataset(design);
  data.points.front().restitution = 0.999;
  const TwoPointResult result = two_point_of(data);
  EXPECT_EQ(result.status, TwoPointStatus::no_adhesion_damping);
  EXPECT_EQ(result.theta[1], 0.0);
}

TEST(TwoPoint, NeedsTwoVelocities) {
  Design design;
  design.velocities = {5.0};
  const TwoPointResult result = two_point_of(synthetic::dataset(design));
  EXPECT_EQ(result.status, TwoPointStatus::too_few_points);
  EXPECT_TRUE(result.theta.empty());
}

FitSpec spec_of(AdhesionLaw law, const std::string& mechanism = "") {
  return parse_fit("dataset = \"d\"\n[model]\nadhesion = \"" + to_string(law) +
                       "\"\nmechanisms = [" + (mechanism.empty() ? "" : '"' + mechanism + '"') +
                       "]\n",
                   "fits/fit.toml");
}

TEST(TwoPoint, IsOfThePapersModelWhateverMechanismTheFitHas) {
  const Design design;
  const std::vector<Dataset> datasets = {synthetic::dataset(design)};
  for (const char* mechanism : {"plastic_yield", "size_calibration", "bulk_viscoelastic"}) {
    const ImpactModel model = make_model(spec_of(AdhesionLaw::ring, mechanism), datasets);
    const TwoPointResult result = two_point(model, gather(datasets), 0, 4.9e-6);
    ASSERT_EQ(result.status, TwoPointStatus::converged) << mechanism;
    EXPECT_NEAR(result.theta[model.slot_C_H[0]] / design.C_H, 1.0, 1e-6) << mechanism;
    EXPECT_NEAR(result.theta[model.slot_C_A[0]] / design.C_A, 1.0, 1e-6) << mechanism;
  }
}

enum class Sizes { one, mixed, two_spheres };

/// Polystyrene on silicon at e that every law reaches with both dampings.
Dataset with_sizes(Sizes sizes) {
  Dataset data = synthetic::dataset({.diameters = {4.9e-6}, .velocities = {2.0, 54.0}});
  data.system.particle = {"polystyrene", 1050.0, 2.78e9, 0.33, std::nullopt};
  data.system.surface = {"silicon", 2330.0, 1.29e11, 0.28, std::nullopt};
  data.system.stiffness_K.reset();
  data.system.adhesion_force_f0.reset();
  data.points.front().restitution = 0.83;
  data.points.back().restitution = 0.62;
  if (sizes == Sizes::mixed) {
    data.mixed_sizes.emplace();
    data.mixed_sizes->bins = {{4.7e-6, 1.0, 2e-7}, {4.9e-6, 2.0, 2e-7}, {5.1e-6, 1.0, 2e-7}};
  }
  if (sizes == Sizes::two_spheres) {
    data.system.surface.density = 10220.0;
    data.system.surface_diameter = 2e-4;
  }
  return data;
}

class TwoPointCurve : public testing::TestWithParam<std::tuple<AdhesionLaw, Sizes, const char*>> {};
INSTANTIATE_TEST_SUITE_P(
    Laws, TwoPointCurve,
    testing::Combine(testing::Values(AdhesionLaw::ring, AdhesionLaw::jkr, AdhesionLaw::dmt,
                                     AdhesionLaw::maugis),
                     testing::Values(Sizes::one, Sizes::mixed, Sizes::two_spheres),
                     testing::Values("", "plastic_yield", "velocity_offset", "polydispersity")));

TEST_P(TwoPointCurve, GoesThroughItsPoints) {
  const auto& [law, sizes, mechanism] = GetParam();
  const FitSpec spec = spec_of(law, mechanism);
  const std::vector<Dataset> datasets = {with_sizes(sizes)};
  const ImpactModel model = make_model(spec, datasets);
  const Observations data = gather(datasets, spec);
  const TwoPointResult result = two_point(model, data, 0, 4.9e-6);
  ASSERT_EQ(result.status, TwoPointStatus::converged);
  for (const std::size_t i : {result.low_point, result.high_point}) {
    const Observation& point = data.points[i];
    const Prediction curve = predict(model, result.theta, 0, point.diameter, point.velocity, false);
    EXPECT_NEAR(curve.restitution(), point.restitution, 1e-6) << point.velocity;
  }
}

TEST(TwoPoint, GoesThroughTheSlowestAndFastestPointOfMixedSteelSpheres) {
  const FitSpec spec = load_fit(std::string(RECOIL_SOURCE_DIR) + "/fits/li1999-sst65-silicon.toml");
  const std::vector<Dataset> datasets = {load_dataset(spec.datasets.front())};
  const ImpactModel model = make_model(spec, datasets);
  const TwoPointResult result =
      two_point(model, gather(datasets, spec), 0, model.contacts[0].reference_diameter);
  ASSERT_EQ(result.status, TwoPointStatus::converged);
  // Copied from the dataset: velocity [m/s] and e.
  for (const auto& [velocity, e] : {std::pair{0.43983, 0.74624}, {4.4242, 0.94473}}) {
    EXPECT_NEAR(predict(model, result.theta, 0, 48.491e-6, velocity, false).restitution(), e, 1e-6);
  }
}

}  // namespace
}  // namespace recoil
