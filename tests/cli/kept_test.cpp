// Long commands that are stopped or killed keep their finished work. The same command continues,
// and its results equal those of an uninterrupted run.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "support/started.hpp"
#include "support/workplace.hpp"

namespace {

namespace fs = std::filesystem;
using support::Outcome;
using support::Started;
using support::with;
using support::Words;
using support::Workplace;

/// Points that the model cannot follow, so that all mechanisms and their pairs are tried.
void spoil(const Workplace& place) {
  place.change("data/points.csv", "4,1.4,0.825", "4,1.4,0.625");
  place.change("data/points.csv", "4,5,0.937", "4,5,0.737");
  place.change("data/points.csv", "4,25,0.933", "4,25,0.633");
}

std::size_t rows_in(const fs::path& file) {
  const std::string text = support::text_of(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) - 1;
}

/// Stops `command` by `signal`, sooner and later, until `file` holds something of it.
Outcome stopped(const Workplace& place, const Words& command, const fs::path& file, int signal) {
  Outcome ended;
  const auto nothing_yet = [&file] { return !fs::exists(file) || rows_in(file) == 0; };
  for (int delay = 100; delay < 20000 && nothing_yet(); delay = delay * 3 / 2) {
    Started run(command, place.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(delay));
    run.send(signal);
    ended = run.end();
    if (ended.status == 0) break;
  }
  return ended;
}

struct LongCommand {
  Words words;                     ///< but for --out
  std::string out;                 ///< in a folder
  std::string kept;                ///< in that folder
  std::vector<std::string> files;  ///< there, at the end
};

const LongCommand diagnosis = {{"diagnose", "fit.toml", "--seed", "3", "--threads", "1"},
                               "",
                               "unfinished-diagnosis.json.jsonl",
                               {"diagnosis.json", "diagnosis.html", "extended.toml"}};
const LongCommand coverage = {
    {"coverage", "fit.toml", "--datasets", "60", "--replicates", "39", "--threads", "1"},
    "coverage.md",
    "unfinished-coverage.md.jsonl",
    {"coverage.md"}};

void expect_no_trace(const LongCommand& command) {
  const Workplace place;
  spoil(place);
  const auto to = [&](const std::string& folder) {
    return with(command.words, {"--out", (fs::path(folder) / command.out).string()});
  };
  fs::create_directory(place / "whole");
  const Outcome whole = place.run(to("whole"));
  ASSERT_EQ(whole.status, 0) << whole.err;
  fs::create_directory(place / "broken");
  const fs::path kept = place / "broken" / command.kept;
  const Outcome first = stopped(place, to("broken"), kept, SIGTERM);
  ASSERT_EQ(first.status, 128 + SIGTERM) << first.err;
  EXPECT_EQ(first.out, "");
  EXPECT_NE(first.err.find("the same command continues"), std::string::npos) << first.err;
  ASSERT_TRUE(fs::exists(kept));
  const std::size_t rows = rows_in(kept);
  EXPECT_GT(rows, 0U);
  {  // a killed run leaves existing files unchanged
    Started run(to("broken"), place.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    run.send(SIGKILL);
    ASSERT_EQ(run.end().status, 128 + SIGKILL);
    EXPECT_EQ(rows_in(kept), rows);
  }
  const Outcome last = place.run(to("broken"));
  ASSERT_EQ(last.status, 0) << last.err;
  EXPECT_EQ(last.out, whole.out);
  for (const std::string& name : command.files) {
    EXPECT_EQ(place.read(fs::path("broken") / name), place.read(fs::path("whole") / name)) << name;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(place / "broken"), {}),
            static_cast<std::ptrdiff_t>(command.files.size()))
      << "nothing that was kept stays, and no lock";
}

TEST(Kept, ADiagnosisGoesOnAndNoByteTellsOfIt) { expect_no_trace(diagnosis); }

TEST(Kept, CoverageGoesOnAndNoByteTellsOfIt) { expect_no_trace(coverage); }

TEST(Kept, ADiagnosisEndsSoonAfterTheSignal) {
  const Workplace place;
  spoil(place);
  Started run(with(diagnosis.words, {"--out", "out"}), place.path());
  ASSERT_TRUE(run.wait_until([&] { return fs::exists(place / "out/diagnosis.json.lock"); }));
  ASSERT_TRUE(run.wait_until_it_catches(SIGINT));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // well at work
  const auto sent = std::chrono::steady_clock::now();
  run.send(SIGINT);
  const Outcome ended = run.end();
  EXPECT_EQ(ended.status, 128 + SIGINT);
  EXPECT_EQ(ended.err.find("stopped: "), 0U) << ended.err;
  EXPECT_LT(std::chrono::steady_clock::now() - sent, std::chrono::seconds(5));
}

TEST(Kept, OtherOptionsBeginAnew) {
  const Workplace place;
  spoil(place);
  const fs::path kept = place / "out" / diagnosis.kept;
  stopped(place, with(diagnosis.words, {"--out", "out"}), kept, SIGINT);
  ASSERT_TRUE(fs::exists(kept));
  const Words other = {"diagnose", "fit.toml", "--seed", "4"};
  ASSERT_EQ(place.run(with(other, {"--out", "out"})).status, 0);
  ASSERT_EQ(place.run(with(other, {"--out", "fresh"})).status, 0);
  EXPECT_EQ(place.read("out/diagnosis.json"), place.read("fresh/diagnosis.json"));
}

TEST(Kept, TwoWithTheSameFolderAreOneTooMany) {
  const Workplace place;
  const Words command = {"fit", "fit.toml", "--replicates", "300000", "--out", "out"};
  Started first(command, place.path());
  ASSERT_TRUE(first.wait_until([&] { return fs::exists(place / "out/fit.json.lock"); }));
  // The mark is there a moment before its words.
  ASSERT_TRUE(first.wait_until([&] { return !place.read("out/fit.json.lock").empty(); }));
  const Outcome second = place.run({"fit", "fit.toml", "--out", "out"});
  EXPECT_EQ(second.status, 2);
  EXPECT_EQ(second.out, "");
  EXPECT_EQ(
      second.err.find("out/fit.json: another recoil process is writing this result (process "), 0U)
      << second.err;
  EXPECT_EQ(std::count(second.err.begin(), second.err.end(), '\n'), 1) << second.err;
  EXPECT_EQ(place.run({"fit", "fit.toml", "--out", "other"}).status, 0);
  EXPECT_EQ(place.run({"diagnose", "fit.toml", "--out", "out"}).status, 0) << "another result";
  ASSERT_TRUE(first.runs()) << "it ended before the others; nothing was tried";
  first.send(SIGTERM);
  EXPECT_EQ(first.end().status, 128 + SIGTERM);
  EXPECT_TRUE(place.has("out/unfinished-fit.json.jsonl")) << "what it had is there";
  EXPECT_FALSE(place.has("out/fit.json.lock"));
  EXPECT_EQ(place.run({"fit", "fit.toml", "--out", "out"}).status, 0);
}

}  // namespace
