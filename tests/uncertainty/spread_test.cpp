// Replicates scatter as the linearised errors say, where the problem is nearly linear.
#include <gtest/gtest.h>

#include "support/noisy_case.hpp"

namespace recoil {
namespace {

using synthetic::Case;
using synthetic::noisy_case;
using synthetic::small;

TEST(Bootstrap, SpreadMatchesTheLinearisedError) {
  // 14 precise points: nearly linear, so the replicates scatter by the standard error.
  const Case c = noisy_case();
  UncertaintyOptions options = small(0);
  options.replicates = 299;
  const UncertaintyResult result = assess_uncertainty(c.fitted, c.datasets, options);
  EXPECT_EQ(result.bootstrap.failed, 0);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(result.two_point[0].full_spread[j] / c.fitted.std_error[j], 1.0, 0.12);
  }
}

}  // namespace
}  // namespace recoil
