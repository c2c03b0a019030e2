// Options that would do nothing, that are repeated, or that are empty, in every command.
#include "options/useless_options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "support/hostile_cases.hpp"
#include "support/workplace.hpp"

namespace recoil {
namespace {

using Values = std::map<std::string, std::vector<std::string>>;

bool is_refused(const std::string& command, const Values& values) {
  GivenOptions given(command);
  for (const auto& [name, words] : values) given.set(name, words);
  try {
    refuse_useless_options(given);
    return false;
  } catch (const InputError& error) {
    EXPECT_FALSE(error.suggestion().empty());
    return true;
  }
}

TEST(UselessOptions, AreRefusedBesideWhatMakesThemUseless) {
  struct Case {
    std::string command, option;
    std::vector<std::string> value;
    Values useless, useful;
  };
  for (const Case& one : std::vector<Case>{
           {"import",
            "--axis",
            {"x=log,1,2"},
            {{"--format", {"heights"}}},
            {{"--format", {"webplotdigitizer"}}}},
           {"import", "--sd-of", {"one"}, {{"--format", {"heights"}}}, {{"--format", {"csv"}}}},
           {"import", "--gravity", {"1.6"}, {{"--format", {"csv"}}}, {{"--format", {"track"}}}},
           {"import", "--fps", {"9"}, {{"--format", {"csv"}}}, {{"--format", {"track"}}}},
           {"bounce", "--fps", {"9"}, {{"--format", {"heights"}}}, {{"--format", {"track"}}}},
           {"init", "--sheet", {"a"}, {}, {{"--points", {"p.xlsx"}}}},
           {"init", "--provenance", {"digitised"}, {}, {{"--points", {"p.csv"}}}},
           {"fit", "--scheme", {"wild"}, {{"--replicates", {"0"}}}, {{"--replicates", {"99"}}}},
           {"fit", "--scheme", {"wild"}, {{"--replicates", {"0"}}}, {}},
           {"export", "--stock", {}, {{"--to", {"table"}}}, {{"--to", {"yade"}}}},
           {"export", "--replicates", {"50"}, {{"--to", {"yade"}}}, {{"--to", {"table"}}}},
           {"export",
            "--replicates",
            {"50"},
            {{"--to", {"table"}}, {"--parameters", {"fit.json"}}},
            {{"--to", {"table"}}}},
           {"export", "--seed", {"5"}, {{"--to", {"lammps"}}}, {{"--to", {"table"}}}},
           {"pair", "--provenance", {"measured"}, {{"--out", {"p.csv"}}}, {{"--into", {"d"}}}},
           {"pair", "--replace", {}, {}, {{"--out", {"p.csv"}}}},
           {"plan", "--replace", {}, {}, {{"--out", {"d"}}}},
           {"merge", "--threads", {"2"}, {{"--missing", {}}}, {}},
           {"cluster",
            "--time",
            {"01:00:00"},
            {{"SYSTEM", {"parallel"}}},
            {{"SYSTEM", {"slurm"}}}}}) {
    for (const bool useless : {true, false}) {
      Values values = useless ? one.useless : one.useful;
      values[one.option] = one.value;
      EXPECT_EQ(is_refused(one.command, values), useless) << one.command << " " << one.option;
    }
  }
}

/// Options that are in no list of any row do something with their defaults.
TEST(UselessOptions, NoOptionIsRefusedAloneWithoutAReason) {
  const std::vector<std::string_view> conditional = {"init",   "pair",   "plan",   "bounce",
                                                     "import", "export", "cluster"};
  for (const OptionRow& row : option_rows()) {
    const std::string commands(row.commands);
    if (commands.find(' ') != std::string::npos) continue;
    if (std::ranges::find(conditional, commands) != conditional.end()) continue;
    EXPECT_FALSE(is_refused(commands, {{std::string(row.name), {"1"}}})) << row.name;
  }
}

/// Every option of every command: an empty value, and one given twice.
TEST(EveryOption, IsRefusedWhenItIsEmptyOrRepeated) {
  const support::Workplace place;
  for (const OptionRow& row : option_rows()) {
    if (row.type.is_flag() || row.is_argument()) continue;
    const std::string name(row.name);
    EXPECT_NE(expected_instead(row.type, ""), "") << name;
    support::count_hostile_cases();
    if (row.type.most > 1) continue;
    std::istringstream commands{std::string(row.commands)};
    for (std::string command; commands >> command;) {
      const support::Outcome twice = place.run({command, name, "1", name, "1"});
      EXPECT_EQ(twice.status, 2) << command << " " << name << twice.out;
      support::count_hostile_cases();
    }
  }
}

}  // namespace
}  // namespace recoil
