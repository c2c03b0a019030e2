// Ctrl-C during a bootstrap keeps the finished replicates. The same command continues, and the
// result equals that of an uninterrupted run.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/started.hpp"
#include "support/workplace.hpp"

namespace {

namespace fs = std::filesystem;
using support::Outcome;
using support::Started;
using support::Workplace;

struct Ended {
  int signal;  ///< that ended it; 0: it ended by itself
  Outcome outcome;
};

/// A file of rows: a head, and one line for each.
std::size_t kept_replicates(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::size_t lines = 0;
  while (std::getline(in, line)) ++lines;
  return lines == 0 ? 0 : lines - 1;
}

/// Stops `command` by `signal` when its file `kept` has more than `rows` rows.
Ended stopped(const Workplace& place, const std::vector<std::string>& command, const fs::path& kept,
              std::size_t rows, int signal) {
  Started run(command, place.path());
  run.wait_until([&] { return kept_replicates(kept) > rows; });
  run.send(signal);
  const Outcome outcome = run.end();
  return {run.signal(), outcome};
}

/// A fit with very many replicates, stopped by SIGINT during its bootstrap.
Ended stopped_long_fit(const Workplace& place, const std::string& out) {
  return stopped(place,
                 {"fit", "fit.toml", "--out", out, "--replicates", "1000000", "--threads", "2"},
                 place / out / "unfinished-fit.json.jsonl", 10, SIGINT);
}

TEST(Interrupt, KeepsFinishedReplicatesAndEndsAsTheSignalWould) {
  const Workplace place;
  const auto [signal, outcome] = stopped_long_fit(place, "out");
  EXPECT_EQ(signal, SIGINT);
  EXPECT_EQ(outcome.out, "");
  const std::string& complaint = outcome.err;
  EXPECT_NE(complaint.find("the same command continues"), std::string::npos) << complaint;
  const std::size_t kept = kept_replicates(place.path() / "out/unfinished-fit.json.jsonl");
  EXPECT_GT(kept, 10U);
  EXPECT_LT(kept, 1000000U);
  // Only complete files exist.
  for (const std::string& name : place.listing()) {
    EXPECT_EQ(name.find(".part"), std::string::npos) << name;
  }
  EXPECT_FALSE(fs::exists(place.path() / "out/fit.json"));
}

TEST(Interrupt, TheNextRunGoesOnAndNoByteTellsOfIt) {
  const Workplace place;
  const std::vector<std::string> command = {"fit",       "fit.toml", "--replicates", "9999",
                                            "--threads", "1",        "--out"};
  std::vector<std::string> whole = command;
  whole.push_back("whole");
  ASSERT_EQ(place.run(whole).status, 0);
  std::vector<std::string> broken = command;
  broken.push_back("broken");
  const fs::path kept = place / "broken/unfinished-fit.json.jsonl";
  std::size_t most_kept = 0;
  for (int stop = 0; stop < 2; ++stop) {
    ASSERT_EQ(stopped(place, broken, kept, most_kept, SIGTERM).signal, SIGTERM);
    EXPECT_GT(kept_replicates(kept), most_kept) << "finished replicates were lost";
    most_kept = kept_replicates(kept);
  }
  ASSERT_EQ(place.run(broken).status, 0);
  EXPECT_EQ(place.read("broken/fit.json"), place.read("whole/fit.json"));
  EXPECT_FALSE(fs::exists(place.path() / "broken/unfinished-fit.json.jsonl"));
}

TEST(Interrupt, WhatAnotherRunLeftIsNotMistakenForOurs) {
  const Workplace place;
  ASSERT_EQ(stopped_long_fit(place, "out").signal, SIGINT);
  ASSERT_TRUE(fs::exists(place.path() / "out/unfinished-fit.json.jsonl"));
  const std::vector<std::string> other = {"--replicates", "39", "--seed", "7"};
  std::vector<std::string> here = {"fit", "fit.toml", "--out", "out"};
  std::vector<std::string> fresh = {"fit", "fit.toml", "--out", "fresh"};
  here.insert(here.end(), other.begin(), other.end());
  fresh.insert(fresh.end(), other.begin(), other.end());
  ASSERT_EQ(place.run(here).status, 0);
  ASSERT_EQ(place.run(fresh).status, 0);
  EXPECT_EQ(place.read("out/fit.json"), place.read("fresh/fit.json"));
}

TEST(Scheme, TheCommandLineAndTheFitFileChoose) {
  const Workplace place;
  ASSERT_EQ(
      place.run({"fit", "fit.toml", "--out", "a", "--scheme", "wild", "--replicates", "39"}).status,
      0);
  place.change("fit.toml", "replicates = 39", "replicates = 39\nscheme = \"case\"");
  ASSERT_EQ(place.run({"fit", "fit.toml", "--out", "b"}).status, 0);
  const auto a = nlohmann::json::parse(place.read("a/fit.json"));
  const auto b = nlohmann::json::parse(place.read("b/fit.json"));
  EXPECT_EQ(a["bootstrap"]["scheme"], "wild");
  EXPECT_EQ(b["bootstrap"]["scheme"], "case");
  EXPECT_EQ(a["parameters"]["C_A"]["value"], b["parameters"]["C_A"]["value"]);
  EXPECT_TRUE(a["parameters"]["C_A"]["intervals_mc_error"]["percentile"].is_array());
  EXPECT_TRUE(a["parameters"]["C_A"]["intervals_mc_error"]["wald"].is_null());
}

TEST(Scheme, MistakesAreAnsweredInOneLine) {
  const Workplace place;
  EXPECT_EQ(place.run({"fit", "fit.toml", "--scheme", "jackknife"}).status, 2);
  EXPECT_EQ(place.run({"fit", "fit.toml", "--replicates", "many"}).status, 2);
  place.change("data/points.csv", "small,2,1.6", "large,2,1.6");
  place.change("data/points.csv", "small,2,2.4", "large,2,2.4");
  place.change("data/points.csv", "small,2,5", "large,2,5");
  place.change("data/points.csv", "small,2,25", "large,2,25");
  const Outcome one = place.run({"fit", "fit.toml", "--scheme", "cluster"});
  EXPECT_EQ(one.status, 2);
  EXPECT_NE(one.err.find("one series"), std::string::npos) << one.err;
}

TEST(Replicates, AutomaticSaysHowManyItTook) {
  const Workplace place;
  place.change("fit.toml", "replicates = 39", "replicates = \"auto\"");
  ASSERT_EQ(place.run({"fit", "fit.toml", "--out", "a", "--threads", "1"}).status, 0);
  ASSERT_EQ(place.run({"fit", "fit.toml", "--out", "b", "--threads", "3"}).status, 0);
  EXPECT_EQ(place.read("a/fit.json"), place.read("b/fit.json"));
  const auto fit = nlohmann::json::parse(place.read("a/fit.json"));
  EXPECT_EQ(fit["options"]["replicates"], "auto");
  EXPECT_GE(fit["bootstrap"]["replicates"].get<int>(), 999);
  if (fit["bootstrap"]["replicates"].get<int>() < 19999) {
    EXPECT_LE(fit["bootstrap"]["mc_error_of_width"].get<double>(), 0.02);
  }
}

}  // namespace
