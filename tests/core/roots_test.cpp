#include <gtest/gtest.h>

#include <cmath>

#include "core/numerics.hpp"

namespace recoil {
namespace {

TEST(FindRoot, FindsItToTheLastDigits) {
  int calls = 0;
  const double root = find_root(
      [&](double x) {
        ++calls;
        return std::cos(x) - x;
      },
      0.0, 2.0);
  EXPECT_NEAR(root, 0.7390851332151607, 1e-15);
  EXPECT_LT(calls, 20);  // halving would take 47
}

TEST(FindRoot, RisingOrFallingAndAtTheEnds) {
  const auto line = [](double x) { return x - 3.0; };
  EXPECT_DOUBLE_EQ(find_root(line, 0.0, 10.0), 3.0);
  EXPECT_DOUBLE_EQ(find_root([&](double x) { return -line(x); }, 0.0, 10.0), 3.0);
  EXPECT_EQ(find_root(line, 3.0, 10.0), 3.0);
  EXPECT_EQ(find_root(line, 0.0, 3.0), 3.0);
}

TEST(FindRoot, SaysWhereThereIsNone) {
  EXPECT_TRUE(std::isnan(find_root([](double x) { return 1.0 + x * x; }, -1.0, 1.0)));
  EXPECT_TRUE(std::isnan(find_root([](double) { return NAN; }, -1.0, 1.0)));
}

TEST(FindMinimum, IsAsCloseAsAskedFor) {
  const auto well = [](double x) { return std::cosh(x - 0.3); };
  EXPECT_NEAR(find_minimum(well, -5.0, 4.0, 1e-6), 0.3, 1e-6);
  EXPECT_NEAR(find_minimum([](double x) { return x; }, 1.0, 2.0, 1e-6), 1.0, 1e-6);
}

}  // namespace
}  // namespace recoil
