// A fit of every kind goes through every command.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "made_fits.hpp"
#include "support/command.hpp"

namespace {

using pairs::MadeFit;
using support::Outcome;
using support::TemporaryFolder;
using Words = std::vector<std::string>;

/// Kinds of fits, and the commands that have no answer for them.
const std::map<std::string, std::set<std::string>> unanswered = {
    {"all_captured", {"plan", "export"}},  // captures alone determine no parameter
    {"one_point", {"plan", "export"}}};    // one velocity is no range

const std::vector<std::string> targets = {"lammps",   "liggghts", "yade",
                                          "openfoam", "fluent",   "table"};

/// Text for people: no number is missing, and one thing is not called several.
void expect_sound_words(std::string text, const std::string& where) {
  const std::regex script("<script[^]*?</script>|<style[^]*?</style>");
  text = std::regex_replace(text, script, "");
  const std::regex wrong(
      "\\b(-?nan|inf)\\b|"
      "(^|[ >(])1 (points|impacts|settings|replicates|spheres|sizes|diameters|data sets|datasets|"
      "parameters|fits|rebounds|captures|events|series have|rows|starts|mechanisms|velocities)\\b",
      std::regex::icase);
  std::smatch found;
  for (int k = 0; k < 3 && std::regex_search(text, found, wrong); ++k) {
    const auto begin = std::max<std::ptrdiff_t>(0, found.position() - 60);
    ADD_FAILURE() << where << ": ..." << text.substr(static_cast<std::size_t>(begin), 150);
    text = found.suffix();
  }
}

class AllCommands : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new TemporaryFolder;
    setenv("COLUMNS", "80", 1);
    for (const MadeFit& fit : pairs::write_made_fits(*place_)) run_all(fit);
  }
  static void TearDownTestSuite() { delete place_; }

  static Outcome run(const MadeFit& fit, const Words& words) {
    Outcome outcome = support::run_recoil(words, *place_ / fit.name);
    runs_.push_back({fit.name, words, outcome});
    return outcome;
  }
  /// Keeps what a command prints as a file, to be compared with `schema`.
  static void run_json(const MadeFit& fit, const std::string& schema, Words words) {
    words.push_back("--json");
    const Outcome outcome = run(fit, words);
    const std::string file = fit.name + "/" + schema + ".json";
    if (outcome.status == 0) place_->write(file, outcome.out);
  }

  static void run_all(const MadeFit& fit) {
    const std::string diameter = fmt::format("{:.6g}", fit.diameter * 1e6);
    for (const std::string& id : fit.datasets) run(fit, {"check", id});
    run_json(fit, "plan", {"plan", "fit.toml", "--impacts", "200"});
    run(fit, {"plan", "fit.toml", "--error", "0.2"});
    run_json(fit, "simulate",
             {"simulate", "fit.toml", "--velocity", fmt::format("{}", fit.velocity), "--diameter",
              diameter});
    if (!fit.quick) return;
    run(fit, {"fit", "fit.toml", "--verbose", "--threads", "1", "--out", "."});
    run(fit, {"fit", "fit.toml", "--replicates", "0", "--threads", "1"});
    run(fit, {"figure", "fit.toml", "--replicates", "0", "--out", "figure.svg"});
    run_json(fit, "compare", {"compare", "fit.json", "fit.json"});
    for (const std::string& target : targets) {
      run(fit, {"export", "fit.toml", "--to", target, "--parameters", "fit.json", "--out", target});
    }
    place_->write(fit.name + "/sizes.csv", "diameter,count\n" + diameter + ",1\n");
    run_json(fit, "predict", {"predict", "fit.toml", "--sizes", "sizes.csv", "--replicates", "0"});
    run_json(fit, "coverage",
             {"coverage", "fit.toml", "--datasets", "2", "--replicates", "0", "--threads", "1"});
    run(fit, {"coverage", "fit.toml", "--datasets", "2", "--replicates", "0", "--threads", "1"});
    run(fit, {"simulate", "fit.toml", "--velocity", fmt::format("{}", fit.velocity), "--diameter",
              diameter});
    run_json(fit, "diagnosis", {"diagnose", "fit.toml", "--threads", "1", "--out", "diagnosed"});
    run(fit, {"report", "fit.toml", "--threads", "1", "--replicates", "0", "--out", "pages"});
  }

  struct Run {
    std::string fit;
    Words words;
    Outcome outcome;
    std::string name() const { return fmt::format("{}: {}", fit, fmt::join(words, " ")); }
  };
  inline static TemporaryFolder* place_ = nullptr;
  inline static std::vector<Run> runs_;
};

