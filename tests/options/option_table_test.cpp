// The table of options: few options, each described once, each default one that its option takes.
#include "options/option_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <sstream>
#include <string>

namespace recoil {
namespace {

std::vector<std::string> words_of(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// Every option costs a reader of the help and the manual a line, and everybody who changes the
/// program a case to think of. At 124 a second reader found too many. A new option that goes beyond
/// the limit takes the place of one that is needed less.
TEST(OptionTable, HasAtMost110Options) {
  std::size_t of_commands = 0;
  for (const OptionRow& row : option_rows()) of_commands += words_of(row.commands).size();
  std::cout << option_rows().size() << " rows, " << of_commands << " options of all commands\n";
  EXPECT_LE(option_rows().size(), 110U);
  EXPECT_GT(option_rows().size(), 50U) << "the table itself seems broken";
}

TEST(OptionTable, ACommandHasEveryOptionOnce) {
  std::set<std::string> commands;
  std::set<std::string> functions;
  for (const OptionRow& row : option_rows()) {
    for (const std::string& command : words_of(row.commands)) commands.insert(command);
    for (const std::string& function : words_of(row.functions)) functions.insert(function);
    EXPECT_EQ(row.functions.empty(), row.python.empty()) << row.name;
  }
  for (const std::string& command : commands) {
    std::set<std::string_view> names;
    for (const OptionRow* row : options_of(command)) {
      EXPECT_TRUE(names.insert(row->name).second) << command << " " << row->name;
    }
  }
  for (const std::string& function : functions) {
    std::set<std::string_view> names;
    for (const OptionRow* row : arguments_of(function)) {
      EXPECT_TRUE(names.insert(row->python).second) << function << " " << row->python;
    }
  }
}

TEST(OptionTable, EveryDefaultIsAccepted) {
  for (const OptionRow& row : option_rows()) {
    if (row.default_text().empty()) continue;
    EXPECT_EQ(expected_instead(row.type, std::string(row.standard)), "") << row.name;
  }
}

TEST(OptionTable, EveryMeaningIsAPhrase) {
  for (const OptionRow& row : option_rows()) {
    if (row.is_hidden()) continue;
    EXPECT_GE(row.meaning.size(), 5U) << row.name;
    EXPECT_NE(row.meaning.back(), '.') << row.name;
  }
}

TEST(OptionType, ANumberHasItsUnitOrAnother) {
  const OptionType height = takes::quantity(Dimension::length, "mm", 0.5, 1000.0);
  for (const char* good : {"1", "1.5mm", "1.5 mm", " 8e2um ", "100 cm", "1m", "+2"}) {
    EXPECT_EQ(expected_instead(height, good), "") << good;
  }
  for (const char* wrong :
       {"", "mm", "1 kg", "1 mm/s", "0.4", "101 cm", "nan", "inf mm", "1,5", "1 mm 2"}) {
    EXPECT_NE(expected_instead(height, wrong).find("a number from 0.5 to 1000 mm"),
              std::string::npos)
        << wrong;
  }
  EXPECT_DOUBLE_EQ(number_of(height, "20"), 0.02);
  EXPECT_DOUBLE_EQ(number_of(height, "20um"), 2e-5);
  EXPECT_DOUBLE_EQ(number_of(height, "100 cm"), 1.0);
  EXPECT_DOUBLE_EQ(number_of(takes::number(0.0, 1.0), "5%"), 0.05);
}

TEST(OptionType, AWholeNumberIsDecimal) {
  const OptionType seed = takes::whole(0, 0x1p63);
  for (const char* good : {"010", "08", "9223372036854775807", "0"}) {
    EXPECT_EQ(expected_instead(seed, good), "") << good;
  }
  for (const char* wrong : {"-1", "1.5", "1e3", "0x10", "9223372036854775808", "", "ten"}) {
    EXPECT_EQ(expected_instead(seed, wrong), "a whole number from 0") << wrong;
  }
  const OptionType replicates = takes::or_word(takes::whole(0, 1000000), "auto");
  EXPECT_EQ(expected_instead(replicates, "auto"), "");
  EXPECT_EQ(expected_instead(replicates, "many"), "a whole number from 0 to 1000000, or auto");
}

TEST(OptionType, TextsAreNotEmpty) {
  EXPECT_NE(expected_instead(takes::text("NAME"), ""), "");
  EXPECT_NE(expected_instead(takes::one_of({"one", "mean"}), ""), "");
  EXPECT_EQ(expected_instead(takes::one_of({"one", "mean"}), "both"), "one of one, mean");
}

}  // namespace
}  // namespace recoil
