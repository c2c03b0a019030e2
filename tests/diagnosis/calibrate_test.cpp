// The data sets by which a diagnosis is calibrated: how many, how exactly, and the gains by chance,
// found to first order, beside those of whole refits.
#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/trial.hpp"
#include "report/result_json.hpp"
#include "search_with_exact_laws.hpp"

namespace recoil {
namespace {

TEST_F(SearchWithExactLaws, RefitsOfSamplesAreWithinAThousandthOfTheErrors) {
  const double moving = static_cast<double>(base_->first.moving_slots().size());
  for (std::uint64_t b = 0; b < 40; ++b) {
    const std::vector<double> found = residuals_of_sample(*base_, b).value();
    const auto [sample, weights] = simulate_base(*base_, b);
    const Refit exact = refit_candidate(base_->candidate, sample, weights, base_->first.theta, 0);
    ASSERT_EQ(found.size(), exact.residuals.size());
    double apart = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      apart += std::pow(found[i] - exact.residuals[i], 2);
    }
    // An error of z standard errors in every parameter moves the residuals by z sqrt(parameters).
    EXPECT_LT(std::sqrt(apart), 1e-3 * std::sqrt(moving)) << b;
  }
}

Diagnosis diagnosed(double dip, int first_simulated) {
  Dataset data = synthetic::dataset({.velocities = {4.0, 6.5, 9.0, 12.0, 18.0, 25.0, 50.0, 90.0}});
  for (ImpactPoint& point : data.points) {
    const double away = std::log(point.incident_velocity / 18.0) / 0.4;
    point.restitution -= dip * std::exp(-0.5 * away * away);
  }
  DiagnosisOptions options;
  options.single_causes = true;
  options.first_simulated = first_simulated;
  return diagnose(synthetic::spec(), {data}, options);
}

TEST(Calibration, EndsEarlyOnlyWhereNothingIsHidden) {
  const Diagnosis nothing = diagnosed(0.0, 99);
  EXPECT_EQ(nothing.structure.simulated, 99);
  EXPECT_GT(nothing.structure.p_value, 0.2);
  EXPECT_EQ(nothing.verdict(), diagnosed(0.0, 399).verdict());
  const Diagnosis dip = diagnosed(0.12, 99);
  EXPECT_EQ(dip.structure.simulated, 399);
  EXPECT_LT(dip.structure.p_value, 0.05);
  EXPECT_TRUE(diagnosis_json(dip) == diagnosis_json(diagnosed(0.12, 399)));
}

TEST_F(SearchWithExactLaws, GainsByChanceAreThoseOfRefits) {
  const std::size_t n = base_->fitted.data.points.size();
  for (const char* id : {"velocity_offset", "hysteretic_loss"}) {
    Candidate candidate = make_candidate(spec_, data_, {id});
    const std::vector<double> near =
        carried_over(base_->candidate.model, base_->refit.theta, candidate.model);
    const std::vector<CandidateResult> one = {try_one(*base_, candidate, near, 4)};
    ASSERT_TRUE(one.front().refit.usable) << id;
    constexpr Eigen::Index replicates = 40;
    Eigen::MatrixXd residuals(static_cast<Eigen::Index>(n), replicates);
    std::vector<double> refitted;
    for (Eigen::Index b = 0; b < replicates; ++b) {
      const auto index = static_cast<std::uint64_t>(b);
      const std::vector<double> r = residuals_of_sample(*base_, index).value();
      residuals.col(b) = Eigen::Map<const Eigen::VectorXd>(r.data(), residuals.rows());
      const auto [sample, weights] = simulate_base(*base_, index);
      const Refit alone = refit_candidate(base_->candidate, sample, weights, base_->refit.theta, 0);
      const Refit with = refit_candidate(candidate, sample, weights, near, 4);
      refitted.push_back(corrected_criterion(sample, alone, base_->candidate.free_count) -
                         corrected_criterion(sample, with, candidate.free_count));
    }
    const Eigen::MatrixXd found = gains_by_chance(*base_, one, residuals);
    // A parameter that stays at nothing gains nothing, where to first order it would turn negative:
    // never less than a refit gains, but for the second order.
    int equal = 0;
    for (Eigen::Index b = 0; b < replicates; ++b) {
      const double whole = refitted[static_cast<std::size_t>(b)];
      EXPECT_GT(found(b, 0), whole - 0.5) << id << ", " << b;
      if (std::abs(found(b, 0) - whole) < 0.5) ++equal;
    }
    EXPECT_GE(equal, replicates / 3) << id;
  }
}

}  // namespace
}  // namespace recoil
