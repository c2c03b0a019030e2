// recoil export as people script against it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/workplace.hpp"

namespace {

using support::Outcome;
using support::Workplace;

Outcome export_to(const Workplace& place, const std::string& target,
                  std::vector<std::string> more = {}) {
  std::vector<std::string> words = {"export", "fit.toml", "--to", target, "--out", "out"};
  words.insert(words.end(), more.begin(), more.end());
  return place.run(words);
}

struct Row {
  double diameter, velocity, e;
  std::string lower, upper;
};

std::vector<Row> rows_of(const std::string& csv) {
  std::vector<Row> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<std::string> cell(5);
    for (std::string& c : cell) std::getline(cells, c, ',');
    rows.push_back({std::stod(cell[0]), std::stod(cell[1]), std::stod(cell[2]), cell[3], cell[4]});
  }
  return rows;
}

TEST(Export, ATableHasEverySizeWithBandsAndItsCaptureVelocity) {
  const Workplace place;
  const Outcome run =
      export_to(place, "table", {"--replicates", "39", "--threads", "2", "--velocity", "0.5,25"});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string csv = place.read("out/restitution.csv");
  EXPECT_EQ(csv.rfind("diameter_um,incident_velocity_m_s,restitution_1,lower_1,upper_1\n", 0), 0U);
  EXPECT_EQ(csv.find("nan"), std::string::npos);
  const std::vector<Row> rows = rows_of(csv);
  const std::string captures = place.read("out/capture.csv");
  EXPECT_EQ(captures.rfind("diameter_um,capture_velocity_m_s,lower_m_s,upper_m_s\n", 0), 0U);
  EXPECT_EQ(std::count(captures.begin(), captures.end(), '\n'), 3);
  const std::vector<Row> found = rows_of(captures);
  for (const double size : {2.0, 4.0}) {
    const Row& capture = size == 2.0 ? found[0] : found[1];
    EXPECT_EQ(capture.diameter, size);
    EXPECT_LT(capture.e, capture.velocity * 1.2);  // the lower end of V*
    int below = 0;
    int above = 0;
    for (const Row& row : rows) {
      if (row.diameter != size) continue;
      ASSERT_FALSE(row.lower.empty());
      EXPECT_LE(std::stod(row.lower), row.e + 1e-9);
      EXPECT_GE(std::stod(row.upper), row.e - 1e-9);
      const bool stays = row.velocity <= capture.velocity;  // V* stands in the second column
      EXPECT_EQ(row.e == 0.0, stays) << row.velocity;
      (stays ? below : above) += 1;
    }
    EXPECT_GE(above, 40);
    EXPECT_GE(below, 1);
  }
}

