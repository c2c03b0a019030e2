#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/candidate.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

Observations points(int count, bool stated) {
  Observations data;
  data.noise.sd_stated = stated;
  data.points.resize(static_cast<std::size_t>(count));
  return data;
}

TEST(Criterion, IsWorkedByHand) {
  // 12 points, 3 parameters: 20 + 2 * 3 + 2 * 3 * 4 / 8.
  EXPECT_DOUBLE_EQ(corrected_criterion(points(12, true), 20.0, 3), 29.0);
  // The scale counts as a fourth: 12 ln(2) + 8 + 2 * 4 * 5 / 7.
  EXPECT_NEAR(corrected_criterion(points(12, false), 24.0, 3),
              12.0 * std::log(2.0) + 8.0 + 40.0 / 7.0, 1e-12);
}

TEST(Criterion, RefusesMoreParametersThanItCanCorrectFor) {
  EXPECT_EQ(corrected_criterion(points(5, true), 1.0, 4), INFINITY);
}

TEST(Candidate, CarriesFreeParametersOverAndLeavesFixedOnesAlone) {
  const std::vector<Dataset> data = {synthetic::dataset({})};
  const Candidate base = make_candidate(synthetic::spec(), data, {});
  const Candidate crack = make_candidate(synthetic::spec(), data, {"crack_rate"});
  const std::vector<double> theta =
      carried_over(base.model, std::vector<double>{0.007, 0.02, 5.0}, crack.model);
  // Last the errors of the two estimated surface energies, whose W_A crack_factor multiplies.
  ASSERT_EQ(theta.size(), 7U);
  ASSERT_EQ(crack.model.first_constant(), 5U);
  EXPECT_EQ(theta[0], 0.007);
  EXPECT_EQ(theta[1], 0.02);
  EXPECT_EQ(theta[2], 8.9);  // f0 is fixed in both
  EXPECT_EQ(crack.free_count, 3);
  EXPECT_EQ(make_candidate(synthetic::spec(), data, {"crack_rate"}, true).free_count, 4);
}

TEST(Candidate, TakesTheScatterOfSlowReboundsFromThePoints) {
  Dataset data = synthetic::dataset({});
  for (ImpactPoint& point : data.points) {
    point.events = 25;
    const double relative = point.restitution * point.incident_velocity < 3.0 ? 0.15 : 0.05;
    point.restitution_sd = relative * point.restitution / 5.0;
  }
  const auto scatter = [](const Dataset& points) {
    const Candidate candidate =
        make_candidate(synthetic::spec(), {points}, {"rebound_truncation"}, false, true);
    return candidate.spec.parameters.back().initial;
  };
  EXPECT_NEAR(scatter(data), 0.15, 1e-12);
  for (ImpactPoint& point : data.points) point.restitution_sd.reset();
  EXPECT_EQ(scatter(data), 0.1);  // what the catalogue assumes
}

TEST(Candidate, FindsTheParametersThatMadeThePoints) {
  synthetic::Design design;
  const std::vector<Dataset> data = {synthetic::dataset(design)};
  const Candidate base = make_candidate(synthetic::spec(), data, {});
  const Observations points = gather(data);
  const Refit refit =
      refit_candidate(base, points, first_weights(points), std::vector<double>{6e-3, 0.05, 8.9}, 2);
  ASSERT_TRUE(refit.usable);
  EXPECT_NEAR(refit.theta[0], design.C_H, 1e-5);
  EXPECT_NEAR(refit.theta[1], design.C_A, 1e-4);
  EXPECT_LT(refit.chi2, 1e-4);
}

TEST(RefitCandidate, MovesAConstantWhereThePointsKnowMoreOfItThanIsStated) {
  Dataset data = synthetic::dataset({});
  data.system.stiffness_K.reset();
  data.system.adhesion_force_f0.reset();
  data.system.particle.surface_energy = 0.05;
  data.system.surface.density = 10220.0;
  data.system.surface.surface_energy = 0.9;
  const FitSpec spec = synthetic::spec();
  for (const bool first_is_known : {true, false}) {
    const double known = 1e-6, unknown = 0.8;
    data.system.errors = {
        {Body::particle, Constant::youngs_modulus, 1.2e9 * (first_is_known ? known : unknown)},
        {Body::surface, Constant::surface_energy, 0.9 * (first_is_known ? unknown : known)}};
    const Candidate base = make_candidate(spec, {data}, {});
    ASSERT_EQ(base.model.constants.size(), 2U);
    const Observations points = gather({data}, spec.noise);
    const Refit refit =
        refit_candidate(base, points, first_weights(points), base.model.initial(), 1);
    ASSERT_TRUE(refit.usable);
    const std::size_t first = base.model.first_constant();
    EXPECT_EQ(refit.moving[first], !first_is_known);
    EXPECT_EQ(refit.moving[first + 1], first_is_known);
  }
}

}  // namespace
}  // namespace recoil