TEST_F(AllCommands, EndWithAnAnswerOrAReasonInOneLine) {
  for (const Run& run : runs_) {
    const auto found = unanswered.find(run.fit);
    const bool has_none = found != unanswered.end() && found->second.contains(run.words.front());
    const Outcome& outcome = run.outcome;
    if (!has_none) {
      EXPECT_EQ(outcome.status, 0) << run.name() << "\n" << outcome.err;
      continue;
    }
    EXPECT_TRUE(outcome.status == 2 || outcome.status == 3) << run.name() << outcome.status;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

TEST_F(AllCommands, PrintSoundWords) {
  for (const Run& run : runs_) {
    const bool json = run.words.back() == "--json";
    if (!json) expect_sound_words(run.outcome.out, run.name());
    expect_sound_words(run.outcome.err, run.name());
  }
  for (const std::string& name : place_->listing()) {
    if (!name.ends_with(".html") && !name.ends_with(".md")) continue;
    expect_sound_words(place_->read(name), name);
  }
}

// 80 columns and two screens of 25 lines; --verbose and --json have more.
TEST_F(AllCommands, PrintWhatFitsOnATerminal) {
  constexpr std::ptrdiff_t widest = 80, most_lines = 50;
  for (const Run& run : runs_) {
    if (run.words.back() == "--json" || run.outcome.status != 0) continue;
    const std::string& text = run.outcome.out;
    const bool verbose = std::ranges::find(run.words, "--verbose") != run.words.end();
    if (!verbose) {
      EXPECT_LE(std::ranges::count(text, '\n'), most_lines) << run.name() << text;
    }
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      const auto letters = std::ranges::count_if(line, [](char c) { return (c & 0xC0) != 0x80; });
      EXPECT_LE(letters, widest) << run.name() << "\n" << line;
    }
    EXPECT_EQ(text.find("|---"), std::string::npos) << run.name();
  }
}

TEST_F(AllCommands, WriteJsonThatFitsItsSchema) {
  const std::string script =
      "import json, jsonschema, pathlib, sys\n"
      "count = 0\n"
      "for file in sorted(pathlib.Path('.').glob('*/*.json')):\n"
      "    schema = pathlib.Path(sys.argv[1], f'{file.stem}.schema.json')\n"
      "    check = jsonschema.Draft202012Validator(json.loads(schema.read_text()))\n"
      "    for error in check.iter_errors(json.loads(file.read_text())):\n"
      "        print(file, list(error.absolute_path), error.message[:200])\n"
      "    count += 1\n"
      "print(count, file=sys.stderr)\n";
  const Outcome checked =
      support::run_command({"python3", "-c", script, RECOIL_SOURCE_DIR "/schemas"}, place_->path());
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_EQ(checked.out, "");
  EXPECT_GE(std::stoi(checked.err), 60);
}

/// The parser of each format accepts what is written for it.
TEST_F(AllCommands, ExportWhatItsReaderAccepts) {
  const std::string stand_ins = RECOIL_SOURCE_DIR "/tests/export/";
  const std::regex keyword("^ *[a-z_]+( |$)");
  int read = 0;
  for (const std::string& name : place_->listing()) {
    const std::filesystem::path file(name);
    const auto accepts = [&](Words words) {
      words.push_back(name);
      const Outcome outcome = support::run_command(words, place_->path());
      EXPECT_EQ(outcome.status, 0) << name << "\n" << outcome.out << outcome.err;
      ++read;
    };
    if (file.filename() == "impact.py") {
      accepts({"python3", "-m", "py_compile"});
    } else if (file.filename() == "recoil_rebound.c") {
      accepts({"gcc", "-std=c89", "-fsyntax-only", "-Wall", "-Wextra", "-Wno-unused-parameter",
               "-Werror", "-I" + stand_ins + "fluent"});
    } else if (file.filename() == "recoilRebound.C") {
      accepts({"g++", "-std=c++11", "-fsyntax-only", "-Wall", "-Wextra", "-Werror",
               "-I" + stand_ins + "openfoam"});
    } else if (file.parent_path().filename() == "table" && file.extension() == ".csv") {
      accepts({"python3", "-c",
               "import csv, math, sys\n"
               "rows = list(csv.reader(open(sys.argv[1])))\n"
               "assert all(len(row) == len(rows[0]) for row in rows)\n"
               "assert all(math.isfinite(float(c)) for row in rows[1:] for c in row if c)\n"});
    } else if (file.filename() == "impact.lammps" || file.filename() == "impact.liggghts") {
      std::istringstream lines(place_->read(name));
      bool continued = false;
      for (std::string line; std::getline(lines, line);) {
        const bool blank = line.empty() || line.front() == '#';
        EXPECT_TRUE(blank || continued || std::regex_search(line, keyword)) << name << ": " << line;
        continued = line.ends_with("&");
      }
      ++read;
    }
  }
  EXPECT_GE(read, 50);
}

}  // namespace
