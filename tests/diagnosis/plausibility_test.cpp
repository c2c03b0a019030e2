#include <gtest/gtest.h>

#include "diagnosis/judge.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

/// The parameters of a mechanism at `value`, known to one part in a thousand. Spheres of 2.58 and
/// 4.9 um of ammonium fluorescein on molybdenum, 2.5 to 90 m/s.
std::vector<FoundParameter> found(const std::string& id, double value,
                                  double errors = allowed_errors) {
  const std::vector<Dataset> data = {synthetic::dataset({})};
  const Candidate candidate = make_candidate(synthetic::spec(), data, {id});
  Refit refit;
  refit.usable = true;
  refit.theta = candidate.model.initial();
  refit.theta[3] = value;
  const std::size_t p = refit.theta.size();
  refit.moving.assign(p, false);
  refit.moving[3] = true;
  refit.residuals.assign(4, 0.0);
  refit.jacobian.assign(4 * p, 0.0);
  for (std::size_t i = 0; i < 4; ++i) refit.jacobian[i * p + 3] = 500.0 / value;
  return found_parameters(candidate, refit, 1.0, errors);
}

TEST(Plausibility, RefusesAYieldPressureOfSteelInAPolymer) {
  const FoundParameter steel = found("plastic_yield", 3e9).front();
  EXPECT_FALSE(steel.plausible());
  EXPECT_NE(steel.limit, nullptr);
  EXPECT_NEAR(steel.quantity, 3e9 / (0.75 * 1.789e9), 1e-9);
  EXPECT_TRUE(found("plastic_yield", 2e8).front().plausible());
  EXPECT_FALSE(found("plastic_yield", 5e5).front().plausible());  // 4e-4 of E*
}

/// Peek's law around the larger sphere, 4.9 um, at 293 K and 1 atm: 27.2 kV/cm D (1 + 0.54 (cm / (D
/// r))^(1/2)), D = 298.15 / 293.
constexpr double kBreakdown = 9.7427094e+07;  // [V/m]

/// The largest field that is plausible on these spheres [V/m].
double largest_field(std::optional<double> pressure, double scale) {
  std::vector<Dataset> data = {synthetic::dataset({})};
  if (pressure) data[0].system.conditions.set(Condition::ambient_pressure, *pressure);
  for (ImpactPoint& point : data[0].points) point.diameter *= scale;
  data[0].system.reference_diameter = scale * 4.9e-6;
  const Candidate candidate = make_candidate(synthetic::spec(), data, {"electrostatic_image"});
  return allowed_values(candidate, candidate.model.initial(), 3).upper;
}

TEST(Plausibility, RefusesAChargeThatTheGasOrHandlingCannotLeave) {
  const FoundParameter charge = found("electrostatic_image", 1.6 * kBreakdown).front();
  EXPECT_FALSE(charge.plausible());
  EXPECT_NE(charge.limit, nullptr);
  EXPECT_NEAR(charge.quantity, 1.6, 1e-6);
  EXPECT_NEAR(charge.upper / kBreakdown, 1.0, 1e-6);
  EXPECT_TRUE(found("electrostatic_image", 5e7).front().plausible());
  EXPECT_NEAR(largest_field(101325.0, 1.0) / kBreakdown, 1.0, 1e-6);
  // In vacuum until electrons leave it.
  EXPECT_NEAR(largest_field(0.0, 1.0), 9e8, 1.0);
  // A ball of 40 mm holds 3.8e6 V/m in air, which are 75 kV; handling gives 35 kV.
  EXPECT_NEAR(largest_field({}, 40e-3 / 4.9e-6), 35e3 / 20e-3, 1.0);
}

TEST(Plausibility, KnowsOnePowerOfTheSize) {
  EXPECT_TRUE(found("size_law", 1.0 / 3.0).front().plausible());  // equation 12
  EXPECT_FALSE(found("size_law", 0.3).front().plausible());
  EXPECT_FALSE(found("size_law", 5.0 / 9.0).front().plausible());
}

TEST(Plausibility, AllowsTwoStandardErrors) {
  // The standard error is 0.1 % of the value.
  EXPECT_TRUE(found("electrostatic_image", 1.0017 * kBreakdown).front().plausible());
  EXPECT_FALSE(found("electrostatic_image", 1.007 * kBreakdown).front().plausible());
  const FoundParameter sharp = found("electrostatic_image", 1.0017 * kBreakdown, 0.0).front();
  EXPECT_FALSE(sharp.plausible());
  EXPECT_NEAR(sharp.sd, 1.0017e-3 * kBreakdown, 100.0);  // is told all the same
}

TEST(Plausibility, KnowsWhatLiesJustBeyond) {
  // half of the range beyond
  EXPECT_TRUE(found("electrostatic_image", 1.4 * kBreakdown).front().near_plausible);
  EXPECT_FALSE(found("electrostatic_image", 1.6 * kBreakdown).front().near_plausible);
  EXPECT_FALSE(
      found("plastic_yield", 3e9).front().near_plausible);  // no solid: that limit is sharp
}

TEST(Plausibility, ComparesARelaxationWithTheShortestContact) {
  // pi A over 2.943275 n_max / V of 2.58 um at 90 m/s: 1 at A = 3.389308e-09 s.
  EXPECT_TRUE(found("bulk_viscoelastic", 0.99 * 3.389308e-09).front().plausible());
  const FoundParameter liquid = found("bulk_viscoelastic", 1.01 * 3.389308e-09).front();
  EXPECT_NE(liquid.limit, nullptr);
  EXPECT_NEAR(liquid.quantity, 1.01, 1e-5);
}

TEST(Plausibility, ExpectsNoJumpOfAStiffContact) {
  // mu = (R W^2 / (E*^2 z0^3))^(1/3) = 13.3777 for W = W_A at 4.9 um: 1 at s = 0.0204374.
  EXPECT_TRUE(found("jkr_hysteresis", 1.01 * 0.0204374).front().plausible());
  const FoundParameter stiff = found("jkr_hysteresis", 0.125 * 0.0204374).front();
  EXPECT_NE(stiff.limit, nullptr);
  EXPECT_NEAR(stiff.quantity, 0.25, 1e-5);
  EXPECT_NEAR(stiff.lower, 0.0204374, 1e-5 * 0.0204374);
}

TEST(Plausibility, PairsStayWithinWhatTheirImpactsAllow) {
  std::vector<Dataset> data = {synthetic::dataset({})};
  const Candidate pair = make_candidate(synthetic::spec(), data,
                                        {"electrostatic_image", "jkr_hysteresis"}, false, true);
  for (const ParameterSlot& slot : pair.model.slots) {
    if (slot.parameter->name == "surface_field") {
      EXPECT_NEAR(slot.upper / kBreakdown, 1.2, 1e-6);
    }
    if (slot.parameter->name == "jkr_factor") {
      EXPECT_EQ(slot.lower, 0.0);  // the way to nothing stays open
    }
  }
}

TEST(Plausibility, StandardErrorsAreThoseOfTheJacobian) {
  Refit refit;
  refit.theta = {1.0, 2.0};
  refit.moving = {true, false};
  refit.jacobian = {3.0, 1.0, 4.0, 1.0};  // column 0: (3, 4), length 5
  const std::vector<double> errors = standard_errors(refit, 2.0);
  EXPECT_NEAR(errors[0], 2.0 / 5.0, 1e-15);
  EXPECT_EQ(errors[1], 0.0);
}

}  // namespace
}  // namespace recoil
