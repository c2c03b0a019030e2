// `recoil plan` as a user runs it, before there are points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "support/workplace.hpp"

namespace {

using nlohmann::json;
using support::Outcome;
using support::Workplace;

namespace fs = std::filesystem;

/// The dataset of the workplace without its points.
class Chamber : public Workplace {
 public:
  Chamber() { fs::remove(path() / "data/points.csv"); }
};

Outcome planned(const Workplace& place, std::vector<std::string> more = {}) {
  std::vector<std::string> words = {"plan", "fit.toml", "--velocity", "1,40", "--diameter", "2,5"};
  words.insert(words.end(), more.begin(), more.end());
  return place.run(words);
}

TEST(PlanCommand, ForAFolderWithoutPoints) {
  const Chamber place;
  const Outcome plan = planned(place);
  ASSERT_EQ(plan.status, 0) << plan.err;
  EXPECT_EQ(plan.err, "");
  for (const char* word : {"[[Plan]]", "[[Points to measure]]", "[[Errors]]", "C_H"}) {
    EXPECT_NE(plan.out.find(word), std::string::npos) << word << "\n" << plan.out;
  }
  std::istringstream lines(plan.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  EXPECT_EQ(plan.out, planned(place).out) << "the same question has one answer";
  // No other command takes such a folder.
  EXPECT_EQ(place.run({"check", "data"}).status, 2);
  EXPECT_EQ(place.run({"fit", "fit.toml"}).status, 2);
}

TEST(PlanCommand, AFileWithAHeaderAloneIsNoPoints) {
  const Workplace whole;
  const std::string points = whole.read("data/points.csv");
  const Chamber place;
  for (const std::string& text : {std::string(), points.substr(0, points.find('\n')),
                                  points.substr(0, points.find('\n') + 1) + "\n \r\n"}) {
    place.write("data/points.csv", text);
    EXPECT_EQ(planned(place).status, 0) << text;
  }
  place.write("data/points.csv", points.substr(0, points.find('\n') + 1) + "a,b\n");
  EXPECT_EQ(planned(place).status, 2) << "points that are there are read";
}

TEST(PlanCommand, PointsThatAreThereSayVelocitiesAndDiameters) {
  const Workplace place;
  const json whole = json::parse(place.run({"plan", "fit.toml", "--json"}).out);
  EXPECT_GT(whole["settings"].size(), 3U);
  EXPECT_LT(whole["assumed"]["velocities"][0], whole["assumed"]["velocities"][1]);
  const json stated = json::parse(planned(place, {"--json"}).out);
  EXPECT_EQ(stated["assumed"]["velocities"], json::parse("[1.0, 40.0]"));
}

TEST(PlanCommand, WithoutARangeItStartsBelowCapture) {
  const Chamber place;
  const Outcome run = place.run({"plan", "fit.toml", "--diameter", "2,5", "--json"});
  ASSERT_EQ(run.status, 0) << run.err;
  const json plan = json::parse(run.out);
  double least = 1e9, most = 0.0;
  for (const json& one : plan["quantities"]) {
    if (one["kind"] != "capture_velocity") continue;
    least = std::min(least, one["value"].get<double>());
    most = std::max(most, one["value"].get<double>());
  }
  EXPECT_NEAR(plan["assumed"]["velocities"][0].get<double>() / least, 0.8, 0.01);
  EXPECT_NEAR(plan["assumed"]["velocities"][1].get<double>() / most, 30.0, 0.3);
}

TEST(PlanCommand, WhatIsWrittenIsWhatIsPrintedAndCanBeFilledIn) {
  const Chamber place;
  const Outcome plan = planned(place, {"--out", "p", "--json", "--impacts", "600"});
  ASSERT_EQ(plan.status, 0) << plan.err;
  EXPECT_EQ(place.read("p/plan.json"), plan.out);
  EXPECT_NE(place.read("p/plan.html").find("What to measure"), std::string::npos);
  const json found = json::parse(plan.out);
  EXPECT_EQ(found["impacts"], 600);
  int points = 0;
  for (const json& setting : found["settings"]) points += setting["points"].get<int>();
  EXPECT_EQ(points, found["points"]);
  const std::string csv = place.read("p/points.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), points + 1);
  // Filled in, it is a dataset.
  const Workplace whole;
  const std::string original = whole.read("data/points.csv");
  EXPECT_EQ(csv.substr(0, csv.find('\n')), original.substr(0, original.find('\n')));
  std::vector<std::string> columns;
  std::istringstream header(csv.substr(0, csv.find('\n')));
  for (std::string name; std::getline(header, name, ',');) columns.push_back(name);
  const auto restitution = static_cast<std::size_t>(
      std::find(columns.begin(), columns.end(), "restitution") - columns.begin());
  ASSERT_LT(restitution, columns.size());
  std::istringstream rows(csv);
  std::string filled;
  for (std::string row; std::getline(rows, row);) {
    std::size_t at = 0;
    for (std::size_t c = 0; c < restitution; ++c) at = row.find(',', at) + 1;
    filled += filled.empty() ? row + "\n" : row.substr(0, at) + "0.7" + row.substr(at) + "\n";
  }
  place.write("data/points.csv", filled);
  const Outcome check = place.run({"check", "data"});
  EXPECT_EQ(check.status, 0) << check.err << filled;
}

TEST(PlanCommand, AssumptionsMatter) {
  const Chamber place;
  const json plain = json::parse(planned(place, {"--json", "--impacts", "600"}).out);
  const auto assumed = [](const json& plan, const char* name) {
    return plan["assumed"]["parameters"][name]["value"].get<double>();
  };
  const json sticky = json::parse(
      planned(place, {"--json", "--impacts", "600", "--assume", "C_A=0.1 s/m,f0=20"}).out);
  EXPECT_EQ(assumed(sticky, "C_A"), 0.1);
  EXPECT_EQ(assumed(sticky, "f0"), 20.0);
  EXPECT_EQ(assumed(sticky, "C_H"), assumed(plain, "C_H"));
  EXPECT_GT(sticky["quantities"].back()["value"], plain["quantities"].back()["value"]);
  const json noisy =
      json::parse(planned(place, {"--json", "--impacts", "600", "--scatter", "0.2"}).out);
  EXPECT_GT(noisy["quantities"][0]["relative_error"], plain["quantities"][0]["relative_error"]);
}

TEST(PlanCommand, FittedValuesAreTakenFromTheirFit) {
  const Workplace place;
  ASSERT_EQ(place.run({"fit", "fit.toml", "--replicates", "0", "--out", "r"}).status, 0);
  const Outcome plan = place.run({"plan", "fit.toml", "--parameters", "r/fit.json", "--json"});
  ASSERT_EQ(plan.status, 0) << plan.err;
  const json fit = json::parse(place.read("r/fit.json"));
  // A guess is worth a factor of two, a fit its errors, and what is stated anew a guess again.
  const auto worst = [](const json& one) {
    const json& first = one["quantities"][0];
    EXPECT_GE(first["relative_error_worst"], first["relative_error"]);
    return first["relative_error_worst"].get<double>() / first["relative_error"].get<double>();
  };
  const double of_fit = worst(json::parse(plan.out));
  const json guessed = json::parse(place.run({"plan", "fit.toml", "--json"}).out);
  EXPECT_EQ(guessed["assumed"]["draws"], 200);
  EXPECT_NE(worst(guessed), of_fit);
  const Outcome stated = place.run({"plan", "fit.toml", "--parameters", "r/fit.json", "--assume",
                                    "C_H=3e-3,C_A=0.03", "--json"});
  EXPECT_NE(worst(json::parse(stated.out)), of_fit);
  EXPECT_EQ(json::parse(plan.out)["assumed"]["parameters"]["C_H"]["value"],
            fit["parameters"]["C_H"]["value"]);
}

struct Refused {
  std::vector<std::string> words;
  std::string said;
};

// Dry balls whose loss grows as V^(1/5), that of viscoelasticity: C_H, which a plan assumes, is not
// what a fit finds.
TEST(PlanCommand, SaysThatAFitOfThePointsTakesAnotherLoss) {
  const Workplace place;
  std::string text = "h1,h2\n";
  for (const double drop : {20.0, 40.0, 80.0, 160.0, 320.0, 640.0, 1280.0}) {  // [mm]
    const double velocity = std::sqrt(2.0 * 9.80665e-3 * drop);
    const double e = 1.0 - 0.1 * std::pow(velocity, 0.2);
    text += std::to_string(drop) + "," + std::to_string(e * e * drop) + "\n";
  }
  place.write("drops.csv", text);
  const Outcome made = place.run({"import",
                                  "drops.csv",
                                  "--format",
                                  "heights",
                                  "--map",
                                  "drop_height=h1:mm,rebound_height=h2:mm",
                                  "--drop-error",
                                  "0.1mm",
                                  "--rebound-error",
                                  "0.1mm",
                                  "--diameter",
                                  "10mm",
                                  "--particle",
                                  "steel",
                                  "--surface",
                                  "steel",
                                  "--adhesion-energy",
                                  "0",
                                  "--into",
                                  "balls",
                                  "--provenance",
                                  "measured"});
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string guessed = place.run({"plan", "balls/fit.toml"}).out;
  EXPECT_NE(guessed.find("viscoelastic"), std::string::npos) << guessed;
  ASSERT_EQ(place.run({"fit", "balls/fit.toml", "--replicates", "0", "--out", "r"}).status, 0);
  const Outcome known = place.run({"plan", "balls/fit.toml", "--parameters", "r/fit.json"});
  EXPECT_EQ(known.status, 0) << known.err;
  EXPECT_EQ(known.out.find("chooses the loss"), std::string::npos) << known.out;
}

TEST(PlanCommand, MistakesAreSaidInOneLine) {
  const Chamber place;
  place.write("fixed.toml",
              "dataset = \"data\"\n[parameters]\nC_H = { free = false }\nC_A = { free = false }\n");
  place.write("jkr.toml", "dataset = \"data\"\n[model]\nadhesion = \"jkr\"\n");
  place.write("far.toml", "dataset = \"nowhere\"\n");
  const std::vector<Refused> all = {
      {{"plan", "fit.toml"}, "the diameters of the spheres are not known"},
      {{"plan", "none.toml"}, "no such file"},
      {{"plan", "far.toml", "--diameter", "2"}, "nowhere"},
      {{"plan", "fit.toml", "--diameter", "2", "--velocity", "5,1"}, "is not a range"},
      {{"plan", "fit.toml", "--diameter", "2", "--velocity", "5"}, "--velocity"},
      {{"plan", "fit.toml", "--diameter", "-2"}, "diameter"},
      {{"plan", "fit.toml", "--diameter", "2", "--error", "0"}, "error"},
      {{"plan", "fit.toml", "--diameter", "2", "--error", "nan"}, "error"},
      {{"plan", "fit.toml", "--diameter", "2", "--impacts", "0"}, "--impacts"},
      {{"plan", "fit.toml", "--diameter", "2", "--impacts", "20"}, "2 parameters are free"},
      {{"plan", "fit.toml", "--diameter", "2", "--assume", "W=0.2"},
       "'W' is not a parameter of this fit"},
      {{"plan", "jkr.toml", "--diameter", "2", "--assume", "f0=9"},
       "'f0' is not a parameter of this fit"},
      {{"plan", "fit.toml", "--diameter", "2", "--assume", "C_H=1e5"}, "outside its bounds"},
      {{"plan", "fit.toml", "--diameter", "2", "--assume", "C_H=1 m"},
       "that is the unit of a length"},
      {{"plan", "fixed.toml", "--diameter", "2"}, "no parameter is free"},
      {{"plan", "fit.toml", "--diameter", "2", "--parameters", "no.json"}, "no.json"},
      {{"plan", "fit.toml", "--diameter", "2", "--assume", "f0=0"}, "--velocity MIN,MAX"},
  };
  for (const Refused& one : all) {
    const Outcome run = place.run(one.words);
    EXPECT_EQ(run.status, 2) << one.said << run.out;
    EXPECT_EQ(run.out, "") << one.said;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_LT(run.err.size(), 300U) << run.err;
    EXPECT_NE(run.err.find(one.said), std::string::npos) << one.said << "\n" << run.err;
  }
  const Outcome lost =
      place.run({"plan", "fit.toml", "--diameter", "2", "--velocity", "0.001,0.002"});
  EXPECT_EQ(lost.status, 3) << lost.out;
  EXPECT_EQ(std::count(lost.err.begin(), lost.err.end(), '\n'), 1) << lost.err;
  EXPECT_NE(lost.err.find("would not determine C_H and C_A"), std::string::npos) << lost.err;
}

}  // namespace
