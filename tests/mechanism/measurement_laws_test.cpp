// Errors of size, selection, pairing and batch, and the size law, against what they mean.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "one_point.hpp"

namespace recoil {
namespace {

using one_point::kBase;
using one_point::kDiameter;
using one_point::kSoft;
using one_point::square;

TEST(SizeCalibration, IsTheModelAtTheTrueDiameter) {
  EXPECT_NEAR(square(kSoft, {"size_calibration"}, {0.1}, kDiameter, 3.0, kBase),
              square(kSoft, {}, {}, 1.1 * kDiameter, 3.0, kBase), 1e-10);
}

TEST(SizeLaw, ChangesThePowerOfTheAdhesion) {
  // f0 ~ r^p about 4.9 um: at 9.8 um, 2^(p - 1/3) times what equation 12 has there.
  const double p = 0.6;
  one_point::Base stronger = kBase;
  stronger.f0 *= std::pow(2.0, p - 1.0 / 3.0);
  EXPECT_NEAR(square(kSoft, {"size_law"}, {p}, 2.0 * kDiameter, 3.0, kBase),
              square(kSoft, {}, {}, 2.0 * kDiameter, 3.0, stronger), 1e-10);
  EXPECT_NEAR(square(kSoft, {"size_law"}, {p}, kDiameter, 3.0, kBase),
              square(kSoft, {}, {}, kDiameter, 3.0, kBase), 1e-10);
}

TEST(ReboundTruncation, IsTheMeanOfATruncatedNormal) {
  const double V = 1.5;
  const double e = std::sqrt(square(kSoft, {}, {}, kDiameter, V, kBase));
  ASSERT_GT(e, 0.2);
  const double s = 0.1;
  // Cut off at the mean: of a half-normal, e (1 + s sqrt(2 / pi)). Half is seen, which the border
  // to "nothing seen" (0.1 %) reaches into by 0.5 * 1.001 / 0.501 = 0.999.
  const double seen = std::pow(e * (1.0 + s * std::sqrt(2.0 / std::numbers::pi)), 2);
  const double share = 0.5 * 1.001 / 0.501;
  EXPECT_NEAR(square(kSoft, {"rebound_truncation"}, {e * V, s}, kDiameter, V, kBase), share * seen,
              1e-9);
  // Far below the mean all are seen.
  EXPECT_NEAR(square(kSoft, {"rebound_truncation"}, {0.2 * e * V, s}, kDiameter, V, kBase), e * e,
              1e-12);
  // Three deviations above it one in 740: what is seen lies 0.028 e above the border.
  const double hazard = 0.0044318484119380075 / 0.0013498980316300957;  // of the normal at 3
  const double tail = std::pow(e * (1.0 + s * hazard), 2);
  const double missing = e * e * (1.0 - 1.3 * 1.3);
  const double part = 0.0013498980316300957 * 1.001 / 0.0023498980316300957;
  EXPECT_NEAR(square(kSoft, {"rebound_truncation"}, {1.3 * e * V, s}, kDiameter, V, kBase),
              missing + part * (tail - missing), 1e-9);
  // Far above it none: it looks like capture.
  EXPECT_NEAR(square(kSoft, {"rebound_truncation"}, {2.0 * e * V, s}, kDiameter, V, kBase),
              e * e - 4.0 * e * e, 1e-12);
}

TEST(Outliers, DrawTheMeanTowardsOneHalf) {
  const double e = std::sqrt(square(kSoft, {}, {}, kDiameter, 5.0, kBase));
  EXPECT_NEAR(std::sqrt(square(kSoft, {"outliers"}, {0.1}, kDiameter, 5.0, kBase)), 0.9 * e + 0.05,
              1e-4);
  // A captured sphere has no partner: still captured.
  const double captured = square(kSoft, {}, {}, kDiameter, 0.8, kBase);
  ASSERT_LT(captured, -0.1);
  EXPECT_LT(square(kSoft, {"outliers"}, {0.05}, kDiameter, 0.8, kBase), 0.5 * captured);
}

TEST(SeriesOffset, IsAddedToE) {
  const double e = std::sqrt(square(kSoft, {}, {}, kDiameter, 5.0, kBase));
  for (const double offset : {0.05, -0.05}) {
    EXPECT_NEAR(std::sqrt(square(kSoft, {"series_offset"}, {offset}, kDiameter, 5.0, kBase)),
                e + offset, 1e-5);
  }
}

}  // namespace
}  // namespace recoil
