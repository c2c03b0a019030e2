// Every lane of a pack does what double does, also with zeros of either sign, infinities and NaN.
#include "impact/lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

namespace recoil {
namespace {

using Pack = Lanes<2>;
using Mask = Pack::mask_type;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double tiny = std::numeric_limits<double>::denorm_min();

/// The bits of `value`; all of NaN count as one, because their sign is open.
std::uint64_t digits(double value) {
  return std::isnan(value) ? 1U : std::bit_cast<std::uint64_t>(value);
}

TEST(LanesTest, EveryOperationIsThatOfDouble) {
  const std::array values = {0.0, -0.0, 1.0, -1.5, 3e300, -3e300, tiny, inf, -inf, no_number};
  const auto expect = [&](const Pack& pack, double first, double second) {
    EXPECT_EQ(digits(pack[0]), digits(first)) << first;
    EXPECT_EQ(digits(pack[1]), digits(second)) << second;
  };
  for (const double x : values) {
    for (const double y : values) {
      const std::array<double, 2> left = {x, y}, right = {y, x};
      const Pack a(left.data()), b(right.data());
      SCOPED_TRACE(::testing::Message() << x << " and " << y);
      expect(a + b, x + y, y + x);
      expect(a - b, x - y, y - x);
      expect(a * b, x * y, y * x);
      expect(a / b, x / y, y / x);
      expect(-a, -x, -y);
      expect(abs(a), std::abs(x), std::abs(y));
      expect(sqrt(a), std::sqrt(x), std::sqrt(y));
      expect(max(a, b), x > y ? x : y, y > x ? y : x);
      expect(min(a, b), x < y ? x : y, y < x ? y : x);
      expect(Pack(x), x, x);
      for (const auto& [mask, first, second] :
           {std::tuple(a < b, x < y, y < x), std::tuple(a <= b, x <= y, y <= x),
            std::tuple(a > b, x > y, y > x), std::tuple(a >= b, x >= y, y >= x),
            std::tuple(a == b, x == y, y == x), std::tuple(!(a < b), !(x < y), !(y < x)),
            std::tuple(a < b && a < 1.0, x < y && x < 1.0, y < x && y < 1.0),
            std::tuple(a < b || a < 1.0, x < y || x < 1.0, y < x || y < 1.0)}) {
        EXPECT_EQ(mask[0], first);
        EXPECT_EQ(mask[1], second);
        EXPECT_EQ(any_of(mask), first || second);
        EXPECT_EQ(none_of(mask), !first && !second);
        EXPECT_EQ(all_of(mask), first && second);
        Pack changed = a;
        where(mask, changed) = b;
        expect(changed, first ? y : x, second ? x : y);
        where(mask, changed) += a;
        expect(changed, first ? y + x : x, second ? x + y : y);
      }
    }
  }
}

TEST(LanesTest, OneLaneIsSetWithoutTheOthers) {
  Pack pack = 1.0;
  pack[1] = 2.0;
  Mask mask(false);
  mask[1] = true;
  EXPECT_EQ(pack[0], 1.0);
  EXPECT_EQ(pack[1], 2.0);
  EXPECT_FALSE(mask[0]);
  EXPECT_TRUE(mask[1]);
  where(mask, mask) = false;
  EXPECT_TRUE(none_of(mask));
}

}  // namespace
}  // namespace recoil
