// A command in several shards gives the same bytes as one process, for any number of shards and
// after interruptions. Parts that do not belong together are not merged.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "support/workplace.hpp"

namespace {

namespace fs = std::filesystem;
using support::Outcome;
using support::with;
using support::Words;
using support::Workplace;

std::string shard(int number, int of) { return std::to_string(number) + "/" + std::to_string(of); }

/// Runs shards `numbers` of `of` into `folder`.
void run_shards(const Workplace& place, const Words& command, const std::vector<int>& numbers,
                int of, const std::string& folder) {
  for (const int number : numbers) {
    const Outcome part =
        place.run(with(command, {"--shard", shard(number, of), "--out", folder, "--threads", "1"}));
    ASSERT_EQ(part.status, 0) << part.err;
  }
}

std::vector<std::string> files_in(const Workplace& place, const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(place.path() / folder)) {
    names.push_back(entry.path().filename().string());
  }
  return names;
}

std::size_t parts_in(const Workplace& place, const std::string& folder) {
  std::size_t count = 0;
  for (const std::string& name : files_in(place, folder))
    count += name.starts_with("part-") ? 1U : 0U;
  return count;
}

/// Replaces the rows of a part, with a head that matches the new rows.
void put_rows(const Workplace& place, const std::string& part, const std::string& rows) {
  const std::string text = place.read(part);
  auto head = nlohmann::ordered_json::parse(text.substr(0, text.find('\n')));
  head.erase("sha256");
  head["bytes"] = rows.size();
  place.write("rows", head.dump() + "\n" + rows);
  const Outcome sum = support::run_command({"sha256sum", (place / "rows").string()}, place.path());
  head["sha256"] = sum.out.substr(0, sum.out.find(' '));
  place.write(part, head.dump() + "\n" + rows);
}

const Words fit = {"fit", "fit.toml"};
const Words coverage = {"coverage", "fit.toml", "--datasets", "7", "--replicates", "9"};

TEST(Shards, AnyNumberOfThemGivesTheBytesOfOneFit) {
  const Workplace place;
  const Words few = with(fit, {"--replicates", "9"});
  const Outcome whole = place.run(with(few, {"--out", "whole"}));
  ASSERT_EQ(whole.status, 0) << whole.err;
  for (const int of : {1, 3, 11}) {  // two of the eleven shards have no piece
    const std::string folder = "parts-" + std::to_string(of);
    std::vector<int> backwards;
    for (int number = of; number >= 1; --number) backwards.push_back(number);
    run_shards(place, few, backwards, of, folder);
    const Outcome merged = place.run({"merge", folder});
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(merged.out, whole.out);
    EXPECT_EQ(place.read(folder + "/fit.json"), place.read("whole/fit.json"));
  }
}

TEST(Shards, TheReplicatesComeFromThePartsAndNotFromTheMerge) {
  const Workplace place;
  run_shards(place, fit, {1, 2}, 2, "parts");
  // A mark in a replicate shows in the result.
  ASSERT_EQ(place.run({"merge", "parts"}).status, 0);
  const std::string honest = place.read("parts/fit.json");
  for (const std::string& name : files_in(place, "parts")) {
    if (!name.starts_with("part-1-")) continue;
    const std::string text = place.read("parts/" + name);
    std::string rows = text.substr(text.find('\n') + 1);
    ASSERT_TRUE(rows.starts_with("[0,["));
    rows.insert(4, "1");  // theta[0]: ten times and more
    put_rows(place, "parts/" + name, rows);
  }
  ASSERT_EQ(place.run({"merge", "parts"}).status, 0);
  EXPECT_NE(place.read("parts/fit.json"), honest);
}

