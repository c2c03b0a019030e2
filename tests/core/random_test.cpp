#include "core/random.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace recoil {
namespace {

using Block = std::array<std::uint64_t, 4>;
using Key = std::array<std::uint64_t, 2>;

__extension__ using Wide = unsigned __int128;

/// Philox4x64-10 written out from Salmon et al. (2011), SC'11, section 3.3 and table 2: the
/// yardstick for the library that the streams use.
Block philox4x64_10(Block counter, Key key) {
  constexpr std::uint64_t multiplier_0 = 0xD2E7470EE14C6C93;
  constexpr std::uint64_t multiplier_1 = 0xCA5A826395121157;
  constexpr std::uint64_t weyl_0 = 0x9E3779B97F4A7C15;  // golden ratio
  constexpr std::uint64_t weyl_1 = 0xBB67AE8584CAA73B;  // sqrt(3) - 1
  for (int round = 0; round < 10; ++round) {
    const Wide a = Wide{multiplier_0} * counter[0];
    const Wide b = Wide{multiplier_1} * counter[2];
    counter = {
        static_cast<std::uint64_t>(b >> 64) ^ counter[1] ^ key[0], static_cast<std::uint64_t>(b),
        static_cast<std::uint64_t>(a >> 64) ^ counter[3] ^ key[1], static_cast<std::uint64_t>(a)};
    key = {key[0] + weyl_0, key[1] + weyl_1};
  }
  return counter;
}

/// The raw numbers of a stream: below the largest integer nothing but that integer is changed.
std::uint64_t raw(RandomStream& stream) { return stream.below(UINT64_MAX); }

// The vectors of tests/kat_vectors in the Random123 distribution, version 1.14.
TEST(Philox, KnownAnswers) {
  constexpr std::uint64_t ones = ~0ULL;
  EXPECT_EQ(philox4x64_10({0, 0, 0, 0}, {0, 0}), (Block{0x16554d9eca36314c, 0xdb20fe9d672d0fdc,
                                                        0xd7e772cee186176b, 0x7e68b68aec7ba23b}));
  EXPECT_EQ(
      philox4x64_10({ones, ones, ones, ones}, {ones, ones}),
      (Block{0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0}));
  EXPECT_EQ(
      philox4x64_10(
          {0x243f6a8885a308d3, 0x13198a2e03707344, 0xa4093822299f31d0, 0x082efa98ec4e6c89},
          {0x452821e638d01377, 0xbe5466cf34e90c6c}),
      (Block{0xa528f45403e61d95, 0x38c72dbd566e9788, 0xa5a1610e72fd18b5, 0x57bd43b5e52b7fe6}));
}

TEST(RandomStream, IsPhiloxOfSeedPurposeAndReplicate) {
  for (const std::uint64_t seed : {0ULL, 1ULL, 20260101ULL, ~0ULL}) {
    for (const auto purpose : {RandomPurpose::bootstrap, RandomPurpose::coverage}) {
      for (const std::uint64_t replicate : {0ULL, 17ULL, 1ULL << 40}) {
        RandomStream stream(seed, purpose, replicate);
        for (std::uint64_t block = 0; block < 3; ++block) {
          const Block expected =
              philox4x64_10({block, replicate, 0, 0}, {seed, static_cast<std::uint64_t>(purpose)});
          for (const std::uint64_t number : expected) EXPECT_EQ(raw(stream), number);
        }
      }
    }
  }
}

TEST(RandomStream, DoesNotDependOnTheOrderOfUse) {
  std::vector<std::vector<double>> forward(8);
  std::vector<std::vector<double>> mixed(8);
  for (std::uint64_t r = 0; r < 8; ++r) {
    RandomStream stream(5, RandomPurpose::bootstrap, r);
    for (int i = 0; i < 9; ++i) forward[r].push_back(stream.normal());
  }
  std::vector<RandomStream> streams;
  for (std::uint64_t r = 0; r < 8; ++r) streams.emplace_back(5, RandomPurpose::bootstrap, r);
  for (int i = 0; i < 9; ++i) {
    for (std::size_t r = 8; r-- > 0;) mixed[r].push_back(streams[r].normal());
  }
  EXPECT_EQ(forward, mixed);
}

TEST(RandomStream, DifferentTicketsGiveDifferentNumbers) {
  std::set<std::uint64_t> seen;
  std::size_t drawn = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (const auto purpose :
         {RandomPurpose::bootstrap, RandomPurpose::reconstruction, RandomPurpose::coverage}) {
      for (std::uint64_t replicate = 0; replicate < 50; ++replicate) {
        RandomStream stream(seed, purpose, replicate);
        for (int i = 0; i < 8; ++i, ++drawn) seen.insert(raw(stream));
      }
    }
  }
  EXPECT_EQ(seen.size(), drawn);
}

