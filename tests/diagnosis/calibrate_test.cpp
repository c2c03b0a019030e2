// The gains by chance, found to first order, beside those of whole refits.
#include <gtest/gtest.h>

#include "diagnosis/trial.hpp"
#include "search_with_exact_laws.hpp"

namespace recoil {
namespace {

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