TEST(Shards, AnAlteredPartIsRefusedAndOneCutShortIsMissing) {
  const Workplace place;
  for (const Words& command : {fit, coverage}) {
    const std::string folder = command.front();
    run_shards(place, command, {1, 2}, 2, folder);
    const Outcome honest = place.run({"merge", folder});
    ASSERT_EQ(honest.status, 0) << honest.err;
    for (const std::string& name : files_in(place, folder)) {
      if (!name.starts_with("part-2-")) continue;
      const std::string part = (fs::path(folder) / name).string();
      const std::string whole = place.read(part);
      std::string altered = whole;
      const std::size_t digit = altered.find_last_of("12345678");
      ++altered[digit];
      place.write(part, altered);
      const Outcome refused = place.run({"merge", folder});
      EXPECT_EQ(refused.status, 2);
      EXPECT_EQ(refused.out, "");
      EXPECT_NE(refused.err.find("its rows have been changed (their SHA-256 differs from that in "
                                 "the first line); remove it, and run shard "
                                 "2/2 again\n"),
                std::string::npos)
          << refused.err;
      place.write(part, whole.substr(0, whole.size() - 30));
      EXPECT_EQ(place.run({"merge", folder, "--missing"}).out, "--array=2\n");
      EXPECT_EQ(place.run({"merge", folder}).status, 3);
      run_shards(place, command, {2}, 2, folder);
      EXPECT_EQ(place.read(part), whole) << "the shard takes no part that is cut for its own";
    }
    EXPECT_EQ(place.run({"merge", folder}).out, honest.out);
  }
}

TEST(Shards, CoverageGivesTheBytesOfOneProcess) {
  const Workplace place;
  for (const Words& options : {Words{}, Words{"--json", "--seed", "3"}}) {
    const Words command = with(coverage, options);
    const std::string folder = "parts" + std::to_string(options.size());
    const Outcome whole = place.run(with(command, {"--out", "whole.md"}));
    ASSERT_EQ(whole.status, 0) << whole.err;
    run_shards(place, command, {2, 3, 1}, 3, folder);
    const Outcome merged = place.run({"merge", folder, "--threads", "2"});
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(merged.out, whole.out);
    EXPECT_EQ(place.read(folder + "/coverage.md"), place.read("whole.md"));
  }
}

TEST(Shards, TheOrderOfOptionsIsNoDifferenceAndThePlaceNeither) {
  const Workplace place;
  ASSERT_EQ(place
                .run({"fit", "fit.toml", "--seed", "4", "--replicates", "9", "--shard", "1/2",
                      "--out", "parts"})
                .status,
            0);
  ASSERT_EQ(place
                .run({"fit", "--threads", "2", "--shard", "2/2", "--replicates=9", "fit.toml",
                      "--out", (place.path() / "parts").string(), "--seed", "4"})
                .status,
            0);
  ASSERT_EQ(
      place.run({"fit", "fit.toml", "--seed", "4", "--replicates", "9", "--out", "whole"}).status,
      0);
  const Outcome merged = support::run_recoil({"merge", (place.path() / "parts").string()}, "/");
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_EQ(place.read("parts/fit.json"), place.read("whole/fit.json"));
}

TEST(Shards, WhatIsMissingIsToldAndNothingIsWritten) {
  const Workplace place;
  run_shards(place, fit, {2, 4}, 6, "parts");
  const Outcome told = place.run({"merge", "parts"});
  EXPECT_EQ(told.status, 3);
  EXPECT_EQ(told.out, "");
  EXPECT_NE(told.err.find("4 of 6 shards are missing; run them again: --array=1,3,5-6\n"),
            std::string::npos)
      << told.err;
  EXPECT_EQ(place.run({"merge", "parts", "--missing"}).out, "--array=1,3,5-6\n");
  EXPECT_FALSE(fs::exists(place.path() / "parts/fit.json"));
  run_shards(place, fit, {1, 3, 5, 6}, 6, "parts");
  EXPECT_EQ(place.run({"merge", "parts", "--missing"}).out, "");
  EXPECT_EQ(place.run({"merge", "parts"}).status, 0);
}

TEST(Shards, SharesOfDifferentNumbersOfShardsAddUp) {
  const Workplace place;
  const Words few = with(fit, {"--replicates", "9"});
  run_shards(place, few, {1}, 2, "parts");
  run_shards(place, few, {2}, 4, "parts");
  EXPECT_EQ(place.run({"merge", "parts"}).status, 3);
  run_shards(place, few, {4}, 4, "parts");
  ASSERT_EQ(place.run({"merge", "parts"}).status, 0);
  ASSERT_EQ(place.run(with(few, {"--out", "whole"})).status, 0);
  EXPECT_EQ(place.read("parts/fit.json"), place.read("whole/fit.json"));
}