TEST(Export, ATableAnswersAsSimulateDoes) {
  const Workplace place;
  ASSERT_EQ(place.run({"fit", "fit.toml", "--replicates", "0", "--out", "fitted"}).status, 0);
  const Outcome run = export_to(
      place, "table", {"--parameters", "fitted/fit.json", "--diameter", "3", "--velocity", "2,8"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("no bands"), std::string::npos) << run.out;
  const std::vector<Row> rows = rows_of(place.read("out/restitution.csv"));
  EXPECT_EQ(rows.front().velocity, 2.0);
  EXPECT_NEAR(rows.back().velocity, 8.0, 1e-8);
  for (const Row& row : {rows.front(), rows.back()}) {
    EXPECT_TRUE(row.lower.empty());
    const Outcome one = place.run({"simulate", "fit.toml", "--parameters", "fitted/fit.json",
                                   "--diameter", "3", "--velocity", std::to_string(row.velocity)});
    const std::size_t at = one.out.find("restitution: ");
    ASSERT_NE(at, std::string::npos);
    EXPECT_NEAR(row.e, std::stod(one.out.substr(at + 13)), 1e-8);
  }
}

TEST(Export, SaysWhatTheNumbersAreInTheFileItself) {
  const Workplace place;
  ASSERT_EQ(place.run({"fit", "fit.toml", "--replicates", "0", "--out", "fitted"}).status, 0);
  for (const auto& [target, file] : std::vector<std::pair<std::string, std::string>>{
           {"lammps", "impact.lammps"},
           {"liggghts", "impact.liggghts"},
           {"yade", "impact.py"},
           {"openfoam", "recoilRebound/recoilRebound.C"},
           {"fluent", "recoil_rebound.c"}}) {
    const Outcome run = export_to(place, target, {"--parameters", "fitted/fit.json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const std::string text = place.read("out/" + file);
    for (const char* words : {"fit.toml", "example (synthetic)", "C_A = ", "+/-", "f0 = "}) {
      EXPECT_NE(text.find(words), std::string::npos) << target << " lacks " << words;
    }
    EXPECT_EQ(text.find('@'), std::string::npos) << target;
    EXPECT_EQ(text.find("nan"), std::string::npos) << target;
  }
}

double value_of(const std::string& text, const std::string& variable) {
  const std::string before = "variable " + variable + " equal ";
  const std::size_t at = text.find(before);
  if (at == std::string::npos) {
    ADD_FAILURE() << "no " << before;
    return 0.0;
  }
  return std::stod(text.substr(at + before.size()));
}

/// With a_p^3 = pi W R^2 / (6 K) and u = a_p^2 / R the force K a_p^3 / R is pi W R / 6.
TEST(Export, LengthsAndForcesOfLammpsAreInItsUnits) {
  const Workplace place;
  place.write("fit.toml",
              "dataset = \"data\"\n[model]\nadhesion = \"jkr\"\n[parameters]\n"
              "C_H = { initial = 4e-3, free = true }\nC_A = { initial = 0.03, free = false }\n"
              "W = { free = false }\n");
  ASSERT_EQ(place.run({"fit", "fit.toml", "--replicates", "0", "--out", "fitted"}).status, 0);
  ASSERT_EQ(
      export_to(place, "lammps", {"--parameters", "fitted/fit.json", "--diameter", "4"}).status, 0);
  const std::string text = place.read("out/impact.lammps");
  EXPECT_NEAR(value_of(text, "R"), 2.0, 1e-12);  // um
  const std::size_t at = text.find("\n# W = ");
  ASSERT_NE(at, std::string::npos);
  const double W = std::stod(text.substr(at + 7));
  EXPECT_NEAR(value_of(text, "P") / (M_PI * W * 2e-6 / 6.0 * 1e9), 1.0, 1e-9);  // nN
}

/// 4 um against 12 um: R* = 1 / (1/2 + 1/6) um = 1.5 um, m* = m M / (m + M), rho* 3^3 = rho 4^3
/// / (1 + (4/12)^3 rho / rho_M).
TEST(Export, TwoSpheresAreTheOneWithTheirRadiusAndMass) {
  const Workplace place;
  nlohmann::json package = nlohmann::json::parse(place.read("data/datapackage.json"));
  package["recoil"]["surface"]["diameter"] = 12e-6;
  package["recoil"]["surface"]["density"] = 2500.0;
  place.write("data/datapackage.json", package.dump());
  const double density = package["recoil"]["particle"]["density"];
  ASSERT_EQ(place.run({"fit", "fit.toml", "--replicates", "0", "--out", "fitted"}).status, 0);
  const Outcome run =
      export_to(place, "lammps", {"--parameters", "fitted/fit.json", "--diameter", "4"});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string text = place.read("out/impact.lammps");
  EXPECT_NEAR(value_of(text, "R"), 1.5, 1e-12);
  const std::size_t at = text.find("A sphere of 3 um, ");
  ASSERT_NE(at, std::string::npos) << text.substr(0, 2000);
  EXPECT_NEAR(
      std::stod(text.substr(at + 18)) / (density * 64.0 / 27.0 / (1.0 + density / 2500.0 / 27.0)),
      1.0, 1e-5);
  EXPECT_NE(text.find("Both bodies are spheres, of 4 um and 12 um."), std::string::npos);
}

TEST(Export, TheSameBytesAtAnyThreadCount) {
  const Workplace place;
  std::string first;
  for (const char* threads : {"1", "3"}) {
    ASSERT_EQ(export_to(place, "table", {"--threads", threads}).status, 0);
    const std::string csv = place.read("out/restitution.csv") + place.read("out/capture.csv");
    if (first.empty()) first = csv;
    EXPECT_EQ(csv, first);
  }
}

TEST(Export, SaysWhichSizeItTookWhereItHoldsOneOnly) {
  const Workplace place;  // two sizes
  ASSERT_EQ(place.run({"fit", "fit.toml", "--replicates", "0", "--out", "fitted"}).status, 0);
  for (const auto& [target, one] : std::vector<std::pair<std::string, bool>>{
           {"lammps", true}, {"yade", true}, {"table", false}, {"fluent", false}}) {
    const Outcome run = export_to(place, target, {"--parameters", "fitted/fit.json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const bool said =
        run.out.find("without --diameter, 4 um is used, the middle one") != std::string::npos;
    EXPECT_EQ(said, one) << target << "\n" << run.out;
  }
}

TEST(Export, NothingIsExportedThatNoPointDetermines) {
  const Workplace place;
  place.write("data/points.csv",
              "series,diameter,incident_velocity,restitution,restitution_sd,events,captured\n"
              "a,2,0.5,0,0.015,20,20\na,2,1,0,0.015,20,20\na,2,1.2,0,0.015,20,20\n");
  ASSERT_EQ(place.run({"fit", "fit.toml", "--replicates", "0", "--out", "fitted"}).status, 0);
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{}, {"--parameters", "fitted/fit.json"}}) {
    const Outcome run = export_to(place, "table", more);
    EXPECT_EQ(run.status, 2);
    EXPECT_NE(run.err.find("all of its impacts were captured, which determines no parameter"),
              std::string::npos)
        << run.err;
    EXPECT_FALSE(place.has("out"));
  }
}

TEST(Export, WithoutAdhesionNothingIsCaptured) {
  const Workplace place;
  place.change("data/datapackage.json", "\"provenance\": \"synthetic\",",
               "\"provenance\": \"synthetic\", \"adhesion_energy\": 0,");
  place.write("data/points.csv",
              "series,diameter,incident_velocity,restitution,restitution_sd,events,captured\n"
              "a,4,1,0.99,0.01,20,0\na,4,3,0.97,0.01,20,0\na,4,9,0.93,0.01,20,0\n");
  for (const char* target : {"table", "fluent", "openfoam", "lammps", "yade"}) {
    const Outcome run = export_to(place, target, {"--threads", "2"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out.find("aptures are kept"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("apture velocity is kept"), std::string::npos) << run.out;
  }
  EXPECT_EQ(place.read("out/capture.csv"),
            "diameter_um,capture_velocity_m_s,lower_m_s,upper_m_s\n");
  EXPECT_NE(place.read("out/recoil_rebound.c").find("if (0 && velocity"), std::string::npos);
}

// LIGGGHTS 3.8.0 ends with "0.05 < coefficientRestitution <= 1 required".
TEST(Export, AStockModelIsGivenWhatTheProgramTakesOrNothing) {
  const Workplace place;
  ASSERT_EQ(place.run({"fit", "fit.toml", "--replicates", "0", "--out", "fitted"}).status, 0);
  const auto fit = nlohmann::json::parse(place.read("fitted/fit.json"));
  double capture = 0.0;
  for (const auto& one : fit["derived"]["capture_velocity"]) {
    if (one["diameter_um"] == 2.0) capture = one["value"];
  }
  ASSERT_GT(capture, 0.5);
  const auto range = [&](double least, double most) {
    return std::vector<std::string>{
        "--parameters", "fitted/fit.json",
        "--diameter",   "2",
        "--velocity",   std::to_string(least * capture) + "," + std::to_string(most * capture)};
  };
  ASSERT_EQ(export_to(place, "liggghts", range(0.01, 1.1)).status, 0);
  const std::string text = place.read("out/impact.liggghts");
  const std::string before = "coefficientRestitution peratomtypepair 1 ";
  const double e = std::stod(text.substr(text.find(before) + before.size()));
  EXPECT_GT(e, 0.05);
  EXPECT_LT(e, 0.0501);
  for (const char* target : {"liggghts", "lammps", "yade"}) {
    std::vector<std::string> words = range(0.2, 0.9);
    if (std::string(target) != "liggghts") words.push_back("--stock");
    const Outcome run = export_to(place, target, words);
    EXPECT_EQ(run.status, 2) << run.out;
    EXPECT_NE(
        run.err.find("is captured (only rebounds determine a contact model of the program itself)"),
        std::string::npos)
        << run.err;
  }
}

TEST(Export, AStockModelFitsTheTerminal) {
  const Workplace place;
  ASSERT_EQ(export_to(place, "lammps", {"--stock", "--diameter", "4"}).status, 0);
  std::istringstream lines(place.read("out/impact.lammps"));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

// LIGGGHTS 3.8.0: "youngsModulus >= 5e6 required for SI units (use command 'soft_particles yes' to
// override)". The stiffness of both bodies is that of E* = E / (2 (1 - nu^2)) with nu = 1/4: a gel
// with E = 1e5 Pa and nu = 0.49 on a rigid surface has E* = 1e5 Pa / (1 - 0.49^2).
TEST(Export, LiggghtsIsToldThatASphereIsSoft) {
  const Workplace place;
  ASSERT_EQ(export_to(place, "liggghts", {"--diameter", "4"}).status, 0);
  EXPECT_EQ(place.read("out/impact.liggghts").find("\nsoft_particles"), std::string::npos);
  EXPECT_NE(place.read("out/impact.liggghts").find("\nhard_particles yes"), std::string::npos);
  place.change("data/datapackage.json", "\"youngs_modulus\": 2.56e9, \"poisson_ratio\": 0.35",
               "\"youngs_modulus\": 1e5, \"poisson_ratio\": 0.49");
  ASSERT_EQ(export_to(place, "liggghts", {"--diameter", "4"}).status, 0);
  const std::string text = place.read("out/impact.liggghts");
  EXPECT_NE(text.find("\nsoft_particles yes"), std::string::npos) << text;
  EXPECT_EQ(text.find("\nhard_particles"), std::string::npos) << text;
  const std::string before = "youngsModulus peratomtype ";
  EXPECT_NEAR(std::stod(text.substr(text.find(before) + before.size())),
              2.0 * (1.0 - 1.0 / 16.0) * 1e5 / (1.0 - 0.49 * 0.49), 1.0);
}

TEST(Export, MistakesAreOneLineAndWriteNothing) {
  const Workplace place;
  place.write("taken", "a file");
  const auto before = place.listing();
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"export", "fit.toml", "--to", "abaqus", "--out", "out"},
           {"export", "fit.toml", "--to", "lammps"},
           {"export", "fit.toml", "--to", "lammps", "--out", "taken"},
           {"export", "fit.toml", "--to", "lammps", "--out", "out", "--velocity", "5,2"},
           {"export", "fit.toml", "--to", "lammps", "--out", "out", "--velocity", "nan,2"},
           {"export", "fit.toml", "--to", "lammps", "--out", "out", "--diameter", "-4"},
           {"export", "fit.toml", "--to", "lammps", "--out", "out", "--dataset", "other"},
           {"export", "fit.toml", "--to", "openfoam", "--out", "out", "--stock"},
           {"export", "fit.toml", "--to", "fluent", "--out", "out", "--stock"},
           {"export", "fit.toml", "--to", "table", "--out", "out", "--stock"},
           {"export", "fit.toml", "--to", "lammps", "--out", "out", "--parameters", "fit.toml"}}) {
    const Outcome run = place.run(words);
    EXPECT_EQ(run.status, 2) << run.out;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_EQ(place.listing(), before);
  }
}

}  // namespace
