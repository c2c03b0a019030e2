#include "core/units.hpp"

#include <gtest/gtest.h>

namespace recoil {
namespace {

TEST(Units, ConvertToSi) {
  EXPECT_EQ(unit_factor(Dimension::length, "um"), 1e-6);
  EXPECT_EQ(unit_factor(Dimension::length, "mm"), 1e-3);
  EXPECT_EQ(unit_factor(Dimension::length, "m"), 1.0);
  EXPECT_EQ(unit_factor(Dimension::velocity, "m/s"), 1.0);
  EXPECT_EQ(unit_factor(Dimension::velocity, "cm/s"), 1e-2);
  EXPECT_EQ(unit_factor(Dimension::ratio, "1"), 1.0);
  EXPECT_EQ(unit_factor(Dimension::ratio, "%"), 1e-2);
  EXPECT_EQ(unit_factor(Dimension::count, "1"), 1.0);
  EXPECT_EQ(unit_factor(Dimension::time, "ms"), 1e-3);
  // NIST SP 811, appendix B: in, ft and mile are exact.
  EXPECT_EQ(unit_factor(Dimension::length, "in"), 0.0254);
  EXPECT_DOUBLE_EQ(*unit_factor(Dimension::length, "ft"), 12 * 0.0254);
  EXPECT_DOUBLE_EQ(*unit_factor(Dimension::velocity, "mph"), 0.44704);
  EXPECT_DOUBLE_EQ(*unit_factor(Dimension::velocity, "km/h"), 1000.0 / 3600.0);
  // Both letters mu.
  EXPECT_EQ(unit_factor(Dimension::length, "\xC2\xB5m"), 1e-6);
  EXPECT_EQ(unit_factor(Dimension::length, "\xCE\xBCm"), 1e-6);
}

TEST(Units, KeepDimensionsApart) {
  EXPECT_EQ(unit_factor(Dimension::length, "m/s"), std::nullopt);
  EXPECT_EQ(unit_factor(Dimension::velocity, "m"), std::nullopt);
  EXPECT_EQ(unit_factor(Dimension::count, "%"), std::nullopt);
  EXPECT_EQ(unit_factor(Dimension::ratio, ""), std::nullopt);
}

TEST(Units, TextsHaveNone) {
  EXPECT_TRUE(unit_names(Dimension::text).empty());
  EXPECT_EQ(dimension_of_unit(""), std::nullopt);
}

TEST(Units, EveryListedNameIsAccepted) {
  for (const Dimension dimension :
       {Dimension::length, Dimension::velocity, Dimension::ratio, Dimension::count}) {
    const auto names = unit_names(dimension);
    EXPECT_FALSE(names.empty());
    for (const std::string& name : names) {
      EXPECT_TRUE(unit_factor(dimension, name).has_value()) << name;
    }
  }
}

}  // namespace
}  // namespace recoil