TEST(RandomStream, UniformLiesInsideTheOpenInterval) {
  RandomStream stream(1, RandomPurpose::bootstrap, 0);
  constexpr int count = 200000;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  std::array<int, 16> histogram = {};
  for (int i = 0; i < count; ++i) {
    const double u = stream.uniform();
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    sum_of_squares += u * u;
    ++histogram[static_cast<std::size_t>(u * 16.0)];
  }
  // Five standard errors: sd(u) = 1/sqrt(12), sd(u^2) = sqrt(4/45).
  EXPECT_NEAR(sum / count, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / count));
  EXPECT_NEAR(sum_of_squares / count, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / count));
  double chi2 = 0.0;
  for (const int n : histogram) chi2 += std::pow(n - count / 16.0, 2) / (count / 16.0);
  EXPECT_LT(chi2, 44.3) << "the 0.9999 quantile at 15 degrees of freedom";
}

TEST(RandomStream, NormalHasTheMomentsOfTheNormal) {
  RandomStream stream(2, RandomPurpose::bootstrap, 3);
  constexpr int count = 200000;
  std::array<double, 5> moments = {};
  int beyond_two = 0;
  for (int i = 0; i < count; ++i) {
    const double z = stream.normal();
    ASSERT_TRUE(std::isfinite(z));
    for (std::size_t k = 1; k < moments.size(); ++k) {
      moments[k] += std::pow(z, static_cast<double>(k)) / count;
    }
    if (std::abs(z) > 2.0) ++beyond_two;
  }
  // E z^k = 0, 1, 0, 3; variances of z^k: 1, 2, 15, 96.
  EXPECT_NEAR(moments[1], 0.0, 5.0 * std::sqrt(1.0 / count));
  EXPECT_NEAR(moments[2], 1.0, 5.0 * std::sqrt(2.0 / count));
  EXPECT_NEAR(moments[3], 0.0, 5.0 * std::sqrt(15.0 / count));
  EXPECT_NEAR(moments[4], 3.0, 5.0 * std::sqrt(96.0 / count));
  const double p = std::erfc(std::sqrt(2.0));
  EXPECT_NEAR(static_cast<double>(beyond_two) / count, p, 5.0 * std::sqrt(p * (1 - p) / count));
}

TEST(RandomStream, NormalTakesOneUniformEach) {
  RandomStream normals(9, RandomPurpose::coverage, 1);
  RandomStream uniforms(9, RandomPurpose::coverage, 1);
  for (int i = 0; i < 20; ++i) {
    // The normal distribution function of the draw gives its uniform back.
    EXPECT_NEAR(0.5 * std::erfc(-normals.normal() / std::sqrt(2.0)), uniforms.uniform(), 1e-12);
  }
}

TEST(RandomStream, BelowIsUniformOnEveryRemainder) {
  RandomStream stream(3, RandomPurpose::bootstrap, 1);
  std::map<std::uint64_t, int> histogram;
  constexpr int count = 70000;
  for (int i = 0; i < count; ++i) ++histogram[stream.below(7)];
  ASSERT_EQ(histogram.size(), 7U);
  EXPECT_EQ(histogram.rbegin()->first, 6U);
  for (const auto& [value, n] : histogram) {
    EXPECT_NEAR(n, count / 7.0, 5.0 * std::sqrt(count / 7.0)) << value;
  }
  for (int i = 0; i < 5; ++i) EXPECT_EQ(stream.below(1), 0U);
}

TEST(RandomStream, BelowRejectsTheIncompleteLastCycle) {
  // Just above half of the range nearly every second number belongs to an incomplete cycle.
  constexpr std::uint64_t n = (1ULL << 63) + 1;
  RandomStream stream(4, RandomPurpose::bootstrap, 0);
  RandomStream numbers(4, RandomPurpose::bootstrap, 0);
  int rejected = 0;
  for (int i = 0; i < 100; ++i) {
    std::uint64_t number = raw(numbers);
    for (; number >= n; number = raw(numbers)) ++rejected;
    EXPECT_EQ(stream.below(n), number);
  }
  EXPECT_GT(rejected, 50);
}

}  // namespace
}  // namespace recoil
