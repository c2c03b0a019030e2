#include <gtest/gtest.h>

#include "predict/capture_comparison.hpp"

namespace {

recoil::Material named(const std::string& name) {
  recoil::Material material;
  material.name = name;
  return material;
}

TEST(PublishedCaptures, EachHasASourceAndAPlausibleValue) {
  for (const recoil::PublishedCapture& one : recoil::published_captures()) {
    EXPECT_FALSE(one.source.empty());
    EXPECT_FALSE(one.what.empty());
    EXPECT_GT(one.diameter, 1e-8);
    EXPECT_LT(one.diameter, 1e-3);
    EXPECT_GT(one.velocity, 0.01);
    EXPECT_LT(one.velocity, 20.0);
  }
}

TEST(PublishedCaptures, AreFoundByTheNamesOfADataset) {
  const auto steel =
      recoil::published_captures_for(named("316 stainless steel"), named("silicon [100]"));
  ASSERT_EQ(steel.size(), 2U);
  EXPECT_FALSE(steel[0].measured);
  const auto fluorescein =
      recoil::published_captures_for(named("Ammonium fluorescein"), named("Silicon"));
  ASSERT_EQ(fluorescein.size(), 2U);
  EXPECT_EQ(fluorescein[0].velocity, 0.57);
  EXPECT_EQ(fluorescein[1].velocity, 1.6);
}

TEST(PublishedCaptures, OtherSystemsHaveNone) {
  EXPECT_TRUE(recoil::published_captures_for(named("ammonium fluorescein"), named("mica")).empty());
  // Silicone is not silicon, silverware not silver.
  EXPECT_TRUE(
      recoil::published_captures_for(named("ammonium fluorescein"), named("silicone")).empty());
  EXPECT_TRUE(recoil::published_captures_for(named("silverware"), named("aluminium")).empty());
  EXPECT_FALSE(recoil::published_yield_pressure(named("polystyrene")).has_value());
  ASSERT_TRUE(recoil::published_yield_pressure(named("ammonium fluorescein")).has_value());
}

}  // namespace
