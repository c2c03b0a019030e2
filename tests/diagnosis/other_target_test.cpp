#include "diagnosis/other_target.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/predicted_spread.hpp"
#include "diagnosis/target_experiments.hpp"
#include "search_with_exact_laws.hpp"

namespace recoil {
namespace {

const TargetMaterial& material(std::string_view name) {
  const auto& all = target_materials();
  return *std::find_if(all.begin(), all.end(),
                       [&](const TargetMaterial& one) { return one.name == name; });
}

/// (1 - nu^2) / E of both bodies, which K is inverse to.
double compliance_of(double modulus, double ratio) { return (1.0 - ratio * ratio) / modulus; }

TEST(OtherTarget, IsNoSofterThanTheSpheresAndChangesTheContact) {
  Dataset data = synthetic::dataset({});  // 1.2 GPa on 320 GPa
  const double sphere = compliance_of(1.2e9, 0.33);
  const double here = sphere + compliance_of(320e9, 0.31);
  for (const TargetMaterial& one : other_targets(data)) {
    const double stiffness = here / (sphere + compliance_of(one.youngs_modulus, one.poisson_ratio));
    const double energy = std::sqrt(one.youngs_modulus / 320e9);
    EXPECT_GE(one.youngs_modulus, 1.2e9) << one.name;
    EXPECT_TRUE(std::abs(std::log(stiffness)) > std::log(1.2) ||
                std::abs(std::log(energy)) > std::log(1.2))
        << one.name;
  }
  EXPECT_FALSE(other_targets(data).empty());
  // Where nothing adheres only K counts, and beside spheres so soft that is always theirs.
  data.system.adhesion_energy = 0.0;
  data.system.adhesion_force_f0 = 0.0;
  ASSERT_EQ(other_targets(data).size(), 1U);
  EXPECT_EQ(other_targets(data).front().name, "acrylic glass");
  data.system.particle.youngs_modulus = 5e9;
  EXPECT_TRUE(other_targets(data).empty());
}

TEST(OtherTarget, KeepsSpheresAndInstrumentAndScalesWhatIsStatedOfThePair) {
  Dataset data = synthetic::dataset({});
  data.system.method = Method::drop_heights;
  data.system.conditions.set(Condition::ambient_pressure, 2e4);
  data.system.conditions.set(Condition::target_thickness, 1e-3);
  const Dataset other = on_target(data, material("acrylic glass"));
  const double sphere = compliance_of(1.2e9, 0.33);
  const double stiffness =
      (sphere + compliance_of(320e9, 0.31)) / (sphere + compliance_of(3.1e9, 0.37));
  const double energy = std::sqrt(3.1e9 / 320e9);
  EXPECT_TRUE(other.points.empty());
  EXPECT_EQ(other.system.particle.name, "ammonium fluorescein");
  EXPECT_EQ(other.system.surface.name, "acrylic glass");
  EXPECT_EQ(other.system.method, Method::drop_heights);
  EXPECT_EQ(other.system.conditions.of(Condition::ambient_pressure), 2e4);
  EXPECT_GE(other.system.conditions.of(Condition::target_thickness).value_or(0.0), 0.01);
  EXPECT_LT(other.system.conditions.of(Condition::surface_rms_roughness).value_or(1.0), 2e-9);
  EXPECT_NEAR(*other.system.stiffness_K / (1.789e9 * stiffness), 1.0, 1e-9);
  EXPECT_NEAR(
      *other.system.adhesion_force_f0 / (8.9 * std::pow(energy, 2.0 / 3.0) * std::cbrt(stiffness)),
      1.0, 1e-9);
}

class OnAnotherTarget : public SearchWithExactLaws {
 protected:
  CandidateResult rival(const std::vector<std::string>& added, double value) const {
    CandidateResult rival;
    rival.candidate = make_candidate(spec_, data_, added);
    rival.refit.theta = rival.candidate.model.initial();
    for (std::size_t j = 0; j < 3; ++j) rival.refit.theta[j] = fitted_.theta[j];
    if (!added.empty()) rival.refit.theta.at(3) = value;
    return rival;
  }
};

// Where all is known but C_H, C_A and f0 of the new target, its readings vary together as these
// three make them. The slopes are differences of the other simulator.
TEST_F(OnAnotherTarget, NobodyKnowsWhatDampsAndHoldsTheSpheresThere) {
  const Dataset target = on_target(data_[0], material("acrylic glass"));
  const RivalElsewhere elsewhere(*base_, rival({}, 0.0), target, 0);
  PossibleImpacts possible;
  for (const double velocity : {6.0, 20.0, 80.0}) {
    possible.at.push_back({data_.size(), 4.9e-6, velocity});
    possible.sd.push_back(0.01);
  }
  const PredictedTogether found = elsewhere.predicted(possible);
  ASSERT_EQ(found.covariance.rows(), 3);

  RingAdhesionTruth truth = synthetic::truth_of({});
  truth.stiffness = *target.system.stiffness_K;
  truth.adhesion_force = *target.system.adhesion_force_f0;
  const double before[] = {3e-3, 0.03, truth.adhesion_force};
  const double sd[] = {3e-3, 0.03, log_sd_of_other_adhesion * truth.adhesion_force};
  Eigen::MatrixXd slopes(3, 3);
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double velocity = possible.at[static_cast<std::size_t>(i)].velocity;
    EXPECT_NEAR(found.restitution(i), true_restitution(truth, 4.9e-6, velocity), 2e-3);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const auto with = [&](double factor) {
        RingAdhesionTruth moved = truth;
        const double value = factor * before[k];
        (k == 0 ? moved.C_H : k == 1 ? moved.C_A : moved.adhesion_force) = value;
        return true_restitution(moved, 4.9e-6, velocity);
      };
      slopes(i, k) = (with(1.01) - with(0.99)) / (0.02 * before[k]) * sd[k] / 0.01;
    }
  }
  const Eigen::MatrixXd expected = slopes * slopes.transpose();
  EXPECT_LT((found.covariance - expected).norm(), 0.05 * expected.norm());
}

// What gas takes does not ask for the target; what yields does.
TEST_F(OnAnotherTarget, TellsCausesThatDependOnTheContactFromOthers) {
  const CandidateResult gas = rival({"gas_film"}, 2e4);
  const CandidateResult yield = rival({"plastic_yield"}, 1e8);
  const std::vector<NextExperiment> all = target_experiments(*base_, {&gas, &yield});
  ASSERT_EQ(all.size(), 1U);
  const NextExperiment& next = all.front();
  EXPECT_EQ(next.kind, ExperimentKind::target);
  EXPECT_FALSE(next.material.name.empty());
  EXPECT_GE(next.log_odds, std::log(99.0) * (1.0 - 1e-12));
  int events = 0;
  for (const ExperimentPlace& place : next.places) {
    events += place.events;
    EXPECT_EQ(place.events, next.places.front().events);
    EXPECT_LE(place.velocity, 90.0 * (1.0 + 1e-9));
    EXPECT_TRUE(place.diameter == 2.58e-6 || place.diameter == 4.9e-6);
  }
  EXPECT_EQ(events, next.events);
  EXPECT_EQ(next.places.size() % 6, 0U);
  EXPECT_TRUE(target_experiments(*base_, {&gas}).empty());
}

// The same prediction twice is told apart by nothing.
TEST_F(OnAnotherTarget, TellsNothingFromItself) {
  const CandidateResult gas = rival({"gas_film"}, 2e4);
  EXPECT_TRUE(target_experiments(*base_, {&gas, &gas}).empty());
}

}  // namespace
}  // namespace recoil
