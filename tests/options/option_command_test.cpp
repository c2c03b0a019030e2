// Options as people type them.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/workplace.hpp"

namespace {

using support::Outcome;
using support::with;
using support::Words;
using support::Workplace;

TEST(Options, WholeNumbersAreDecimal) {
  const Workplace place;
  const Words fit = {"fit", "fit.toml", "--replicates", "019", "--json", "--seed"};
  for (const char* seed : {"010", "10"}) {
    const Outcome run = place.run(with(fit, {seed}));
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out)["bootstrap"]["seed"], 10);
  }
  EXPECT_EQ(place.run(with(fit, {"08"})).status, 0);
  const Outcome coverage =
      place.run({"coverage", "fit.toml", "--datasets", "010", "--replicates", "9", "--json"});
  ASSERT_EQ(coverage.status, 0) << coverage.err;
  EXPECT_EQ(nlohmann::json::parse(coverage.out)["simulated"], 10);
  ASSERT_EQ(place.run({"cluster", "slurm", "--shards", "010", "--out", "job", "fit.toml"}).status,
            0);
  EXPECT_NE(place.read("job/array.sbatch").find("--array=1-10\n"), std::string::npos);
}

TEST(Options, AQuantityHasAUnitOrNone) {
  const Workplace place;
  const auto at = [&](const char* velocity, const char* diameter) {
    const Outcome run =
        place.run({"simulate", "fit.toml", "--velocity", velocity, "--diameter", diameter});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.out;
  };
  EXPECT_EQ(at("8", "4.9"), at("800 cm/s", "4.9um"));
  const Outcome wrong =
      place.run({"simulate", "fit.toml", "--velocity", "8 kg", "--diameter", "4.9"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("'8 kg' is not a number from 1e-07 to 10000 m/s (units: m/s, cm/s"),
            std::string::npos)
      << wrong.err;
}

TEST(Options, AnImportTakesQuantitiesAlike) {
  const Workplace place;
  place.write("drops.csv", "h2\n0.81\n0.64\n");
  const Words import = {"import", "drops.csv",          "--format", "heights", "--surface",
                        "glass",  "--ambient-pressure", "0 Pa",     "--into"};
  const auto made = [&](const char* folder, const Words& more) {
    const Outcome run = place.run(with(with(import, {folder}), more));
    EXPECT_EQ(run.status, 0) << run.err;
    return place.read(std::string(folder) + "/points.csv");
  };
  const std::string points =
      made("a/d", {"--diameter", "8 mm", "--map", "drop_height=1m,rebound_height=h2:m",
                   "--particle", "steel,density=7.85 g/cm3,youngs_modulus=200 GPa"});
  // A diameter without a unit is in um, a height in m, a modulus in Pa.
  EXPECT_EQ(points, made("b/d", {"--diameter", "8000", "--map", "drop_height=1,rebound_height=h2:m",
                                 "--particle", "steel,density=7850,youngs_modulus=2e11"}));
  EXPECT_EQ(place.read("a/d/datapackage.json"), place.read("b/d/datapackage.json"));
  EXPECT_NE(place.read("a/d/datapackage.json").find("200000000000.0"), std::string::npos)
      << place.read("a/d/datapackage.json");
}

TEST(Options, AnEmptyValueIsRefused) {
  const Workplace place;
  for (const Words& words : std::vector<Words>{
           {"import", "x.csv", "--format", "heights", "--into", "d", "--drop-error", ""},
           {"predict", "fit.toml", "--sizes", "s.csv", "--unit", ""},
           {"fit", "fit.toml", "--out", ""}}) {
    const Outcome run = place.run(words);
    EXPECT_EQ(run.status, 2) << run.out;
    EXPECT_NE(run.err.find(words[words.size() - 2]), std::string::npos) << run.err;
    EXPECT_NE(run.err.find("not empty"), std::string::npos) << run.err;
  }
}

TEST(Options, AMistakeOfClusterIsNamedAsSuch) {
  const Workplace place;
  const auto cluster = [&](const Words& own) {
    Words words = {"cluster", "slurm", "fit", "fit.toml", "--replicates", "99", "--out", "c"};
    const Outcome run = place.run(with(words, own));
    EXPECT_EQ(run.status, 2) << run.out;
    EXPECT_EQ(run.err.find("unknown option"), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_FALSE(place.has("c"));
    return run.err;
  };
  EXPECT_NE(cluster({"--shards", "4", "--time", "24:00"}).find("--time: '24:00' is not hours"),
            std::string::npos);
  EXPECT_NE(cluster({"--shards", "4", "--time", "0:09:00"}).find("--time"), std::string::npos);
  EXPECT_NE(cluster({"--shards", "0"}).find("--shards: '0' is not a whole number from 1 to"),
            std::string::npos);
  EXPECT_NE(cluster({"--shards", "4", "--cpus", "many"}).find("--cpus: 'many'"), std::string::npos);
  EXPECT_NE(cluster({}).find("--shards is required"), std::string::npos);
}

}  // namespace
