#include "document/terminal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace recoil {
namespace {

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto characters = std::count_if(line.begin(), line.end(), [](char c) {
      return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    });
    longest = std::max(longest, static_cast<std::size_t>(characters));
  }
  return longest;
}

Table small_table() {
  Table table;
  table.columns = {{"parameter"}, {"estimate", "s/m"}, {"never said"}, {"remark", "", true}};
  table.rows = {{symbol("C_H"), Number{0.0031, significant(2)}, {}, "fine"},
                {symbol("C_A"), Number{12.25, fixed(2)}, {}, {}}};
  return table;
}

TEST(Terminal, WrapCountsCharactersAndKeepsThemWhole) {
  EXPECT_EQ(wrap("one two three", 9, 2), "one two\n  three");
  EXPECT_EQ(wrap("µµµµ", 2, 0), "µµ\nµµ");
  EXPECT_EQ(wrap("  spaced \n out ", 80, 0), "spaced out");
  EXPECT_EQ(wrap("", 80, 4), "");
}

TEST(Terminal, AWordWithoutBlanksIsCutInATimeInProportionToItsLength) {
  // Counting the rest of the text for every line would take 6e11 steps.
  constexpr std::size_t letters = 10'000'000;
  const std::string text = wrap(std::string(letters, 'x'), 80, 0);
  EXPECT_EQ(text.size(), letters + letters / 80 - 1);
  EXPECT_EQ(text.substr(0, 82), std::string(80, 'x') + "\nx");
  EXPECT_EQ(wrap("ab µµµµµ cd", 4, 1), "ab\n µµµ\n µµ\n cd");
}

TEST(Terminal, AlignsNumbersRightAndWordsLeftAndDropsSilentColumns) {
  EXPECT_EQ(terminal_text(small_table(), 2),
            "  parameter  estimate [s/m]  remark\n"
            "  C_H                0.0031  fine\n"
            "  C_A                 12.25  -\n");
}

TEST(Terminal, NamesAndValuesStandInPairs) {
  EXPECT_EQ(terminal_text(items({{"chi-square", Number{34.5}}, {"p-value", "none"}}), 2),
            "  chi-square         = 34.5\n"
            "  p-value            = none\n");
  EXPECT_LE(longest_line(terminal_text(items({{std::string(150, 'x'), std::string(150, 'y')}}))),
            terminal_columns);
}

TEST(Terminal, BreaksWordsOfATableIntoLines) {
  Table table = small_table();
  std::string remark;
  for (int i = 0; i < 40; ++i) remark += "word ";
  table.rows[0][3] = remark;
  const std::string text = terminal_text(table, 4, 100);
  EXPECT_LE(longest_line(text), 100U);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 4 + 1);
}

TEST(Terminal, DividesATableThatIsTooWideRepeatingTheFirstColumn) {
  Table table;
  table.columns = {{"name"}};
  table.rows = {{"a dataset with a very long name that nobody would like to read twice"}};
  for (int i = 0; i < 15; ++i) {
    table.columns.push_back({"quantity", "um"});
    table.rows[0].emplace_back(Number{1234567.0 + i, fixed(0)});
  }
  const std::string text = terminal_text(table);
  EXPECT_LE(longest_line(text), terminal_columns);
  for (int i = 0; i < 15; ++i) {
    EXPECT_NE(text.find(std::to_string(1234567 + i)), std::string::npos) << i;
  }
}

TEST(Terminal, StaysNarrowWhateverTheWordsAre) {
  Table table = small_table();
  table.rows[0][0] = std::string(300, 'x');
  table.rows[0][1] = Sentence(std::string(300, 'y'));
  table.rows[1][3] = Sentence(std::string(300, 'z'));
  table.caption = std::string(300, 'c');
  Section section{"id", std::string(200, 't'), std::string(200, 'r')};
  section.blocks = {table, Paragraph{std::string(500, 'p')}, List{{std::string(300, 'l')}}};
  EXPECT_LE(longest_line(terminal_text(section)), terminal_columns) << terminal_text(section);
}

TEST(Terminal, ASectionIsABlockWithItsNameInBrackets) {
  Section section{"fit", "Fit", "of two"};
  section.blocks = {Paragraph{say("{C_H} is known.")}, List{{"one", "two"}},
                    Banner{"digitised", "From a figure."},
                    Figures{{{"x", "x", "caption", "<svg/>"}}}, Paragraph{}};
  EXPECT_EQ(terminal_text(section),
            "[[Fit]] of two\n    C_H is known.\n    - one\n    - two\n"
            "    digitised: From a figure.\n");
  EXPECT_EQ(terminal_text(Section{"empty", "Empty", "", {Table{}, List{}}}), "");
}

}  // namespace
}  // namespace recoil
