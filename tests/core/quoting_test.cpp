// Hostile names in every language, by running what was written.
#include "core/quoting.hpp"

#include <gtest/gtest.h>

#include "support/command.hpp"
#include "support/hostile_names.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

using support::hostile_names;
using support::Outcome;
using support::run_command;

class Quoting : public ::testing::Test {
 protected:
  ~Quoting() override { EXPECT_FALSE(folder_.has("PWNED")); }

  /// What Python makes of the words after its script, with bytes as os.fsencode gives them.
  Outcome python(const std::string& script, std::vector<std::string> words) const {
    folder_.write("script.py", script);
    words.insert(words.begin(), {"python3", "script.py"});
    return run_command(words, folder_.path());
  }

  support::TemporaryFolder folder_;
};

TEST_F(Quoting, AShellReadsOneWord) {
  std::string script;
  std::string names;
  for (const std::string& name : hostile_names()) {
    script += "printf '%s\\0' " + shell_word(name) + "\n";
    names += name + '\0';
  }
  folder_.write("script.sh", script);
  const Outcome ran = run_command({"sh", "script.sh"}, folder_.path());
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.out, names);
}

TEST_F(Quoting, AnAddressLeadsToTheFileBesideThePage) {
  const std::string script =
      "import os, sys, urllib.parse as u\n"
      "for path, name in zip(sys.argv[1::2], sys.argv[2::2], strict=True):\n"
      "    to = u.urlsplit(u.urljoin('file:///base/index.html', path))\n"
      "    assert to.scheme == 'file' and not to.query and not to.fragment, to\n"
      "    assert u.unquote_to_bytes(to.path) == b'/base/' + os.fsencode(name), to\n";
  std::vector<std::string> words;
  for (const std::string& name : hostile_names()) words.insert(words.end(), {url_path(name), name});
  const Outcome ran = python(script, words);
  EXPECT_EQ(ran.status, 0) << ran.err;
}

TEST_F(Quoting, ATerminalIsToldNothing) {
  const std::string script =
      "import sys, unicodedata\n"
      "for name in sys.argv[1:]:\n"
      "    assert not [c for c in name if unicodedata.category(c) in ('Cc', 'Cs')], name\n";
  std::vector<std::string> words;
  for (const std::string& name : hostile_names()) words.push_back(printable(name));
  const Outcome ran = python(script, words);
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(printable("a\tb\nc\r", true), "a\tb\nc ");
  EXPECT_EQ(printable("ünï – ☃"), "ünï – ☃");
  // every character that UAX #9 or Unicode's lines know: none turns the letters behind it around
  for (const char* mark : {"\u061C", "\u200E", "\u200F", "\u2028", "\u2029", "\u202A", "\u202B",
                           "\u202C", "\u202D", "\u202E", "\u2066", "\u2067", "\u2068", "\u2069"}) {
    EXPECT_EQ(printable(std::string("a") + mark + "b", true), "a b");
  }
  EXPECT_EQ(printable("\u2027\u202F\u2065\u206A"), "\u2027\u202F\u2065\u206A");
}

// The first and the last sequence of each length, and what RFC 3629 excludes: overlong forms,
// surrogates, what lies beyond U+10FFFF, and sequences that end too early.
TEST(Utf8, HasTheLimitsOfRfc3629) {
  for (const std::string text :
       {"a", "\x7f", "\xc2\x80", "\xdf\xbf", "\xe0\xa0\x80", "\xed\x9f\xbf", "\xee\x80\x80",
        "\xef\xbf\xbf", "\xf0\x90\x80\x80", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_EQ(utf8_length(text, 0), text.size()) << text;
    EXPECT_EQ(utf8_length("a" + text + "b", 1), text.size()) << text;
  }
  for (const std::string text :
       {"\x80", "\xbf", "\xc0\x80", "\xc1\xbf", "\xe0\x9f\xbf", "\xed\xa0\x80", "\xf0\x8f\xbf\xbf",
        "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff", "\xc3", "\xe2\x98", "\xe2\x98\x41",
        "\xe2\x41\x83", "\xf0\x90\x80\x41"}) {
    EXPECT_EQ(utf8_length(text, 0), 0U) << text;
  }
}

/// All names, each in a comment of its own.
std::string comments(const std::string& mark, const std::string& end = "\n") {
  std::string text;
  for (const std::string& name : hostile_names()) text += mark + comment_text(name) + end;
  return text;
}

TEST_F(Quoting, PythonReadsComments) {
  const Outcome all = python(comments("# ") + "print('ran')\n", {});
  EXPECT_EQ(all.out, "ran\n") << all.err;
  for (const std::string& name : hostile_names()) {  // as the first line, which may state a coding
    const Outcome one = python("# " + comment_text(name) + "\nprint('ran')\n", {});
    EXPECT_EQ(one.out, "ran\n") << name << one.err;
  }
}

TEST_F(Quoting, CAndItsDescendantsReadComments) {
  const std::string body = "#include <stdio.h>\nint main(void) { return puts(\"ran\") < 0; }\n";
  folder_.write("lines.cpp", comments("// ") + body);
  folder_.write("block.c", comments("/* ", " */\n") + body);
  for (const std::vector<std::string>& compiler : std::vector<std::vector<std::string>>{
           {"g++", "-std=c++11", "-trigraphs", "-Werror", "-Wall", "lines.cpp"},
           {"gcc", "-std=c99", "-trigraphs", "-Werror", "-Wall", "block.c"}}) {
    const Outcome built = run_command(compiler, folder_.path());
    EXPECT_EQ(built.status, 0) << built.err;
    EXPECT_EQ(run_command({"./a.out"}, folder_.path()).out, "ran\n");
  }
}

// LAMMPS joins a line that ends in & to the next one, and reads on to the next """ whatever a #
// says (Input::file in its input.cpp). ./run engines runs it with such names.
TEST_F(Quoting, NothingInACommentSpansLinesInLammps) {
  for (const std::string& name : hostile_names()) {
    const std::string comment = comment_text(name);
    EXPECT_EQ(comment.find_first_of("&\"\n\r"), std::string::npos) << comment;
  }
}

}  // namespace
}  // namespace recoil
