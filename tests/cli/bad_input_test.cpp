// A mistake of the user causes one clear line, exit status 2, and no file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "support/hostile_cases.hpp"
#include "support/workplace.hpp"

namespace {

namespace fs = std::filesystem;
using support::Outcome;
using support::Workplace;

/// Checks the form of an error message, and that nothing was written.
void expect_refusal(const Outcome& run, const std::vector<std::string>& words) {
  support::count_hostile_cases();
  EXPECT_EQ(run.status, 2) << "stdout: " << run.out << "\nstderr: " << run.err;
  EXPECT_EQ(run.out, "") << "nothing belongs on stdout";
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_TRUE(!run.err.empty() && run.err.back() == '\n') << run.err;
  EXPECT_LT(run.err.size(), 500U) << "a line that nobody reads to its end:\n" << run.err;
  for (const std::string& word : words) {
    EXPECT_NE(run.err.find(word), std::string::npos)
        << "the message should say '" << word << "', but is: " << run.err;
  }
}

/// A mistake in a file, and the words that the message must contain.
struct FileMistake {
  std::string name;
  std::function<void(const Workplace&)> make;
  std::vector<std::string> words;
  bool in_dataset = true;  ///< so that `recoil check` must refuse it as well
};

void PrintTo(const FileMistake& mistake, std::ostream* stream) { *stream << mistake.name; }

/// Replaces text in a file.
std::function<void(const Workplace&)> change(const std::string& file, const std::string& old_text,
                                             const std::string& new_text) {
  return [=](const Workplace& place) { place.change(file, old_text, new_text); };
}

/// Replaces a whole file.
std::function<void(const Workplace&)> write(const std::string& file, const std::string& text) {
  return [=](const Workplace& place) { place.write(file, text); };
}

const std::string kPoints = "data/points.csv";
const std::string kPackage = "data/datapackage.json";
const std::string kFit = "fit.toml";

const std::vector<FileMistake>& file_mistakes() {
  static const std::vector<FileMistake> mistakes = {
      // points.csv
      {"points_empty", write(kPoints, ""), {"points.csv", "empty"}},
      {"points_only_header",
       write(kPoints,
             "series,diameter,incident_velocity,restitution,restitution_sd,events,captured\n"),
       {"points.csv"}},
      {"points_missing",
       [](const Workplace& p) { fs::remove(p.path() / kPoints); },
       {"points.csv"}},
      {"points_missing_column",
       change(kPoints, "incident_velocity", "speed"),
       {"points.csv:1", "speed"}},
      {"points_column_gone",
       write(kPoints,
             "series,diameter,restitution,restitution_sd,events,captured\n"
             "small,2,0.651,0.015,20,0\n"),
       {"points.csv:1", "incident_velocity"}},
      {"points_repeated_column",
       change(kPoints, "events,captured", "events,events"),
       {"points.csv:1", "events"}},
      {"points_negative_diameter",
       change(kPoints, "small,2,2.4", "small,-2,2.4"),
       {"points.csv:3:7", "diameter"}},
      {"points_zero_velocity",
       change(kPoints, "2,2.4,", "2,0,"),
       {"points.csv:3:9", "incident_velocity"}},
      {"points_nan", change(kPoints, "0.651", "nan"), {"points.csv:3:13", "nan"}},
      {"points_infinite", change(kPoints, "25,0.900", "inf,0.900"), {"points.csv:5:9", "inf"}},
      {"points_restitution_too_large",
       change(kPoints, "0.651", "1.21"),
       {"points.csv:3:13", "1.21", "1.2"}},
      {"points_restitution_negative", change(kPoints, "0.651", "-0.1"), {"points.csv:3:13"}},
      {"points_not_a_number", change(kPoints, "0.651", "0,651"), {"points.csv:3"}},
      {"points_word", change(kPoints, "0.651", "high"), {"points.csv:3:13", "high"}},
      {"points_short_row", change(kPoints, "5,0.842,0.015,20,0", "5,0.842"), {"points.csv:4"}},
      {"points_more_captured_than_events",
       change(kPoints, "0.015,20,20", "0.015,20,21"),
       {"points.csv:2", "captured"}},
      {"points_open_quote", change(kPoints, "small,2,2.4", "\"small,2,2.4"), {"points.csv:"}},
      {"points_binary",
       write(kPoints, std::string("\x7f"
                                  "ELF\x02\x01\x01\0\0\0\0",
                                  11)),
       {"points.csv"}},
      {"points_latin1", change(kPoints, "large", "gro\xdf"), {"points.csv:6", "UTF-8"}},
      {"points_one_endless_line", write(kPoints, std::string(1'000'000, 'a')), {"points.csv"}},
      {"points_huge",
       [](const Workplace& p) { fs::resize_file(p.path() / kPoints, 3ULL << 30U); },
       {"points.csv"}},
      // datapackage.json
      {"package_empty", write(kPackage, ""), {"datapackage.json", "empty"}},
      {"package_missing",
       [](const Workplace& p) { fs::remove(p.path() / kPackage); },
       {"datapackage.json"}},
      {"package_not_json", change(kPackage, "\"title\":", "\"title\""), {"datapackage.json:3"}},
      {"package_unknown_unit",
       change(kPackage, "\"um\"", "\"furlong\""),
       {"datapackage.json:11", "furlong", "um"}},
      {"package_unit_of_something_else",
       change(kPackage, "\"m/s\"", "\"um\""),
       {"datapackage.json:12", "um"}},
      {"package_without_unit",
       change(kPackage, ", \"unit\": \"um\"", ""),
       {"datapackage.json:11", "unit"}},
      {"package_missing_field",
       change(kPackage, "{ \"name\": \"diameter\", \"type\": \"number\", \"unit\": \"um\" },", ""),
       {"diameter"}},
      {"package_repeated_field",
       change(kPackage, "\"restitution_sd\"", "\"restitution\""),
       {"datapackage.json:14", "restitution"}},
      {"package_unknown_provenance",
       change(kPackage, "\"synthetic\"", "\"guessed\""),
       {"datapackage.json:22", "guessed"}},
      {"package_negative_modulus",
       change(kPackage, "2.56e9", "-2.56e9"),
       {"datapackage.json:24", "youngs_modulus"}},
      {"package_modulus_in_GPa",
       change(kPackage, "2.56e9", "2.56"),
       {"datapackage.json:24", "youngs_modulus"}},
      {"package_poisson_ratio",
       change(kPackage, "0.35", "0.53"),
       {"datapackage.json:24", "poisson_ratio"}},
      {"package_points_elsewhere",
       change(kPackage, "points.csv", "../points.csv"),
       {"datapackage.json:7"}},
      {"package_mistyped_key",
       change(kPackage, "\"density\"", "\"densitty\""),
       {"datapackage.json:24", "densitty", "density"}},
      // fit.toml
      {"fit_empty", write(kFit, ""), {"fit.toml", "dataset"}, false},
      {"fit_binary", write(kFit, std::string("data\0set", 8)), {"fit.toml"}, false},
      {"fit_not_toml", change(kFit, "[model]", "[model"), {"fit.toml:2"}, false},
      {"fit_unknown_key",
       change(kFit, "replicates", "replicats"),
       {"fit.toml:9", "replicats", "replicates"},
       false},
      {"fit_unknown_table",
       change(kFit, "[uncertainty]", "[uncertanty]"),
       {"fit.toml:8", "uncertainty"},
       false},
      {"fit_unknown_parameter", change(kFit, "C_H", "C_h"), {"fit.toml:5", "C_h", "C_H"}, false},
      {"fit_unknown_parameter_key",
       change(kFit, "bounds = [0, 10]", "bound = [0, 10]"),
       {"fit.toml:6", "bounds"},
       false},
      {"fit_unknown_phase",
       change(kFit, "\"rebound\"", "\"rebounds\""),
       {"fit.toml:3", "phase", "rebound"},
       false},
      {"fit_bounds_reversed", change(kFit, "[0, 10]", "[10, 0]"), {"fit.toml:6", "C_A"}, false},
      {"fit_bounds_negative", change(kFit, "[0, 10]", "[-1, 10]"), {"fit.toml:6"}, false},
      {"fit_bounds_one_number", change(kFit, "[0, 10]", "[10]"), {"fit.toml:6"}, false},
      {"fit_start_outside", change(kFit, "3e-2", "30"), {"fit.toml:6", "30"}, false},
      {"fit_start_nan", change(kFit, "3e-2", "nan"), {"fit.toml:6"}, false},
      {"fit_start_word", change(kFit, "3e-2", "\"much\""), {"fit.toml:6"}, false},
      {"fit_own_design_in_quotes",
       change(kFit, "own_design = false", "own_design = \"false\""),
       {"fit.toml:12", "is a text, not true, false or a whole number", "own_design = false"},
       false},
      {"fit_repeated_key", change(kFit, "seed = 1", "level = 0.9"), {"fit.toml:11"}, false},
      {"fit_level", change(kFit, "0.95", "95"), {"fit.toml:10", "level"}, false},
      {"fit_replicates_negative", change(kFit, "39", "-39"), {"fit.toml:9"}, false},
      {"fit_seed_fraction", change(kFit, "seed = 1", "seed = 1.5"), {"fit.toml:11"}, false},
      {"fit_unknown_mechanism",
       change(kFit, "[parameters]", "mechanisms = [\"magic\"]\n[parameters]"),
       {"fit.toml:4", "magic"},
       false},
      {"fit_dataset_missing",
       change(kFit, "\"data\"", "\"no-such-folder\""),
       {"no-such-folder"},
       false},
      {"fit_dataset_number", change(kFit, "\"data\"", "7"), {"fit.toml:1"}, false},
      {"fit_dataset_empty_list", change(kFit, "\"data\"", "[]"), {"fit.toml:1"}, false},
      {"fit_dataset_twice",
       change(kFit, "\"data\"", "[\"data\", \"data\"]"),
       {"fit.toml:1"},
       false},
  };
  return mistakes;
}

class BadFile : public testing::TestWithParam<FileMistake> {};

TEST_P(BadFile, IsOneLineAndStatusTwo) {
  const FileMistake& mistake = GetParam();
  const Workplace place;
  mistake.make(place);
  const std::vector<std::string> before = place.listing();
  if (mistake.in_dataset) expect_refusal(place.run({"check", "data"}), mistake.words);
  expect_refusal(place.run({"fit", "fit.toml", "--out", "result"}), mistake.words);
  expect_refusal(place.run({"report", "fit.toml"}), mistake.words);
  EXPECT_EQ(place.listing(), before) << "something was written";
}

std::string mistake_name(const testing::TestParamInfo<FileMistake>& info) {
  return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(Mistakes, BadFile, testing::ValuesIn(file_mistakes()), mistake_name);

/// A mistake on the command line.
struct LineMistake {
  std::string name;
  std::vector<std::string> arguments;
  std::vector<std::string> words;
};

void PrintTo(const LineMistake& mistake, std::ostream* stream) { *stream << mistake.name; }

class BadCommandLine : public testing::TestWithParam<LineMistake> {};

TEST_P(BadCommandLine, IsOneLineAndStatusTwo) {
  const Workplace place;
  const std::vector<std::string> before = place.listing();
  expect_refusal(place.run(GetParam().arguments), GetParam().words);
  EXPECT_EQ(place.listing(), before) << "something was written";
}

std::vector<std::string> simulate(const std::string& velocity, const std::string& diameter) {
  return {"simulate", "fit.toml", "--velocity", velocity, "--diameter", diameter};
}

const std::vector<LineMistake>& line_mistakes() {
  static const std::vector<LineMistake> mistakes = {
      {"unknown_command", {"fitt", "fit.toml"}, {"fitt", "fit"}},
      {"unknown_option", {"fit", "fit.toml", "--replicats", "99"}, {"--replicats"}},
      {"unknown_option_of_check", {"check", "data", "--loud"}, {"--loud"}},
      {"no_operand", {"fit"}, {"FIT"}},
      {"too_many_operands", {"check", "data", "data"}, {"data"}},
      {"option_without_value", {"fit", "fit.toml", "--seed"}, {"--seed"}},
      {"fit_not_there", {"fit", "no-such.toml", "--out", "result"}, {"no-such.toml"}},
      {"fit_is_a_folder", {"fit", "data", "--out", "result"}, {"data"}},
      {"dataset_not_there", {"check", "no-such"}, {"no-such"}},
      {"dataset_is_a_file", {"check", "fit.toml"}, {"fit.toml"}},
      {"replicates_word",
       {"fit", "fit.toml", "--out", "result", "--replicates", "many"},
       {"--replicates", "many"}},
      {"replicates_negative",
       {"fit", "fit.toml", "--out", "result", "--replicates", "-5"},
       {"--replicates"}},
      {"seed_negative", {"fit", "fit.toml", "--out", "result", "--seed", "-1"}, {"--seed"}},
      {"threads_negative",
       {"fit", "fit.toml", "--out", "result", "--threads", "-2"},
       {"--threads"}},
      {"out_is_a_file",
       {"fit", "fit.toml", "--replicates", "99", "--out", "fit.toml"},
       {"fit.toml"}},
      {"velocity_negative", simulate("-1", "4"), {"--velocity"}},
      {"velocity_nan", simulate("nan", "4"), {"--velocity"}},
      {"velocity_infinite", simulate("inf", "4"), {"--velocity"}},
      {"diameter_zero", simulate("2", "0"), {"--diameter"}},
      {"diameter_missing", {"simulate", "fit.toml", "--velocity", "2"}, {"--diameter"}},
      {"coverage_none", {"coverage", "fit.toml", "--datasets", "0"}, {"--datasets"}},
  };
  return mistakes;
}

std::string line_mistake_name(const testing::TestParamInfo<LineMistake>& info) {
  return info.param.name;
}
INSTANTIATE_TEST_SUITE_P(Mistakes, BadCommandLine, testing::ValuesIn(line_mistakes()),
                         line_mistake_name);

TEST(BadInput, TheExampleItselfIsGood) {
  const Workplace place;
  EXPECT_EQ(place.run({"check", "data"}).status, 0);
  const Outcome run = place.run({"fit", "fit.toml", "--out", "result"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(fs::is_regular_file(place.path() / "result/fit.json"));
  EXPECT_EQ(place.run(simulate("2", "4")).status, 0);
}

TEST(BadInput, ARestitutionALittleAboveOneIsKeptWithAWarning) {
  const Workplace place;
  place.change(kPoints, "0.937", "1.13");
  const Outcome run = place.run({"check", "data"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE((run.out + run.err).find("above 1"), std::string::npos) << run.out << run.err;
}

TEST(BadInput, AnEarlierResultSurvivesAMistake) {
  const Workplace place;
  place.write("result/fit.json", "an earlier result\n");
  place.change(kFit, "replicates", "replicats");
  EXPECT_EQ(place.run({"fit", "fit.toml", "--out", "result"}).status, 2);
  EXPECT_EQ(place.read("result/fit.json"), "an earlier result\n");
}

TEST(BadInput, ControlCharactersOfAFileNeverReachTheTerminal) {
  const Workplace place;
  place.change(kPoints, "0.651", "\x1b[31mred");
  const Outcome run = place.run({"check", "data"});
  expect_refusal(run, {"points.csv:3"});
  EXPECT_EQ(run.err.find('\x1b'), std::string::npos);
}

}  // namespace
