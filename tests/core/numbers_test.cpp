#include "core/numbers.hpp"

#include <gtest/gtest.h>

namespace recoil {
namespace {

TEST(Numbers, WholeNumbersAreDecimal) {
  EXPECT_EQ(parse_whole_number("010"), 10);
  EXPECT_EQ(parse_whole_number("08"), 8);
  EXPECT_EQ(parse_whole_number(" -7 "), -7);
  EXPECT_EQ(parse_whole_number("9223372036854775807"), 9223372036854775807);
  for (const char* wrong : {"", "1.0", "1e3", "0x1f", "9223372036854775808", "1 2", "one", "+-1"}) {
    EXPECT_EQ(parse_whole_number(wrong), std::nullopt) << wrong;
  }
}

TEST(Numbers, AClockTimeIsHoursMinutesSeconds) {
  EXPECT_EQ(parse_clock_time("01:30:08"), 5408);
  EXPECT_EQ(parse_clock_time("101:02:03"), 363723);
  for (const char* wrong : {"24:00", "1:60:00", "1:00:60", "-1:00:00", "90", ""}) {
    EXPECT_EQ(parse_clock_time(wrong), std::nullopt) << wrong;
  }
}

}  // namespace
}  // namespace recoil
