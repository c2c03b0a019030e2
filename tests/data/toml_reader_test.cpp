#include "data/toml_reader.hpp"

#include <gtest/gtest.h>

#include <string>

#include "support/mistake.hpp"

namespace recoil {
namespace {

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

std::optional<InputError> error_of(const std::string& text) {
  return support::error_of([&] { TomlReader("f.toml").parse(text); });
}

void expect_at_line(int line, const std::string& text) {
  const auto error = error_of(text);
  ASSERT_TRUE(error) << text.substr(0, 40);
  EXPECT_EQ(error->where().file, "f.toml");
  EXPECT_EQ(error->where().line, line);
}

// Tables that are nested 40,000 times cannot even be destroyed without overflowing the stack.
TEST(TomlReader, RefusesWhatIsNestedTooDeeply) {
  const std::string key = "a" + repeated(".a", 40000);
  expect_at_line(2, "x = 1\n" + key + " = 1\n");
  expect_at_line(1, "[" + key + "]\n");
  expect_at_line(1, "[[" + key + "]]\n");
  expect_at_line(1, "x = { " + key + " = 1 }\n");
  expect_at_line(2, "x = \"a\"\n\"a\"" + repeated(".'b' ", 40000) + " = 1\n");
  expect_at_line(1, "x = " + repeated("[", 40000) + repeated("]", 40000) + "\n");
  expect_at_line(1, "x = " + repeated("{ a = ", 40000) + "1" + repeated(" }", 40000) + "\n");
}

TEST(TomlReader, CountsNoDotsOfStringsCommentsAndNumbers) {
  const std::string dots = repeated(".", 100);
  EXPECT_FALSE(error_of("# " + dots + "\n[a.b.c]\nx = \"" + dots + "\"  # " + dots));
  EXPECT_FALSE(error_of("y = '" + dots + "\\'\nz = \"\\\"" + dots + "\"\n"));
  EXPECT_FALSE(error_of("x = \"\"\"" + dots + "\n\"" + dots + "\"\"\"\n"));
  EXPECT_FALSE(error_of("x = [" + repeated("0.5, ", 100) + "]\n"));
}

}  // namespace
}  // namespace recoil
