#include "document/number.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace recoil {
namespace {

std::string with_error(double value, double error) {
  return plain_text(Number{value, significant(4), error}.words());
}

TEST(Number, AnErrorDecidesTheDigitsOfItsValue) {
  EXPECT_EQ(with_error(0.0031234, 0.00021), "0.00312 +/- 0.00021");
  EXPECT_EQ(with_error(8.9161, 0.4321), "8.92 +/- 0.43");
  EXPECT_EQ(with_error(1234.5, 30.0), "1234 +/- 30");
  EXPECT_EQ(with_error(1.2345, 0.0999), "1.23 +/- 0.10");
  EXPECT_EQ(with_error(2.0, 0.0), "2");
}

TEST(Number, OneExponentIsThatOfTheErrorAndTheInterval) {
  EXPECT_EQ(with_error(1.2341e-7, 1.1e-9), "(1.234 +/- 0.011)e-7");
  EXPECT_EQ(with_error(4.507e7, 371549.0), "(4.507 +/- 0.037)e7");
  EXPECT_EQ(with_error(-9.96e-6, 1e-5), "(-1.0 +/- 1.0)e-5");
  EXPECT_EQ(NumberRange({1.21e-7, 1.2561e-7, beside(1.2341e-7, 1.1e-9)}).text(),
            "[1.210e-7, 1.256e-7]");
  EXPECT_EQ(NumberRange({0.000898, 0.00696, beside(0.0039, 0.0016)}).text(), "[0.0009, 0.0070]");
}

TEST(Number, IsShort) {
  EXPECT_EQ(number(NAN), "n/a");
  EXPECT_EQ(number(3e-5), "3e-5");
  EXPECT_EQ(number(1.5e-12), "1.5e-12");
  EXPECT_EQ(digits(1.0, 3), "1.00");
  EXPECT_EQ(number(999.96, 3), "1000");
  EXPECT_EQ(p_value_text(1e-9), "< 1e-6");
  EXPECT_EQ(percent(0.95), "95 %");
}

TEST(Number, RoundingUpToATenKeepsTheDigits) {
  EXPECT_EQ(digits(0.1, 3), "0.100");
  EXPECT_EQ(digits(0.09999999, 3), "0.100");
  EXPECT_EQ(digits(-9.9999, 3), "-10.0");
  EXPECT_EQ(digits(9.99, 3), "9.99");
  EXPECT_EQ(digits(99999.6, 3), "100000");
}

TEST(Number, EveryNotation) {
  EXPECT_EQ(text_of(0.123456, significant(3)), "0.123");
  EXPECT_EQ(text_of(0.1, padded(3)), "0.100");
  EXPECT_EQ(text_of(0.12345, fixed(2)), "0.12");
  EXPECT_EQ(text_of(0.12345, signed_fixed(2)), "+0.12");
  EXPECT_EQ(text_of(1.5e-13, scientific(1)), "1.5e-13");
  EXPECT_EQ(text_of(1e-7, probability()), "< 1e-6");
  EXPECT_EQ(text_of(-0.256, in_percent(signed_fixed(0))), "-26 %");
  EXPECT_EQ(text_of(INFINITY, fixed(2)), "n/a");
}

TEST(Number, SaysItsErrorAndUnit) {
  EXPECT_EQ(plain_text(Number{0.0031234, significant(4), 0.00021, "s/m"}.words()),
            "0.00312 +/- 0.00021 s/m");
  EXPECT_EQ(plain_text(Number{2.5, fixed(1), 0.0, "um"}.words()), "2.5 um");
  EXPECT_EQ(plain_text(Number{2.5, fixed(1), 0.0, "1"}.words()), "2.5");
  EXPECT_EQ(plain_text(Number{0.853, fixed(3), 0.0, "", std::pair{0.84, 0.8661}}.words()),
            "0.853 [0.840, 0.866]");
  EXPECT_EQ(NumberRange({0.1, 0.25, padded(2)}).text(), "[0.10, 0.25]");
  EXPECT_FALSE(number_if(NAN, fixed(1)).has_value());
  EXPECT_FALSE(number_if(std::nullopt, fixed(1)).has_value());
}

}  // namespace
}  // namespace recoil
