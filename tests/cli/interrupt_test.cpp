// Ctrl-C during a bootstrap keeps the finished replicates. The same command continues, and the
// result equals that of an uninterrupted run.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "support/workplace.hpp"

namespace {

namespace fs = std::filesystem;
using support::Outcome;
using support::Workplace;

/// Starts the command in `place` with both outputs in files of that folder.
pid_t start(const Workplace& place, std::vector<std::string> words) {
  const pid_t child = fork();
  if (child != 0) return child;
  std::string binary = RECOIL_BINARY;
  std::vector<char*> argv = {binary.data()};
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  if (chdir(place.path().c_str()) != 0) _exit(127);
  dup2(open("/dev/null", O_RDONLY), 0);
  dup2(open("out.txt", O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
  dup2(open("err.txt", O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
  std::signal(SIGINT, SIG_DFL);  // a test run in the background would hand down "ignore"
  execv(binary.c_str(), argv.data());
  _exit(127);
}

/// Runs the command and stops it by `signal` after `delay`; the status as waitpid gives it.
int stopped_after(const Workplace& place, const std::vector<std::string>& words,
                  std::chrono::milliseconds delay, int signal) {
  const pid_t child = start(place, words);
  std::this_thread::sleep_for(delay);
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

/// A file of rows: a head, and one line for each.
std::size_t kept_replicates(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::size_t lines = 0;
  while (std::getline(in, line)) ++lines;
  return lines == 0 ? 0 : lines - 1;
}

/// Starts a fit with very many replicates and stops it by SIGINT during its bootstrap. Retries if a
/// slow machine has not reached the bootstrap.
int stopped_long_fit(const Workplace& place, const std::string& out) {
  int status = 0;
  for (int delay = 500; delay < 40000; delay *= 2) {
    status = stopped_after(
        place, {"fit", "fit.toml", "--out", out, "--replicates", "1000000", "--threads", "2"},
        std::chrono::milliseconds(delay), SIGINT);
    if (kept_replicates(place.path() / out / "unfinished-fit.json.jsonl") > 10) break;
  }
  return status;
}

TEST(Interrupt, KeepsFinishedReplicatesAndEndsAsTheSignalWould) {
  const Workplace place;
  const int status = stopped_long_fit(place, "out");
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGINT);
  EXPECT_EQ(place.read("out.txt"), "");
  const std::string complaint = place.read("err.txt");
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
  const std::vector<std::string> command = {"fit",       "fit.toml", "--replicates", "1999",
                                            "--threads", "1",        "--out"};
  std::vector<std::string> whole = command;
  whole.push_back("whole");
  ASSERT_EQ(place.run(whole).status, 0);
  std::vector<std::string> broken = command;
  broken.push_back("broken");
  // Stop it twice, each time a little later, or until it gets through.
  int stops = 0;
  std::size_t most_kept = 0;
  for (int delay = 60; stops < 2 && !fs::exists(place.path() / "broken/fit.json") && delay < 30000;
       delay = delay * 3 / 2) {
    const int status = stopped_after(place, broken, std::chrono::milliseconds(delay), SIGTERM);
    const fs::path kept = place.path() / "broken/unfinished-fit.json.jsonl";
    if (!WIFSIGNALED(status) || !fs::exists(kept)) continue;
    ++stops;
    EXPECT_GE(kept_replicates(kept), most_kept) << "finished replicates were lost";
    most_kept = kept_replicates(kept);
  }
  EXPECT_GE(stops, 1);
  ASSERT_EQ(place.run(broken).status, 0);
  EXPECT_EQ(place.read("broken/fit.json"), place.read("whole/fit.json"));
  EXPECT_FALSE(fs::exists(place.path() / "broken/unfinished-fit.json.jsonl"));
}

TEST(Interrupt, WhatAnotherRunLeftIsNotMistakenForOurs) {
  const Workplace place;
  const int status = stopped_long_fit(place, "out");
  ASSERT_TRUE(WIFSIGNALED(status));
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
