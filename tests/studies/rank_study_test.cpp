// Simulation-based calibration of the posterior, and its bands.
#include "validation/studies/rank_study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace recoil {
namespace {

TEST(RankBand, RefusesOneInTwentyUniformSamples) {
  const RankBand band = rank_band(100);
  RandomStream random(3, RandomPurpose::coverage, 0);
  constexpr int samples = 1000;
  int refused = 0;
  for (int s = 0; s < samples; ++s) {
    std::vector<int> ranks;
    for (int i = 0; i < 100; ++i) ranks.push_back(static_cast<int>(random.below(rank_draws + 1)));
    refused += rank_p_value(ranks, band) <= 0.05 ? 1 : 0;
  }
  // 5 %, to four binomial standard deviations of both simulations: sqrt(0.05 0.95 (1/1000 +
  // 1/2000)).
  EXPECT_NEAR(refused / static_cast<double>(samples), 0.05, 4.0 * std::sqrt(0.0475 * 0.0015));
}

TEST(RankBand, SeesAPosteriorThatIsTooNarrowAndOneThatIsShifted) {
  // The truth and the posterior are normal; the posterior is half as wide, or half a deviation off:
  // the rank is 99 Phi(2 z) or 99 Phi(z + 1/2) for normal z.
  const RankBand band = rank_band(100);
  RandomStream random(4, RandomPurpose::coverage, 0);
  std::vector<int> narrow, shifted, right;
  for (int i = 0; i < 100; ++i) {
    const double z = random.normal();
    const auto rank = [](double x) {
      return static_cast<int>(std::lround(rank_draws * 0.5 * std::erfc(-x / std::sqrt(2.0))));
    };
    narrow.push_back(rank(2.0 * z));
    shifted.push_back(rank(z + 0.5));
    right.push_back(rank(z));
  }
  EXPECT_LT(rank_p_value(narrow, band), 0.01);
  EXPECT_LT(rank_p_value(shifted, band), 0.01);
  EXPECT_GT(rank_p_value(right, band), 0.01);
}

TEST(RankStudy, RanksAreUniformWithoutCaptures) {
  // With captures the ranks of C_A are not uniform: see reports/posterior-ranks.md.
  // 30 data sets of each arm: with eight parameters none has a p below 0.001 in 99 of 100 runs.
  const RankStudy study = study_ranks(30, 7, 0, "");
  ASSERT_EQ(study.rows.size(), 10U);
  const RankBand band = rank_band(30);
  for (const RankRow& row : study.rows) {
    EXPECT_EQ(row.unsettled, 0) << name_of(row.arm) << " " << row.parameter;
    if (row.arm == RankArm::captures) continue;
    EXPECT_GE(rank_p_value(row.ranks, band), 0.001) << name_of(row.arm) << " " << row.parameter;
  }
}

}  // namespace
}  // namespace recoil