TEST(Shards, TheMergeRefusesWhatDoesNotBelongTogether) {
  const Workplace place;
  const auto refused = [&](const std::string& folder, const std::string& why) {
    const Outcome told = place.run({"merge", folder});
    EXPECT_EQ(told.status, 2);
    EXPECT_EQ(told.out, "");
    EXPECT_NE(told.err.find(why), std::string::npos) << told.err;
    EXPECT_FALSE(fs::exists(place.path() / folder / "fit.json"));
  };
  run_shards(place, fit, {1}, 2, "seeds");
  run_shards(place, with(fit, {"--seed", "2"}), {2}, 2, "seeds");
  refused("seeds", "their seeds differ");
  run_shards(place, fit, {1}, 2, "commands");
  run_shards(place, with(fit, {"--scheme", "case"}), {2}, 2, "commands");
  refused("commands", "their commands differ");
  run_shards(place, fit, {1}, 2, "versions");
  for (const std::string& name : files_in(place, "versions")) {
    std::string text = place.read("versions/" + name);
    const std::string key = "\"version\":\"";
    text.insert(text.find(key) + key.size(), "9.");
    place.write("versions/part-2-of-2-0.jsonl", text);
  }
  refused("versions", "different versions of recoil");
  run_shards(place, fit, {1}, 2, "inputs");
  run_shards(place, fit, {1, 2}, 2, "changed");
  place.change("data/points.csv", "2.4,0.651", "2.4,0.650");
  run_shards(place, fit, {2}, 2, "inputs");
  refused("inputs", "the fit file or the data have changed");
  // The parts agree with each other, but not with the present inputs.
  refused("changed", "the fit file or the data have changed");
  EXPECT_EQ(place.run({"merge", "data"}).status, 2);
  EXPECT_EQ(place.run({"merge", "nowhere"}).status, 2);
}

TEST(Shards, AShardThatRunsTwiceWritesTheSameBytesOrNone) {
  const Workplace place;
  run_shards(place, fit, {1}, 2, "parts");
  ASSERT_EQ(parts_in(place, "parts"), 1U);
  const std::string name = files_in(place, "parts").front();
  const std::string first = place.read("parts/" + name);
  const Outcome again = place.run(with(fit, {"--shard", "1/2", "--out", "parts"}));
  EXPECT_EQ(again.status, 0);
  EXPECT_NE(again.out.find("exists already"), std::string::npos) << again.out;
  fs::remove(place.path() / "parts" / name);
  run_shards(place, fit, {1}, 2, "parts");
  EXPECT_EQ(place.read("parts/" + name), first);
}

