// Commands that write to a full, read-only or missing disk print one clear line, keep existing
// files whole, and leave no temporary files.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <map>
#include <thread>

#include "support/small_disk.hpp"
#include "support/started.hpp"

namespace {

namespace fs = std::filesystem;
using support::Outcome;
using support::SmallDisk;
using support::Started;
using Words = std::vector<std::string>;

constexpr const char* target = "place/disk/out";

const std::map<std::string, Words>& commands() {
  static const std::map<std::string, Words> all = {
      {"fit", {"fit", "fit.toml", "--out", target}},
      {"diagnose", {"diagnose", "fit.toml", "--out", target}},
      {"coverage",
       {"coverage", "fit.toml", "--datasets", "2", "--replicates", "9", "--out",
        std::string(target) + "/coverage.md"}},
      {"report", {"report", "fit.toml", "--replicates", "9", "--out", target}},
      {"export", {"export", "fit.toml", "--to", "openfoam", "--diameter", "4", "--out", target}},
      {"init",
       {"init", target, "--diameter", "4", "--particle",
        "material=polystyrene,density=1050,youngs_modulus=2.56e9,poisson_ratio=0.35", "--surface",
        "material=quartz,youngs_modulus=73e9,poisson_ratio=0.17"}},
      {"import",
       {"import", "my.csv", "--format", "csv", "--map", "incident_velocity=incident_velocity:m/s",
        "--into", target, "--like", "data", "--diameter", "4um", "--provenance", "measured"}},
      {"predict",
       {"predict", "fit.toml", "--sizes", "sizes.csv", "--height", "1", "--out", target}},
      {"simulate",
       {"simulate", "fit.toml", "--diameter", "4", "--velocity", "5", "--history",
        std::string(target) + "/history.csv"}},
      {"shard", {"fit", "fit.toml", "--shard", "1/2", "--out", target}},
      {"cluster", {"cluster", "parallel", "fit.toml", "--shards", "2", "--out", target}},
  };
  return all;
}

class Disk : public ::testing::TestWithParam<std::string> {
 protected:
  Disk() {
    disk_.change("fit.toml", "seed = 1\n", "seed = 1\nmaterials = false\n");  // faster
    disk_.write("my.csv", "incident_velocity,restitution\n5,0.8\n9,0.85\n20,0.9\n");
    disk_.write("sizes.csv", "diameter,count\n3,10\n4,20\n5,10\n");
  }

  const Words& command() const { return commands().at(GetParam()); }

  /// All files in the folder, with their contents.
  std::map<std::string, std::string> there() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(disk_ / "place/disk")) {
      if (entry.is_regular_file() && entry.path().filename() != "filler") {
        files[entry.path().string()] = support::text_of(entry.path());
      }
    }
    return files;
  }

  static void expect_one_line(const Outcome& told, const std::string& reason) {
    EXPECT_EQ(told.status, 2) << told.err;
    EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
    EXPECT_LT(told.err.size(), 300U) << told.err;
    EXPECT_NE(told.err.find(reason), std::string::npos) << told.err;
    EXPECT_NE(told.err.find("; "), std::string::npos) << "what to do: " << told.err;
  }

  SmallDisk disk_;
};

TEST_P(Disk, FullOneTakesNothingAndLosesNothing) {
  ASSERT_TRUE(disk_.is_mounted());
  disk_.fill();
  expect_one_line(disk_.run(command()), "No space left on device");
  EXPECT_TRUE(there().empty()) << there().begin()->first;
  disk_.empty();
  const Outcome done = disk_.run(command());
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_FALSE(there().empty());
}

TEST_P(Disk, OneThatFillsUpKeepsWhatWasThere) {
  const std::string& name = GetParam();
  ASSERT_TRUE(disk_.is_mounted());
  ASSERT_EQ(disk_.run(command()).status, 0);
  const auto before = there();
  disk_.fill();
  Words again = command();
  if (name == "shard") again[3] = "2/2";
  if (name == "report") again.push_back("--force");
  if (name == "import") again.push_back("--replace");
  // `init` writes into no folder that has something, on any disk.
  expect_one_line(disk_.run(again), name == "init" ? "already" : "No space left on device");
  EXPECT_EQ(there(), before);
}

TEST_P(Disk, ReadOnlyOneIsToldBeforeTheWork) {
  ASSERT_TRUE(disk_.is_mounted());
  disk_.be_writable(false);
  expect_one_line(disk_.run(command()), "Read-only file system");
  disk_.be_writable(true);
  EXPECT_EQ(disk_.run(command()).status, 0);
}

TEST_P(Disk, OneThatIsGoneIsTold) {
  ASSERT_TRUE(disk_.is_mounted());
  disk_.go_away();
  expect_one_line(disk_.run(command()), "Read-only file system");
  disk_.come_back();
  EXPECT_EQ(disk_.run(command()).status, 0);
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& [name, words] : commands()) all.push_back(name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Commands, Disk, ::testing::ValuesIn(names()),
                         [](const auto& named) { return named.param; });

/// Goes while a fit is at work, after it has begun to write.
TEST(DiskAtWork, OneThatGoesIsToldAndWhatIsOnItIsWhole) {
  SmallDisk disk;
  ASSERT_TRUE(disk.is_mounted());
  const Words command = {"fit",       "fit.toml", "--replicates", "200000",
                         "--threads", "2",        "--out",        target};
  const fs::path kept = disk / target / "unfinished-fit.json.jsonl";
  // Sooner and later, until it is well at work: on a slow machine it may still be reading.
  const auto stopped_after = [&](int milliseconds, const std::function<void()>& meanwhile) {
    Started run(command, disk.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    meanwhile();
    run.send(SIGTERM);
    return run.end();
  };
  int delay = 200;
  for (; delay < 20000 && !fs::exists(kept); delay *= 2) stopped_after(delay, [] {});
  ASSERT_TRUE(fs::exists(kept));
  const std::string before = support::text_of(kept);
  const Outcome told = stopped_after(delay, [&] { disk.go_away(); });
  EXPECT_EQ(told.status, 2);
  EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
  EXPECT_NE(told.err.find(
                "unfinished-fit.json.jsonl: the file cannot be written (Read-only file system)"),
            std::string::npos)
      << told.err;
  disk.come_back();
  EXPECT_EQ(support::text_of(kept), before);
}

TEST(DiskAtWork, AResultThatHasNoRoomIsPrintedAllTheSame) {
  const SmallDisk disk;
  ASSERT_TRUE(disk.is_mounted());
  for (const char* command : {"fit", "diagnose"}) {
    const Outcome whole = disk.run({command, "fit.toml", "--json"});
    ASSERT_EQ(disk.run({command, "fit.toml", "--out", target}).status, 0);
    disk.fill();  // there is room for a mark of no bytes, and for no result
    const Outcome told = disk.run({command, "fit.toml", "--json", "--out", target});
    EXPECT_EQ(told.status, 2);
    EXPECT_NE(told.err.find("No space left on device"), std::string::npos) << told.err;
    EXPECT_EQ(told.out, whole.out);
    disk.empty();
  }
}

TEST(DiskAtWork, AFullStandardOutputIsTold) {
  const SmallDisk disk;
  for (const std::string words :
       {"fit fit.toml", "diagnose fit.toml --json", "help fit", "materials"}) {
    const Outcome told = support::run_command(
        {"sh", "-c", "\"$0\" " + words + " >/dev/full", RECOIL_BINARY}, disk.path());
    EXPECT_EQ(told.status, 2) << told.err;
    EXPECT_EQ(told.err, "the output could not be written (standard output is full or closed)\n");
  }
}

}  // namespace
