#include "experiment/matching.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "experiment/spread.hpp"

namespace {

using namespace recoil;

double total(const std::vector<Link>& links, const std::vector<std::size_t>& chosen) {
  double sum = 0.0;
  for (const std::size_t i : chosen) sum += links[i].cost;
  return sum;
}

TEST(Matching, EachPassageOnce) {
  const std::vector<Link> links = {{0, 2, 1.0}, {0, 3, 2.0}, {1, 2, 0.5}, {1, 3, 9.0}};
  const auto chosen = choose_links(links, 4, 18.0);
  EXPECT_EQ(chosen, (std::vector<std::size_t>{1, 2}));
}

TEST(Matching, AnExchangePairsBoth) {
  // By cost alone 0-2 goes first, and 1, which fits 2 only, stays alone.
  const std::vector<Link> links = {{0, 2, 1.0}, {0, 3, 4.0}, {1, 2, 2.0}};
  EXPECT_EQ(choose_links(links, 4, 18.0), (std::vector<std::size_t>{1, 2}));
  // Not at any price: 4 + 2 - 1 = 5.
  EXPECT_EQ(choose_links(links, 4, 4.9), (std::vector<std::size_t>{0}));
}

TEST(Matching, NothingToChoose) { EXPECT_TRUE(choose_links({}, 5, 18.0).empty()); }

TEST(Matching, ExchangedByHand) {
  // Chosen: 0-2 and 1-3 at cost 1 each; the exchange costs 2 more in all: 2 / (1 + e).
  const std::vector<Link> links = {{0, 2, 1.0}, {1, 3, 1.0}, {0, 3, 2.0}, {1, 2, 2.0}};
  const auto chosen = choose_links(links, 4, 18.0);
  EXPECT_DOUBLE_EQ(total(links, chosen), 2.0);
  EXPECT_NEAR(expected_exchanged(links, chosen, 4), 2.0 / (1.0 + std::exp(1.0)), 1e-15);
  const std::vector<Link> alone = {{0, 2, 1.0}, {1, 3, 1.0}, {0, 3, 2.0}};
  EXPECT_EQ(expected_exchanged(alone, choose_links(alone, 4, 18.0), 4), 0.0);
}

TEST(Spread, FollowsAVariable) {
  std::vector<double> x;
  std::vector<double> deviation;
  for (int i = 0; i < 1000; ++i) {
    x.push_back(i * 1e-3);
    deviation.push_back((i % 3 - 1) * (i < 500 ? 0.01 : 0.03));
  }
  const LocalSpread spread(x, deviation, 1e-3, 1.0);
  EXPECT_NEAR(spread.at(0.1), 0.01 * 1.4826, 1e-6);
  EXPECT_NEAR(spread.at(0.9), 0.03 * 1.4826, 1e-6);
  EXPECT_NEAR(spread.largest(), 0.03 * 1.4826, 1e-6);
  EXPECT_EQ(LocalSpread(x, deviation, 0.1, 1.0).at(0.5), 0.1);
}

}  // namespace
