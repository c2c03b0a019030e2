// The scripts that recoil cluster writes, run as a cluster would run them. A real Slurm runs them
// in tests/cluster/slurm_one_machine.sh.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "support/workplace.hpp"

namespace {

namespace fs = std::filesystem;
using support::Outcome;
using support::run_command;
using support::Workplace;
using Words = std::vector<std::string>;

Words cluster(const std::string& system, const Words& more) {
  Words words = {"cluster", system, "--shards", "3", "--out", "job"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(Cluster, WritesItsScriptsAndChecksEveryOneOfThem) {
  const Workplace place;
  const std::vector<std::pair<std::string, Words>> systems = {
      {"slurm", {"array.sbatch", "run.sh", "shard.sh"}}, {"parallel", {"run.sh", "shard.sh"}}};
  for (const auto& [system, names] : systems) {
    fs::remove_all(place.path() / "job");
    const Outcome wrote = place.run(cluster(system, {"fit.toml", "--replicates", "9"}));
    ASSERT_EQ(wrote.status, 0) << wrote.err;
    Words found;
    for (const auto& entry : fs::directory_iterator(place.path() / "job")) {
      found.push_back(entry.path().filename().string());
      const std::string text = place.read(fs::path("job") / found.back());
      // No @NAME@ of the template is left. The remaining @ belongs to Slurm.
      EXPECT_EQ(std::count(text.begin(), text.end(), '@'), found.back() == "array.sbatch" ? 1 : 0)
          << text;
      EXPECT_EQ(run_command({"sh", "-n", found.back()}, place.path() / "job").status, 0) << text;
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, names);
  }
}

TEST(Cluster, TheLimitsAreThoseThatWereAskedFor) {
  const Workplace place;
  const Words limits = {"--time", "101:02:03", "--cpus", "4", "fit.toml"};
  ASSERT_EQ(place.run(cluster("slurm", limits)).status, 0);
  const std::string array = place.read("job/array.sbatch");
  for (const char* line : {"#SBATCH --array=1-3\n", "#SBATCH --cpus-per-task=4\n",
                           "#SBATCH --time=101:02:03\n", "#SBATCH --signal=B:USR1@90\n"}) {
    EXPECT_NE(array.find(line), std::string::npos) << array;
  }
}

TEST(Cluster, AShardIsWhatTheScriptSays) {
  const Workplace place;
  fs::rename(place.path() / "fit.toml", place.path() / "it's mine.toml");
  const Outcome wrote = place.run(cluster("slurm", {"it's mine.toml", "--replicates", "9"}));
  ASSERT_EQ(wrote.status, 0) << wrote.err;
  for (const char* number : {"1", "2", "3"}) {
    const Outcome shard =
        run_command({"sh", (place.path() / "job/shard.sh").string(), number}, "/");
    ASSERT_EQ(shard.status, 0) << shard.err;
  }
  ASSERT_EQ(place.run({"merge", "job"}).status, 0);
  ASSERT_EQ(place.run({"fit", "it's mine.toml", "--replicates", "9", "--out", "whole"}).status, 0);
  EXPECT_EQ(place.read("job/fit.json"), place.read("whole/fit.json"));
}

TEST(Cluster, InputThatIsRefusedIsNotTriedAgain) {
  const Workplace place;
  ASSERT_EQ(place.run(cluster("slurm", {"fit.toml"})).status, 0);
  const std::string good = place.read("data/points.csv");
  place.change("data/points.csv", "0.651", "fast");
  const Words shard = {"sh", (place.path() / "job/shard.sh").string(), "2"};
  EXPECT_EQ(run_command(shard, "/").status, 2);
  EXPECT_TRUE(place.has("job/refused-2"));
  place.write("data/points.csv", good);
  const Outcome again = run_command(shard, "/");
  EXPECT_EQ(again.status, 2);
  EXPECT_EQ(again.err, "");  // not even tried
  const Outcome start = run_command({"sh", (place.path() / "job/run.sh").string()}, "/");
  EXPECT_EQ(start.status, 2);
  EXPECT_NE(start.err.find("remove refused-*"), std::string::npos) << start.err;
  fs::remove(place.path() / "job/refused-2");
  EXPECT_EQ(run_command(shard, "/").status, 0);
}

TEST(Cluster, ATimeLimitKeepsWhatIsFinished) {
  const Workplace place;
  ASSERT_EQ(place.run(cluster("slurm", {"fit.toml", "--replicates", "1000000"})).status, 0);
  const std::string script = (place.path() / "job/shard.sh").string();
  // SIGTERM to the script only, and to all of its processes.
  for (const char* who : {"--foreground", "--verbose"}) {
    bool kept = false;
    for (int seconds = 1; seconds <= 16 && !kept; seconds *= 2) {
      const Outcome ended = run_command(
          {"timeout", who, "--signal=TERM", std::to_string(seconds), "sh", script, "1"}, "/");
      EXPECT_EQ(ended.status, 124) << ended.err;
      Words unfinished;
      for (const auto& entry : fs::directory_iterator(place.path() / "job")) {
        const std::string name = entry.path().filename().string();
        EXPECT_FALSE(name.starts_with("part-")) << name;
        if (name.starts_with("unfinished-part-1-of-3-")) unfinished.push_back(name);
      }
      for (const std::string& name : unfinished) fs::remove(place.path() / "job" / name);
      kept = !unfinished.empty();
    }
    EXPECT_TRUE(kept) << who;
  }
}

TEST(Cluster, GnuParallelGivesTheBytesOfOneProcess) {
  const Workplace place;
  ASSERT_EQ(place
                .run(cluster("parallel",
                             {"coverage", "fit.toml", "--datasets", "5", "--replicates", "9"}))
                .status,
            0);
  const Outcome job = run_command({"sh", "job/run.sh"}, place.path());
  ASSERT_EQ(job.status, 0) << job.err;
  const Outcome whole = place.run(
      {"coverage", "fit.toml", "--datasets", "5", "--replicates", "9", "--out", "whole.md"});
  EXPECT_EQ(place.read("job/result.txt"), whole.out);
  EXPECT_EQ(place.read("job/coverage.md"), place.read("whole.md"));
}

TEST(Cluster, MistakesAreToldBeforeAThousandShardsRepeatThem) {
  const Workplace place;
  for (const Words& words :
       {cluster("slurm", {}), cluster("slurm", {"nowhere.toml"}), cluster("pbs", {"fit.toml"}),
        cluster("slurm", {"fit.toml", "--replicatez", "3"}),
        cluster("slurm", {"fit.toml", "--replicates", "many"}),
        cluster("slurm", {"fit.toml", "--threads", "3"}),
        cluster("slurm", {"fit.toml", "--threads=3"}),
        cluster("slurm", {"fit.toml", "--shard", "1/2"}),
        cluster("slurm", {"simulate", "fit.toml"}), cluster("slurm", {"plan", "fit.toml"}),
        cluster("slurm", {"fit.toml", "--time", "5"}),
        cluster("slurm", {"fit.toml", "--time", "aa:00:00"}),
        cluster("slurm", {"fit.toml", "--time", "00:09:59"}),
        cluster("slurm", {"fit.toml", "--time", "01:60:00"}),
        cluster("slurm", {"fit.toml", "--time", "-1:00:00"}),
        Words{"cluster", "slurm", "fit.toml", "--shards", "0", "--out", "job"},
        Words{"cluster", "slurm", "fit.toml", "--shards", "2"},
        Words{"cluster", "slurm", "fit.toml", "--shards", "2", "--out", "50%"}}) {
    const Outcome told = place.run(words);
    EXPECT_EQ(told.status, 2) << words.back();
    EXPECT_EQ(std::count(told.err.begin(), told.err.end(), '\n'), 1) << told.err;
  }
  EXPECT_FALSE(place.has("job"));
  EXPECT_NE(
      place.run(cluster("slurm", {"plan", "fit.toml"})).err.find("plan does not run in shards"),
      std::string::npos);
}

}  // namespace
