// Completion and man pages, as the shells and man themselves take them.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/command.hpp"
#include "support/workplace.hpp"

namespace {

using support::Outcome;
using support::Workplace;

TEST(HelpPages, SayWhereALinkLeads) {
  const Outcome page = Workplace().run({"help", "data"});
  EXPECT_EQ(page.status, 0) << page.err;
  EXPECT_NE(page.out.find("(https://specs.frictionlessdata.io/data-package/)"), std::string::npos)
      << page.out;
}

std::string script_for(const Workplace& place, const std::string& shell) {
  const Outcome made = place.run({"help", "--completion", shell});
  EXPECT_EQ(made.status, 0) << made.err;
  place.write("complete." + shell, made.out);
  return made.out;
}

/// What bash offers for the last of `words`.
std::string offered(const Workplace& place, const std::string& words) {
  const Outcome run = support::run_command(
      {"bash", "-c",
       "source complete.bash; COMP_WORDS=(" + words +
           "); COMP_CWORD=$((${#COMP_WORDS[@]}-1)); _recoil; echo \"${COMPREPLY[*]}\""},
      place.path());
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  return run.out;
}

TEST(Completion, BashOffersCommandsOptionsAndTheirWords) {
  const Workplace place;
  script_for(place, "bash");
  EXPECT_EQ(offered(place, "recoil expo"), "export\n");
  EXPECT_EQ(offered(place, "recoil export --vel"), "--velocity\n");
  EXPECT_EQ(offered(place, "recoil export --to l"), "lammps liggghts\n");
  EXPECT_EQ(offered(place, "recoil fit fit."), "fit.toml\n");
  EXPECT_EQ(offered(place, "recoil check --to l"), "\n");  // not an option of check
}

TEST(Completion, EveryShellReadsItsScript) {
  const Workplace place;
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const std::string text = script_for(place, shell);
    EXPECT_NE(text.find("liggghts"), std::string::npos) << shell;
    const Outcome read =
        support::run_command({shell, "-n", std::string("complete.") + shell}, place.path());
    EXPECT_EQ(read.status, 0) << shell << read.err;
  }
}

TEST(Completion, FishOffersTheWordsOfAnOption) {
  const Workplace place;
  script_for(place, "fish");
  const Outcome run = support::run_command(
      {"fish", "--no-config", "-c", "source complete.fish; complete -C 'recoil export --to li'"},
      place.path());
  EXPECT_EQ(run.out.rfind("liggghts", 0), 0U) << run.out << run.err;
}

TEST(Man, EveryCommandHasAPageThatGroffTakesWithoutAWarning) {
  const Workplace place;
  ASSERT_EQ(place.run({"help", "--man", "man"}).status, 0);
  int pages = 0;
  for (const auto& entry : std::filesystem::directory_iterator(place / "man")) {
    const Outcome shown = support::run_command(
        {"groff", "-man", "-Tutf8", "-ww", entry.path().string()}, place.path());
    EXPECT_EQ(shown.status, 0);
    EXPECT_EQ(shown.err, "") << entry.path();
    EXPECT_GT(shown.out.size(), 200U) << entry.path();
    ++pages;
  }
  EXPECT_GE(pages, 14);
  const std::string page = place.read("man/recoil-export.1");
  EXPECT_NE(page.find("lammps|liggghts"), std::string::npos);
}

}  // namespace
