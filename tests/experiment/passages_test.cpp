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
  // 1,500 is fifteen hundred or one and a half.
  const std::string either = "time;velocity;diameter\n1,500;2;3\n1,600;2;3\n1;2;3\n";
  const std::string commas = complaint(either);
  EXPECT_NE(commas.find("dir/e.csv:2:1: time is '1,500' (2 of 3 rows"), std::string::npos)
      << commas;
  PassageFormat stated = plain_units();
  stated.decimal_comma = true;
  EXPECT_DOUBLE_EQ(read(either, stated).passages[1].time, 1.5e-3);
}

struct InstrumentFile {
  const char* program;
  std::string text;
  std::size_t skipped;  ///< lines above the header
};

// Two passages at 10 and 12.5 ms, 1.25 and -1.125 m/s, 60.5 and 60 um.
TEST(Events, FilesOfInstruments) {
  const InstrumentFile files[] = {
      {"Dantec BSA Flow Software, decimal points",
       "DXEX v4\r\nD:\\run7\r\n\r\n\"Row#\"\t\"AT [ms]\"\t\"TT [µs]\"\t\"LDA1 [m/s]\"\t\"D "
       "[µm]\"\r\n"
       "1\t10.0\t30.0\t1.25\t60.5\r\n2\t12.5\t30.0\t-1.125\t60.0\r\n",
       3},
      {"the same, decimal commas, an empty cell at the end of the header",
       "DXEX v5\nsource.lda\n5:32:17 AM\n1;-2,00 mm;0,00 mm;20,00 mm\nX_20mm\n"
       "\"Row#\"\t\"AT [ms]\"\t\"TT [us]\"\t\"LDA1 [m/s]\"\t\"U12 [deg]\"\t\"D [um]\"\t\n"
       "1\t10,0\t2,0\t1,25\t1,0\t60,5\n2\t12,5\t2,0\t-1,125\t1,0\t60,0\t\n",
       5},
      {"TSI FlowSizer",
       "run 7\nTime Ch. 1 (sec), \"Gate Time Ch. 1 (usec)\", \"Velocity Ch. 1 (m/sec)\", "
       "\"Diameter (um)\", \"Diameter Dif (um)\"\n0.0100,30, 1.25, 60.5,1\n0.0125,30,-1.125,60,1\n",
       1},
  };
  for (const InstrumentFile& file : files) {
    const PassageTable table = read(file.text, {});
    ASSERT_EQ(table.passages.size(), 2U) << file.program;
    EXPECT_EQ(table.damaged, 0U) << file.program;
    EXPECT_NEAR(table.passages[0].time, 0.0100, 1e-12) << file.program;
    EXPECT_NEAR(table.passages[1].time, 0.0125, 1e-12) << file.program;
    EXPECT_NEAR(table.passages[0].velocity, 1.25, 1e-12) << file.program;
    EXPECT_NEAR(table.passages[1].velocity, -1.125, 1e-12) << file.program;
    EXPECT_NEAR(table.passages[0].diameter, 60.5e-6, 1e-15) << file.program;
    EXPECT_EQ(table.passages[0].line, static_cast<int>(file.skipped) + 2) << file.program;
  }
  // Which of two components is normal to the surface, only the user knows.
  const std::string two = "AT [ms]\tLDA1 [m/s]\tLDA2 [m/s]\tD [um]\n1\t2\t3\t4\n";
  EXPECT_NE(complaint(two, {}).find("--column velocity="), std::string::npos);
  PassageFormat stated;
  stated.columns = {{"velocity", "LDA2"}, {"tangential_velocity", "LDA1"}};
  EXPECT_DOUBLE_EQ(read(two, stated).passages[0].velocity, 3.0);
  EXPECT_DOUBLE_EQ(read(two, stated).passages[0].tangential, 2.0);
}

}  // namespace
