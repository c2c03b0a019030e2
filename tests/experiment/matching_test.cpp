#include <gtest/gtest.h>

#include <cmath>

#include "experiment/pair_search.hpp"

namespace {

using namespace recoil;

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs chosen(const std::vector<Link>& links, double price = 18.0) {
  Pairs pairs;
  for (const Link& link : match(links, 4, price).links) pairs.emplace_back(link.from, link.to);
  return pairs;
}

TEST(Matching, EachPassageOnce) {
  EXPECT_EQ(chosen({{0, 2, 1.0}, {0, 3, 2.0}, {1, 2, 0.5}, {1, 3, 9.0}}), (Pairs{{0, 3}, {1, 2}}));
}

TEST(Matching, AnExchangePairsBoth) {
  // By cost alone 0-2 goes first, and 1, which fits 2 only, stays alone.
  const std::vector<Link> links = {{0, 2, 1.0}, {0, 3, 4.0}, {1, 2, 2.0}};
  EXPECT_EQ(chosen(links), (Pairs{{0, 3}, {1, 2}}));
  // Not at any price: 4 + 2 - 1 = 5.
  EXPECT_EQ(chosen(links, 4.9), (Pairs{{0, 2}}));
}

TEST(Matching, NothingToChoose) { EXPECT_TRUE(match({}, 5, 18.0).links.empty()); }

TEST(Matching, ExchangedByHand) {
  // Chosen: 0-2 and 1-3 at cost 1 each; the exchange costs 2 more in all: 2 / (1 + e).
  std::vector<Link> links = {{0, 2, 1.0}, {1, 3, 1.0}, {0, 3, 2.0}, {1, 2, 2.0}};
  EXPECT_EQ(chosen(links), (Pairs{{0, 2}, {1, 3}}));
  EXPECT_NEAR(match(links, 4, 18.0).exchanged, 2.0 / (1.0 + std::exp(1.0)), 1e-15);
  links.pop_back();
  EXPECT_EQ(match(links, 4, 18.0).exchanged, 0.0);
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
