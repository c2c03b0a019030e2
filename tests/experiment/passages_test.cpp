#include "experiment/passages.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace {

using namespace recoil;

PassageFormat plain_units() {
  PassageFormat format;
  format.units = {{"time", "ms"}, {"velocity", "cm/s"}, {"diameter", "um"}};
  return format;
}

PassageTable read(const std::string& text, const PassageFormat& format = plain_units()) {
  return parse_passages(text, "dir/e.csv", "", format);
}

std::string complaint(const std::string& text, const PassageFormat& format = plain_units(),
                      const std::string& package = "") {
  try {
    parse_passages(text, "dir/e.csv", package, format);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Events, ConvertsUnits) {
  const PassageTable table = read("time,velocity,diameter\n1500,-40,49\n");
  ASSERT_EQ(table.passages.size(), 1U);
  EXPECT_DOUBLE_EQ(table.passages[0].time, 1.5);
  EXPECT_DOUBLE_EQ(table.passages[0].velocity, -0.4);
  EXPECT_DOUBLE_EQ(table.passages[0].diameter, 49e-6);
  EXPECT_EQ(table.passages[0].line, 2);
  EXPECT_FALSE(table.has_tangential);
}

TEST(Events, OtherDelimitersBlanksQuotesAndLineEnds) {
  const PassageTable table = read("\"time\"; velocity ;diameter\r\n 1 ;\"2\";3\r\n\r\n4;5;6");
  ASSERT_EQ(table.passages.size(), 2U);
  EXPECT_DOUBLE_EQ(table.passages[0].velocity, 0.02);
  EXPECT_EQ(table.passages[1].line, 4);
  EXPECT_EQ(read("time\tvelocity\tdiameter\n1\t2\t3\n").passages.size(), 1U);
}

TEST(Events, ColumnsByAnyNameAndOrder) {
  PassageFormat format = plain_units();
  format.columns = {{"velocity", "LDA1"}};
  format.positive_away = true;
  const PassageTable table = read("phase,diameter,LDA1,time\n7,49,-40,1\n", format);
  EXPECT_DOUBLE_EQ(table.passages[0].velocity, 0.4);
  EXPECT_EQ(table.ignored, std::vector<std::string>{"phase"});
}

TEST(Events, UnitsFromThePackageBesideTheFile) {
  const std::string package = R"({"resources": [{"path": "e.csv", "schema": {"fields": [
      {"name": "time", "unit": "us"}, {"name": "velocity", "unit": "m/s"},
      {"name": "diameter", "unit": "mm"}]}}], "recoil": {"provenance": "synthetic"}})";
  const PassageTable table =
      parse_passages("time,velocity,diameter\n5,1,0.05\n", "dir/e.csv", package, {});
  EXPECT_DOUBLE_EQ(table.passages[0].time, 5e-6);
  EXPECT_DOUBLE_EQ(table.passages[0].diameter, 5e-5);
  EXPECT_EQ(table.provenance, recoil::Provenance::synthetic);
  // The option goes before the package.
  PassageFormat format;
  format.units = {{"time", "s"}};
  EXPECT_DOUBLE_EQ(
      parse_passages("time,velocity,diameter\n5,1,0.05\n", "dir/e.csv", package, format)
          .passages[0]
          .time,
      5.0);
}

TEST(Events, DamageIsCountedAndPlaced) {
  const PassageTable table = read(
      "time,velocity,diameter\n1,40,49\nx,40,49\n2,40\n3,40,49\n4,nan,49\n5,40,-3\n6,0,49\n7,40,"
      "49\n"
      "8,40,49\n9,40,49\n10,40,49\n");
  EXPECT_EQ(table.rows, 11U);
  EXPECT_EQ(table.passages.size(), 6U);
  EXPECT_EQ(table.damaged, 5U);
  ASSERT_EQ(table.first_damaged.size(), most_examples);
  EXPECT_EQ(table.first_damaged[0].line, 3);
  EXPECT_EQ(table.first_damaged[0].problem, "time is 'x'");
  EXPECT_EQ(table.first_damaged[1].problem, "2 cells, the header has 3");
  EXPECT_EQ(table.first_damaged[2].line, 6);
}

TEST(Events, SortsAndUnitesRepetitions) {
  const PassageTable table =
      read("time,velocity,diameter\n5,40,49\n1,40,49\n5,40,49\n3,-20,49\n5,41,49\n6,1,2\n");
  ASSERT_EQ(table.passages.size(), 5U);
  EXPECT_EQ(table.unsorted, 2U);
  EXPECT_EQ(table.first_unsorted, 3);
  EXPECT_EQ(table.duplicated, 1U);
  EXPECT_EQ(table.first_duplicated, std::vector<int>{4});
  for (std::size_t i = 1; i < table.passages.size(); ++i) {
    EXPECT_LE(table.passages[i - 1].time, table.passages[i].time);
  }
}

TEST(Events, RunsHaveTheirOwnTime) {
  const PassageTable table =
      read("series,time,velocity,diameter\na,5,40,49\nb,1,40,49\na,6,40,49\n,7,40,49\n");
  EXPECT_EQ(table.series, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(table.unsorted, 0U);
  EXPECT_EQ(table.damaged, 1U) << "a row without its series";
  EXPECT_EQ(table.passages[1].series, 0U);
}

TEST(Events, MistakesOfTheUser) {
  EXPECT_NE(complaint("time,velocity,velocity,diameter\n1,2,2,3\n")
                .find("dir/e.csv:1:2: two columns are called 'velocity'"),
            std::string::npos);
  EXPECT_NE(complaint("time,velocity\n1,2\n").find("dir/e.csv:1:1: there is no column 'diameter'"),
            std::string::npos);
  EXPECT_NE(complaint("time,velocity,diameter\n1,2,3\n", {}).find("the unit of 'time'"),
            std::string::npos);
  PassageFormat wrong = plain_units();
  wrong.units["diameter"] = "m/s";
  EXPECT_NE(complaint("time,velocity,diameter\n1,2,3\n", wrong).find("use um"), std::string::npos);
  PassageFormat unknown = plain_units();
  unknown.units["velocty"] = "m/s";
  EXPECT_NE(complaint("time,velocity,diameter\n1,2,3\n", unknown).find("did you mean 'velocity'?"),
            std::string::npos);
  EXPECT_NE(complaint("").find("the file is empty"), std::string::npos);
  EXPECT_NE(complaint("time,velocity,diameter\n").find("no row below it"), std::string::npos);
  const std::string commas = complaint("time;velocity;diameter\n1,5;2;3\n1,6;2;3\n1;2;3\n");
  EXPECT_NE(commas.find("dir/e.csv:2:1: time is '1,5' (2 of 3 rows"), std::string::npos) << commas;
}

}  // namespace
