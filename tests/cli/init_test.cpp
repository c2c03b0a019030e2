// recoil init makes a dataset and a fit that runs, and overwrites nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/command.hpp"
#include "support/workplace.hpp"

namespace {

using support::Outcome;
using support::Workplace;

const std::vector<std::string> kMaterials = {
    "--particle", "material=glass,density=2500,youngs_modulus=70e9,poisson_ratio=0.22", "--surface",
    "material=steel,youngs_modulus=200e9,poisson_ratio=0.3"};

Outcome init(const Workplace& place, std::vector<std::string> more, bool materials = true) {
  std::vector<std::string> words = {"init", "mine"};
  words.insert(words.end(), more.begin(), more.end());
  if (materials) words.insert(words.end(), kMaterials.begin(), kMaterials.end());
  return place.run(words);
}

TEST(Init, AnExampleSaysThatItIsOneAndIsFoundAgainByItsFit) {
  const Workplace place;
  const Outcome made = init(place, {"--diameter", "5"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.out.find("SYNTHETIC"), std::string::npos) << made.out;
  EXPECT_NE(place.read("mine/datapackage.json").find("\"synthetic\""), std::string::npos);
  EXPECT_EQ(place.run({"check", "mine"}).status, 0);
  const Outcome fitted = place.run({"fit", "mine/fit.toml", "--replicates", "0", "--json"});
  ASSERT_EQ(fitted.status, 0) << fitted.err;
  // The model made the points, with C_H = 3e-3 s/m, C_A = 3e-2 s/m and noise of 0.01.
  const auto found = nlohmann::json::parse(fitted.out);
  EXPECT_GT(found["goodness"]["p_value"], 1e-3);
  EXPECT_LT(found["goodness"]["rmse"], 0.02);
  const auto& all_points = found["comparison"].at(1);
  for (const auto& [name, truth] : {std::pair("C_H", 3e-3), std::pair("C_A", 3e-2)}) {
    const double error = all_points[std::string(name) + "_standard_error"];
    EXPECT_NEAR(all_points[name], truth, 4.0 * error) << name;
  }
}

TEST(Init, TakesPointsWithTheirProvenance) {
  const Workplace place;
  place.write("points.csv",
              "incident_velocity,restitution\n1,0.5\n2,0.7\n4,0.8\n8,0.85\n20,0.87\n");
  const Outcome made =
      init(place, {"--diameter", "5", "--points", "points.csv", "--provenance", "measured"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.out.find("SYNTHETIC"), std::string::npos);
  EXPECT_NE(place.read("mine/datapackage.json").find("\"measured\""), std::string::npos);
  EXPECT_EQ(place.run({"fit", "mine/fit.toml", "--replicates", "0"}).status, 0);
}

TEST(Init, PointsCountAsMeasuredAndDiametersMayHaveUnits) {
  const Workplace place;
  place.write("points.csv",
              "incident_velocity,restitution\n1,0.5\n2,0.7\n4,0.8\n8,0.85\n20,0.87\n");
  const Outcome made = init(place, {"--diameter", "0.005 mm", "--points", "points.csv"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(place.read("mine/datapackage.json").find("\"measured\""), std::string::npos);
  EXPECT_NE(place.read("mine/points.csv").find(",5,1,0.5"), std::string::npos)
      << place.read("mine/points.csv");
}

TEST(Init, MapsColumnsAsTheRefusalOfAnUnknownHeaderSays) {
  const Workplace place;
  place.write("points.csv", "V,e\n100,0.5\n200,0.7\n400,0.8\n800,0.85\n2000,0.87\n");
  const std::vector<std::string> points = {"--diameter", "5", "--points", "points.csv"};
  const Outcome refused = init(place, points);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("--map incident_velocity=COLUMN:UNIT"), std::string::npos)
      << refused.err;
  std::vector<std::string> mapped = points;
  mapped.insert(mapped.end(), {"--map", "incident_velocity=V:cm/s,restitution=e"});
  const Outcome made = init(place, mapped);
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(place.read("mine/points.csv").find(",5,20,0.87"), std::string::npos)
      << place.read("mine/points.csv");
  const Outcome alone = init(place, {"--diameter", "5", "--map", "incident_velocity=V:m/s"});
  EXPECT_EQ(alone.status, 2);
}

TEST(Init, AsksNothing) {
  const Workplace place;
  // script(1) gives the program a terminal
  const Outcome made = support::run_command(
      {"env", "RECOIL=" RECOIL_BINARY, "script", "-qec", "\"$RECOIL\" init mine", "/dev/null"},
      place.path());
  EXPECT_EQ(made.status, 2) << made.out << made.err;
  EXPECT_FALSE(place.has("mine/fit.toml"));
}

TEST(Init, MistakesAreOneLineAndWriteNothing) {
  const Workplace place;
  place.write("taken/fit.toml", "mine");
  const auto before = place.listing();
  for (const Outcome& run :
       {init(place, {}), init(place, {"--diameter", "5"}, false),
        init(place, {"--diameter", "5", "--points", "none.csv", "--provenance", "measured"}),
        init(place, {"--diameter", "-5"}), place.run({"init", "taken", "--diameter", "5"})}) {
    EXPECT_EQ(run.status, 2) << run.out;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_EQ(place.listing(), before);
}

}  // namespace