/// Starts a shard with more work than it can finish in time and ends it by `signal`, soon and then
/// later, until it has left something or has been ended by the signal often enough.
int ended_by(const Workplace& place, const std::string& folder, int signal, int milliseconds) {
  std::string binary = RECOIL_BINARY;
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(place.path().c_str()) != 0) _exit(127);
    dup2(open("/dev/null", O_WRONLY), 1);
    dup2(open("/dev/null", O_WRONLY), 2);
    std::signal(SIGTERM, SIG_DFL);
    execl(binary.c_str(), binary.c_str(), "fit", "fit.toml", "--replicates", "4000", "--shard",
          "1/2", "--threads", "1", "--out", folder.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST(Shards, KilledAtAnyMomentOneLosesItsTimeAndNothingElse) {
  const Workplace place;
  const Words command = {"fit", "fit.toml", "--replicates", "4000"};
  for (int delay = 1; delay < 200; delay = delay * 2 + 1) {
    for (const int signal : {SIGKILL, SIGTERM}) {
      const int status = ended_by(place, "parts", signal, delay);
      if (WIFEXITED(status)) continue;
      EXPECT_EQ(WTERMSIG(status), signal);
      const Outcome told = place.run({"merge", "parts", "--missing"});
      EXPECT_TRUE(told.status == 2 || told.out == "--array=1\n" || parts_in(place, "parts") == 1)
          << told.out << told.err;
    }
  }
  run_shards(place, command, {1, 2}, 2, "parts");
  ASSERT_EQ(place.run({"merge", "parts"}).status, 0);
  ASSERT_EQ(place.run(with(command, {"--out", "whole"})).status, 0);
  EXPECT_EQ(place.read("parts/fit.json"), place.read("whole/fit.json"));
  for (const std::string& name : files_in(place, "parts")) {
    EXPECT_EQ(name.find("unfinished"), std::string::npos) << name;
  }
}

/// While one of these lives, programs find a processor without fused multiply-add, if the C library
/// listens and the processor had it.
struct OlderProcessor {
  OlderProcessor() { setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4", 1); }
  ~OlderProcessor() { unsetenv("GLIBC_TUNABLES"); }
};

TEST(Shards, APartFromAnotherProcessorNeverChangesAByte) {
  const Workplace place;
  const Words command = {"coverage", "fit.toml", "--datasets", "4", "--replicates", "9"};
  const Outcome whole = place.run(command);
  run_shards(place, command, {1}, 2, "parts");
  {
    const OlderProcessor other;
    run_shards(place, command, {2}, 2, "parts");
  }
  Outcome merged = place.run({"merge", "parts"});
  if (merged.status == 3) {  // the message reports different digits
    EXPECT_NE(merged.err.find("parts from processors that give other digits"), std::string::npos);
    EXPECT_NE(merged.err.find("--array=2\n"), std::string::npos) << merged.err;
    run_shards(place, command, {2}, 2, "parts");
    EXPECT_EQ(parts_in(place, "parts"), 3U);
    merged = place.run({"merge", "parts"});
  }
  EXPECT_EQ(merged.status, 0) << merged.err;
  EXPECT_EQ(merged.out, whole.out);
}

/// Points that the model cannot follow: the larger spheres lose more than any fit allows them.
void spoil(const Workplace& place) {
  place.change("data/points.csv", "4,1.4,0.825", "4,1.4,0.625");
  place.change("data/points.csv", "4,5,0.937", "4,5,0.737");
  place.change("data/points.csv", "4,25,0.933", "4,25,0.633");
}

TEST(Shards, ADiagnosisTakesItsCalibrationFromThem) {
  for (const bool misfit : {false, true}) {
    const Workplace place;
    if (misfit) spoil(place);
    const Words command = {"diagnose", "fit.toml", "--seed", "3"};
    const Outcome whole = place.run(with(command, {"--out", "whole"}));
    ASSERT_EQ(whole.status, 0) << whole.err;
    const auto answer = nlohmann::json::parse(place.read("whole/diagnosis.json"));
    EXPECT_EQ(answer["verdict"] == "adequate", !misfit) << answer["verdict"];
    run_shards(place, command, {1, 2}, 2, "parts");
    const Outcome merged = place.run({"merge", "parts"});
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_EQ(merged.out, whole.out);
    for (const char* name : {"diagnosis.json", "diagnosis.html", "extended.toml"}) {
      EXPECT_EQ(place.read(fs::path("parts") / name), place.read(fs::path("whole") / name)) << name;
    }
    // A changed row must change the answer, which shows that the rows are used.
    for (const std::string& name : files_in(place, "parts")) {
      if (!name.starts_with("part-1-")) continue;
      const std::string text = place.read("parts/" + name);
      std::string marked;
      std::istringstream rows(text.substr(text.find('\n') + 1));
      for (std::string line; std::getline(rows, line);) {  // [piece, [1, residuals of the points]]
        auto row = nlohmann::json::parse(line);
        for (std::size_t i = 1; i < row[1].size(); ++i) row[1][i] = 1e3 * row[1][i].get<double>();
        marked += row.dump() + "\n";
      }
      put_rows(place, "parts/" + name, marked);
    }
    ASSERT_EQ(place.run({"merge", "parts"}).status, 0);
    const auto other = nlohmann::json::parse(place.read("parts/diagnosis.json"));
    EXPECT_GT(other["misfit"]["p_value"], 0.3);
    EXPECT_NE(other["misfit"]["p_value"], answer["misfit"]["p_value"]);
  }
}

TEST(Shards, ADiagnosisTakesWhatItsPointsCouldShowFromThem) {
  const Workplace place;
  spoil(place);
  const Words command = {"diagnose", "fit.toml", "--seed", "3", "--rates", "2"};
  const Outcome whole = place.run(with(command, {"--out", "whole"}));
  ASSERT_EQ(whole.status, 0) << whole.err;
  EXPECT_NE(whole.out.find("simulated data sets)"), std::string::npos) << whole.out;
  const auto answer = nlohmann::json::parse(place.read("whole/diagnosis.json"));
  EXPECT_EQ(answer["own_design"]["false_alarms"]["datasets"], 2);
  EXPECT_FALSE(place.read("whole/diagnosis.html").find("simulated data sets)") ==
               std::string::npos);
  run_shards(place, command, {1, 2}, 2, "parts");
  const Outcome merged = place.run({"merge", "parts"});
  ASSERT_EQ(merged.status, 0) << merged.err;
  EXPECT_EQ(place.read("parts/diagnosis.json"), place.read("whole/diagnosis.json"));
}

TEST(Shards, AStudyIsSharedDesignByDesign) {
  const support::TemporaryFolder kept;
  const fs::path program = fs::path(RECOIL_BINARY).parent_path() / "recoil_study";
  const auto study = [&](const Words& words) {
    return support::run_command(with({program.string()}, words), RECOIL_SOURCE_DIR);
  };
  const Words command = {"coverage-designs",
                         "fits/dahneke1975-quartz.toml",
                         "fits/wall1990-mica.toml",
                         "--datasets",
                         "3",
                         "--replicates",
                         "9"};
  const std::string whole = (kept / "whole/coverage-two.json").string();
  const std::string merged = (kept / "merged/coverage-two.json").string();
  const std::string keep = (kept / "keep").string();
  ASSERT_EQ(study(with(command, {"--out", whole})).status, 0);
  EXPECT_EQ(study(with(command, {"--shard", "1/2"})).status, 2) << "nowhere to keep it";
  ASSERT_EQ(study(with(command, {"--keep", keep, "--shard", "2/2"})).status, 0);
  EXPECT_EQ(study({"merge", keep, "--missing"}).out, "--array=1\n");
  EXPECT_EQ(study({"merge", keep, "--out", merged}).status, 3);
  EXPECT_FALSE(kept.has("merged/coverage-two.json"));
  ASSERT_EQ(study(with(command, {"--keep", keep, "--shard", "1/2"})).status, 0);
  const Outcome done = study({"merge", keep, "--out", merged});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(kept.read("merged/coverage-two.json"), kept.read("whole/coverage-two.json"));
  EXPECT_EQ(kept.read("merged/coverage-two.md"), kept.read("whole/coverage-two.md"));
}

TEST(Shards, AutomaticReplicatesAreThoseOfOneProcess) {
  const Workplace place;
  const Words command = {"fit", "fit.toml", "--replicates", "auto"};
  ASSERT_EQ(place.run(with(command, {"--out", "whole"})).status, 0);
  run_shards(place, command, {1, 2}, 2, "parts");
  ASSERT_EQ(place.run({"merge", "parts"}).status, 0);
  EXPECT_EQ(place.read("parts/fit.json"), place.read("whole/fit.json"));
}

TEST(Shards, MistakesAreAnsweredInOneLine) {
  const Workplace place;
  for (const Words& words :
       {Words{"--shard", "0/2", "--out", "p"}, Words{"--shard", "3/2", "--out", "p"},
        Words{"--shard", "two", "--out", "p"}, Words{"--shard", "1/2"},
        Words{"--shard", "1/2", "--out", "p", "--replicates", "0"},
        Words{"--shard", "1/2", "--out", "fit.toml"}}) {
    const Outcome told = place.run(with(fit, words));
    EXPECT_EQ(told.status, 2) << words[1];
    EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
  }
  EXPECT_FALSE(fs::exists(place.path() / "p"));
}

}  // namespace
