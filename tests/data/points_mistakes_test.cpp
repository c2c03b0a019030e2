#include <gtest/gtest.h>

#include "support/dataset_folder.hpp"

namespace example {
namespace {

using support::changed;
using support::Mistake;

namespace fs = std::filesystem;

class PointsMistake : public testing::TestWithParam<Mistake> {};

TEST_P(PointsMistake, IsOneClearLine) {
  const Mistake& mistake = GetParam();
  const DatasetFolder folder(package, changed(points, mistake.old_text, mistake.new_text));
  folder.expect(mistake);
}

const Mistake points_mistakes[] = {
    // The header.
    {"header_unknown_column", "incident_velocity", "incident_velocty",
     "points.csv:1:17: ", "'incident_velocty'", "did you mean 'incident_velocity'?"},
    {"header_repeated_column", "velocity_sd", "restitution", "points.csv:1:62: ", "'restitution'",
     "remove or rename"},
    {"header_missing_column", ",events", "", "points.csv:1:1: ", "the column 'events' is missing",
     "add the column"},
    {"header_other_delimiter",
     "series,diameter,incident_velocity,restitution,restitution_sd,velocity_sd,events,captured",
     "series;diameter;incident_velocity", "points.csv:1:1: ", "is not in the schema", "'dialect'"},
    // The diameter.
    {"diameter_negative", "1.27,2.5", "-1.27,2.5", "points.csv:2:7: ", "diameter = -1.27 um",
     "correct it"},
    {"diameter_zero", "1.27,2.5", "0,2.5", "points.csv:2:7: ", "diameter = 0 um", "correct it"},
    {"diameter_absurdly_large", "4.9,12.5", "4.9e6,12.5",
     "points.csv:4:17: ", "diameter = 4.9e+06 um", "the unit is probably um"},
    {"diameter_absurdly_small", "4.9,12.5", "4.9e-6,12.5",
     "points.csv:4:17: ", "diameter = 4.9e-06 um", "the unit is probably m"},
    {"diameter_empty", "1.27,2.5", ",2.5", "points.csv:2:7: ", "'diameter' is empty", "fill it in"},
    // Velocities.
    {"velocity_zero", "2.5,0.71", "0,0.71", "points.csv:2:12: ", "incident_velocity = 0 m/s",
     "correct it"},
    {"velocity_negative", "2.5,0.71", "-2.5,0.71", "points.csv:2:12: ", "incident_velocity = -2.5",
     "correct it"},
    {"velocity_absurd", "2.5,0.71", "2.5e5,0.71", "points.csv:2:12: ", "250000", "check the unit"},
    // What is no number.
    {"nan", "0.71", "nan", "points.csv:2:16: ", "'nan' is not a number", "leave the cell empty"},
    {"infinity", "0.71", "-Infinity", "points.csv:2:16: ", "'-Infinity' is not a number",
     "leave the cell empty"},
    {"text", "0.71", "high", "points.csv:2:16: ", "'high' is not a number", "such as 4.9"},
    {"number_and_text", "0.71", "0.71x", "points.csv:2:16: ", "'0.71x' is not a number",
     "such as 4.9"},
    {"two_signs", "0.71", "+-0.71", "points.csv:2:16: ", "'+-0.71' is not a number", "such as 4.9"},
    {"overflow", "0.71", "1e999", "points.csv:2:16: ", "'1e999' is not a number", "such as 4.9"},
    {"decimal_comma_quoted", "0.71", "\"0,71\"", "points.csv:2:16: ", "'0,71' is not a number",
     "a decimal comma? write 0.71"},
    {"decimal_comma", "0.71,1.5,4,40,3", "0,71,1.5,4,40,3",
     "points.csv:2:30: ", "this row has 9 cells", "write decimals with a point"},
    {"control_characters", "0.71", "\x1b[31mred", "points.csv:2:16: ", "' [31mred'", "such as"},
    {"long_text", "0.71", std::string(5000, 'x'), "points.csv:2:16: ", "xxx...'", "such as"},
    // The restitution.
    {"restitution_above_the_limit", "0.71", "1.21", "points.csv:2:16: ", "restitution = 1.21",
     "correct it"},
    {"restitution_in_per_cent", "0.71", "71", "points.csv:2:16: ", "restitution = 71",
     "in per cent its unit is %"},
    {"restitution_negative", "0.71", "-0.1", "points.csv:2:16: ", "it cannot be negative",
     "correct it"},
    {"restitution_empty", "0.71,1.5,4,40,3", ",1.5,4,40,",
     "points.csv:2:16: ", "'restitution' is empty", "fill it in"},
    {"restitution_though_captured", "1.25,,", "1.25,0.5,", "points.csv:3:17: ", "all were captured",
     "write 0 or leave the cell empty"},
    {"sd_zero", "0.71,1.5", "0.71,0", "points.csv:2:21: ", "restitution_sd = 0 %",
     "leave the cell empty"},
    {"sd_negative", "0.71,1.5", "0.71,-1.5", "points.csv:2:21: ", "restitution_sd = -1.5 %",
     "leave the cell empty"},
    {"sd_above_one", "0.71,1.5", "0.71,150", "points.csv:2:21: ", "restitution_sd = 150 %",
     "has the unit %"},
    {"velocity_sd_zero", "1.5,4,40", "1.5,0,40", "points.csv:2:25: ", "velocity_sd = 0 cm/s",
     "leave the cell empty"},
    // Counts.
    {"captured_above_events", "40,3", "40,41", "points.csv:2:30: ", "captured = 41",
     "is a part of 'events'"},
    {"captured_negative", "40,3", "40,-1", "points.csv:2:30: ", "captured = -1", "correct it"},
    {"captured_without_events", "4,40,3", "4,,3", "points.csv:2:28: ", "captured = 3",
     "'events', which is 1 when"},
    {"events_fraction", "40,3", "40.5,3", "points.csv:2:27: ", "events = 40.5", "write 1, 2, 3"},
    {"events_zero", "40,3", "0,0", "points.csv:2:27: ", "events = 0", "correct it"},
    {"events_too_many", "40,3", "4e9,3", "points.csv:2:27: ", "events = 4e+09", "split the point"},
    // Rows and quotes.
    {"row_too_short", "35,0.95,1.5,,40,0", "35,0.95", "points.csv:5:15: ", "this row has 4 cells",
     "keep the comma"},
    {"row_too_long", "40,0\n", "40,0,7,8\n", "points.csv:5:30: ", "this row has 10 cells",
     "quote text that has commas"},
    {"quote_never_closed", "\"large, coated\"", "\"large, coated",
     "points.csv:4:1: ", "never closed", "close it"},
    {"quote_closed_too_early", "\"large, coated\"", "\"large\" coated",
     "points.csv:4:9: ", "quotation mark in the middle", "write \"\""},
    {"quote_inside", "small,1.27,35", "sm\"all,1.27,35",
     "points.csv:5:3: ", "quotation mark in the middle", "write \"\""},
    {"cell_without_end", "small", "\"" + std::string(20000, 'y'),
     "points.csv:2:1: ", "more than 10000 characters", "never closed"},
    {"series_empty", "small,1.27,2.5", ",1.27,2.5", "points.csv:2:1: ", "'series' is empty",
     "give the series a name"},
    {"series_of_two_lines", "\"large, coated\"", "\"large\ncoated\"",
     "points.csv:4:1: ", "control characters", "use letters"},
    {"line_is_right_after_a_quoted_newline", "\"large, coated\",4.9,12.5,0.912",
     "\"large\n\",4.9,12.5,0.9", "points.csv:4:1: ", "control", "use letters"},
    // Text that is none.
    {"latin1", "large", "gro\xDF", "points.csv:4:5: ", "byte 0xDF is not UTF-8", "save the file"},
    {"overlong_utf8", "large", "\xC0\xAF", "points.csv:4:2: ", "byte 0xC0", "save the file"},
    {"overlong_utf8_of_three", "large", "\xE0\x80\xAF", "points.csv:4:2: ", "byte 0xE0",
     "save the file"},
    {"utf8_cut_short", "large, coated\"", "\xE2\x82\"", "points.csv:4:2: ", "byte 0xE2",
     "save the file"},
    {"surrogate", "large", "\xED\xA0\x80", "points.csv:4:2: ", "byte 0xED", "save the file"},
    {"columns_count_characters", "large, coated\",4.9", "\xC3\xA4\xE2\x82\xAC\",x",
     "points.csv:4:6: ", "'x' is not a number", "such as"},
    {"carriage_returns_count_as_lines", "small,1.27,1.25,,,,20,20\n",
     "small,1.27,1.25,,,,20,20\rsmall,x,1,1,,,,\n", "points.csv:4:7: ", "'x'", "such as"},
};

INSTANTIATE_TEST_SUITE_P(Each, PointsMistake, testing::ValuesIn(points_mistakes), support::name_of);

TEST(PointsFile, EmptyOrWithoutPoints) {
  const std::string header = points.substr(0, points.find('\n') + 1);
  DatasetFolder(package, "")
      .expect({"", "", "", "points.csv:1:1: ", "the file is empty", "give it a header"});
  DatasetFolder(package, "\n \n\r\n")
      .expect({"", "", "", "points.csv:1:1: ", "the file is empty", "give it a header"});
  DatasetFolder(package, header)
      .expect({"", "", "", "points.csv:1:1: ", "no point below it", "one line for each point"});
  DatasetFolder(package, "\n" + header)
      .expect({"", "", "", "points.csv:2:1: ", "no point below it", "one line for each point"});
}

TEST(PointsFile, BinaryMissingOrHuge) {
  DatasetFolder(package, std::string("\x7f"
                                     "ELF\0\1",
                                     6))
      .expect({"", "", "", "points.csv: ", "not a text file", "UTF-8"});
  const DatasetFolder folder;
  fs::resize_file(folder.path() / "points.csv", 1ULL << 32);  // sparse
  folder.expect({"", "", "", "points.csv: ", "the file has 4294 MB", "split it"});
  fs::remove(folder.path() / "points.csv");
  folder.expect(
      {"", "", "", "datapackage.json:7:13: ", "there is no file 'points.csv'", "add the file"});
}

TEST(PointsFile, WhatTheSchemaOrTheOtherPointsExclude) {
  const std::string required = changed(package, R"("restitution_sd", "type": "number",)",
                                       R"("restitution_sd", "type": "number",
          "constraints": { "required": true },)");
  DatasetFolder(required, points)
      .expect({"", "", "", "points.csv:3:18: ", "'restitution_sd' is empty", "fill it in"});
  const std::string one_by_one =
      changed(package, R"("captured", "type": "integer")", R"("captured", "type": "boolean")");
  DatasetFolder(one_by_one, changed(points, "40,3", "40,true"))
      .expect({"", "", "", "points.csv:2:30: ", "true or false of a single impact", "\"integer\""});
  // a thousand times smaller than the middle one, 1.5 %
  DatasetFolder(package,
                changed(changed(points, "35,0.95,1.5", "35,0.95,1e-4"), "0.912,", "0.912,1.5"))
      .expect(
          {"", "", "", "points.csv:", "2.4e+03 times smaller than usual", "leave the cell empty"});
}

TEST(PointsFile, ReboundTooFast) {
  const std::string with_rebound =
      changed(package, R"("restitution", "type": "number", "unit": "1")",
              R"("rebound_velocity", "type": "number", "unit": "m/s")");
  const std::string rows = changed(points, "restitution", "rebound_velocity");
  DatasetFolder(with_rebound, changed(rows, "0.71", "3.01"))
      .expect({"", "", "", "points.csv:2:16: ", "rebound_velocity = 3.01 m/s", "incident"});
  EXPECT_FALSE(DatasetFolder(with_rebound, changed(rows, "0.71", "3.0")).error());
}

}  // namespace
}  // namespace example
