#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/pairing_report.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;
using testing::Not;

Averages with_points(std::size_t count) {
  Averages averages;
  for (std::size_t i = 0; i < count; ++i) {
    PointMean point;
    point.series = "s" + std::to_string(i);
    point.diameter = 50e-6;
    point.velocity = 1.0 + static_cast<double>(i);
    averages.points.push_back(point);
  }
  return averages;
}

TEST(PairingDocument, ListsFortyPointsAndCountsTheOthers) {
  for (const std::size_t count : {1U, 40U, 45U}) {
    const Averages averages = with_points(count);
    const Table table = averages_table(averages);
    ASSERT_EQ(table.rows.size(), std::min<std::size_t>(count, 40));
    EXPECT_EQ(plain_text(words_of_cell(table.rows.front().front())), "s0");
    const std::string text = pairing_text({}, {}, averages);
    if (count > 40) {
      EXPECT_THAT(text, HasSubstr("... and 5 more"));
    } else {
      EXPECT_THAT(text, Not(HasSubstr(" more\n")));
    }
  }
}

}  // namespace
}  // namespace recoil
