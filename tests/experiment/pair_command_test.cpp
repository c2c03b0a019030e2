// `recoil pair` as a user runs it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "core/files.hpp"
#include "data/measured_sizes.hpp"
#include "support/workplace.hpp"
#include "validation/recipe/recipe.hpp"
#include "validation/recipe/reconstruction.hpp"
#include "validation/synthetic/event_stream.hpp"

namespace {

using support::Outcome;
using support::Workplace;

const std::string kUnits = "time=s,velocity=m/s,tangential_velocity=m/s,diameter=um";

stream::Stream small_stream() {
  stream::Design design;
  design.spheres = 600;
  design.damaged = 0.01;
  return stream::simulate(design);
}

TEST(PairCommand, EventsToADatasetThatCheckAccepts) {
  const Workplace place;
  const stream::Stream events = small_stream();
  place.write("e.csv", events.csv);
  const Outcome pair = place.run({"pair", "e.csv", "--unit", kUnits, "--out", "points.csv",
                                  "--into", "set", "--like", "data", "--provenance", "synthetic",
                                  "--size-classes", "2", "--impacts", "i.csv"});
  ASSERT_EQ(pair.status, 0) << pair.err;
  EXPECT_NE(pair.out.find("damaged rows left out"), std::string::npos) << pair.out;
  EXPECT_EQ(place.read("points.csv"), place.read("set/points.csv"));
  EXPECT_NE(place.read("i.csv").find(",rebounded\n"), std::string::npos);
  const Outcome check = place.run({"check", "set"});
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_NE(check.out.find("synthetic"), std::string::npos);
  EXPECT_NE(check.out.find("in 2 series"), std::string::npos) << check.out;
}

// Dantec's columns, decimal commas, a preamble, and the micro sign of Windows-1252.
TEST(PairCommand, AnInstrumentsFileGivesTheSamePoints) {
  const Workplace place;
  stream::Design design;
  design.spheres = 300;
  std::string text = stream::simulate(design).csv;
  place.write("plain.csv", text);
  std::replace(text.begin(), text.end(), ',', '\t');
  std::replace(text.begin(), text.end(), '.', ',');
  const std::size_t rows = text.find('\n');
  std::string header = "\t" + text.substr(0, rows) + "\t";
  for (const auto& [name, title] : {std::pair("\ttime\t", "\t\"AT [s]\"\t"),
                                    {"\tvelocity\t", "\t\"LDA1 [m/s]\"\t"},
                                    {"\ttangential_velocity\t", "\t\"LDA2 [m/s]\"\t"},
                                    {"\tdiameter\t", "\t\"D [\xB5m]\"\t"}}) {
    const std::size_t at = header.find(name);
    ASSERT_NE(at, std::string::npos) << name;
    header.replace(at, std::string(name).size(), title);
  }
  place.write("bsa.txt", "DXEX v5\nrun7.lda\n1;0,00 mm\n" + header.substr(1) + text.substr(rows));
  const Outcome plain =
      place.run({"pair", "plain.csv", "--unit", kUnits, "--out", "plain-points.csv"});
  ASSERT_EQ(plain.status, 0) << plain.err;
  const Outcome bsa = place.run(
      {"pair", "bsa.txt", "--column", "velocity=LDA1,tangential_velocity=LDA2", "--out", "p.csv"});
  ASSERT_EQ(bsa.status, 0) << bsa.err;
  EXPECT_EQ(place.read("p.csv"), place.read("plain-points.csv"));
}

TEST(PairCommand, PrintedConstantsOfTheOtherDatasetAreNotTakenOver) {
  const Workplace place;
  place.write("e.csv", small_stream().csv);
  const auto steel = std::filesystem::path(RECOIL_SOURCE_DIR) / "datasets/li1999-sst65-silicon";
  const Outcome pair = place.run({"pair", "e.csv", "--unit", kUnits, "--into", "set", "--like",
                                  steel.string(), "--provenance", "synthetic"});
  ASSERT_EQ(pair.status, 0) << pair.err;
  const std::string said = std::regex_replace(pair.out, std::regex("\\s+"), " ");
  EXPECT_NE(said.find("stiffness_K = 11.4 GPa (derived: 113.5 GPa), "
                      "adhesion_force_f0 = 288 N/m (derived: 308.9 N/m)"),
            std::string::npos)
      << pair.out;
  const auto made = nlohmann::json::parse(place.read("set/datapackage.json"))["recoil"];
  EXPECT_FALSE(made.contains("stiffness_K"));
  EXPECT_FALSE(made.contains("adhesion_force_f0"));
  EXPECT_EQ(made["adhesion_energy"], 2.72);
}

TEST(PairCommand, PairsThatAreMostlyFalseAreSaidToBeSo) {
  const Workplace place;
  place.write("e.csv", small_stream().csv);
  const Outcome right = place.run({"pair", "e.csv", "--unit", kUnits});
  EXPECT_EQ(right.out.find("warning"), std::string::npos) << right.out;
  const Outcome wrong = place.run({"pair", "e.csv", "--unit", kUnits, "--height", "500"});
  EXPECT_NE(wrong.out.find("warning"), std::string::npos) << wrong.out;
  EXPECT_NE(wrong.out.find("(--height)"), std::string::npos) << wrong.out;
}

TEST(PairCommand, WritesHistograms) {
  const Workplace place;
  place.write("e.csv", small_stream().csv);
  ASSERT_EQ(place.run({"pair", "e.csv", "--unit", kUnits, "--histograms", "h"}).status, 0);
  EXPECT_EQ(place.read("h/sizes.csv").rfind("lower,upper,count\n", 0), 0U);
  const std::string bins = place.read("h/velocities-raw.csv");
  EXPECT_NE(bins.find("\nsturges,"), std::string::npos);
  EXPECT_NE(bins.find("\nfreedman-diaconis,"), std::string::npos);
}

TEST(PairCommand, MixedSizesTravelWithTheirPoints) {
  const Workplace place;
  const stream::Stream events = small_stream();
  place.write("e.csv", events.csv);
  ASSERT_EQ(place
                .run({"pair", "e.csv", "--unit", kUnits, "--into", "set", "--like", "data",
                      "--provenance", "synthetic"})
                .status,
            0);
  EXPECT_EQ(place.run({"check", "set"}).status, 0);
  const recoil::MeasuredSizes sizes = recoil::load_sizes(place.path() / "set/sizes.csv");
  EXPECT_EQ(sizes.provenance, "synthetic");
  EXPECT_NEAR(sizes.probe_height.value_or(0.0), 1.04e-3, 5e-6);
  EXPECT_NEAR(sizes.mean_diameter(), 49e-6, 2e-6);  // d10 of the stream's distribution
  EXPECT_NEAR(sizes.total(), 600.0, 40.0);
}

TEST(PairCommand, MeanDiameterIsOneForAllPoints) {
  const Workplace place;
  place.write("e.csv", small_stream().csv);
  const auto sizes_with = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments = {"pair", "e.csv", "--unit", kUnits, "--out", "p.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(place.run(arguments).status, 0);
    std::istringstream lines(place.read("p.csv"));
    std::set<std::string> sizes;
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
      const std::size_t from = line.find(',') + 1;
      sizes.insert(line.substr(from, line.find(',', from) - from));
    }
    return sizes;
  };
  EXPECT_GT(sizes_with({}).size(), 5U);
  const std::set<std::string> one = sizes_with({"--mean-diameter"});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(std::stod(*one.begin()), 49.0, 2.0);  // d10 of the stream's distribution [um]
  EXPECT_EQ(sizes_with({"--mean-diameter", "--size-classes", "3"}).size(), 3U);
}

/// The committed points of the steel reconstructions are what the two commands of README make.
TEST(PairCommand, TheShippedPointsComeFromEvents) {
  for (const std::string id : {"li1999-sst65-silicon", "li1999-sst125-silicon"}) {
    const std::filesystem::path folder = std::filesystem::path(RECOIL_SOURCE_DIR) / "datasets" / id;
    const Workplace place;
    const recoil::Recipe recipe = recoil::load_recipe(folder);
    place.write("e.csv", recoil::draw_passages(recipe, recipe.seed, 1));
    const Outcome pair =
        place.run({"pair", "e.csv", "--unit", kUnits, "--height", "1", "--angle", "8", "--per-bin",
                   "40", "--mean-diameter", "--out", "points.csv"});
    ASSERT_EQ(pair.status, 0) << pair.err;
    EXPECT_EQ(place.read("points.csv"), recoil::read_text_file(folder / "points.csv")) << id;
    const recoil::ReconstructionResult check = recoil::reconstruct(folder, true);
    EXPECT_TRUE(check.good()) << check.difference;
    EXPECT_TRUE(check.from_events) << id;
  }
}

TEST(PairCommand, TheSameDigitsEveryTime) {
  const Workplace place;
  place.write("e.csv", small_stream().csv);
  const Outcome first = place.run({"pair", "e.csv", "--unit", kUnits, "--out", "a.csv"});
  const Outcome second = place.run({"pair", "e.csv", "--unit", kUnits, "--out", "b.csv"});
  EXPECT_EQ(first.out, second.out);
  EXPECT_EQ(place.read("a.csv"), place.read("b.csv"));
}

TEST(PairCommand, ThresholdStatesItsSelection) {
  const Workplace place;
  place.write("e.csv", small_stream().csv);
  const Outcome pair =
      place.run({"pair", "e.csv", "--unit", kUnits, "--threshold", "0.7", "--angle", "8"});
  ASSERT_EQ(pair.status, 0) << pair.err;
  EXPECT_NE(pair.out.find("0.7 m/s at the plane: removes"), std::string::npos);
  EXPECT_TRUE(std::regex_search(pair.out, std::regex("Selection:\\s+among\\s+first")));
  EXPECT_NE(pair.out.find("more than 8 degrees from the normal"), std::string::npos);
}

TEST(PairCommand, MistakesAreOneLineAndWriteNothing) {
  const Workplace place;
  place.write("e.csv", small_stream().csv);
  const auto before = place.listing();
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"pair", "none.csv"}, "none.csv: no such file"},
      {{"pair", "e.csv", "--out", "p.csv"}, "the unit of 'time' is not known"},
      {{"pair", "e.csv", "--unit", "time"}, "'time' is not FIELD=UNIT"},
      {{"pair", "e.csv", "--unit", kUnits, "--unit", "time=ms"}, "time is given twice"},
      {{"pair", "e.csv", "--unit", kUnits, "--into", "set"}, "--like"},
      {{"pair", "e.csv", "--unit", kUnits, "--into", "set", "--like", "data"},
       "the provenance of the passages is not known"},
      {{"pair", "e.csv", "--unit", kUnits, "--into", "set", "--like", "set", "--provenance",
        "measured"},
       "set/datapackage.json: no such file"},
      {{"pair", "e.csv", "--unit", kUnits, "--size-edges", "40,20"}, "not in ascending order"},
      {{"pair", "e.csv", "--unit", kUnits, "--size-edges", "40"}, "a size class needs two limits"},
      {{"pair", "e.csv", "--unit", kUnits, "--height", "-1"}, "--height"},
  };
  for (const auto& [arguments, expected] : cases) {
    const Outcome outcome = place.run(arguments);
    EXPECT_EQ(outcome.status, 2) << expected << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(expected), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(place.listing(), before) << expected;
  }
}

TEST(PairCommand, NoImpactsIsNoUsableAnswer) {
  const Workplace place;
  place.write("e.csv", "time,velocity,diameter\n1,1,50\n2,-1,50\n");
  const Outcome outcome = place.run(
      {"pair", "e.csv", "--unit", "time=s,velocity=m/s,diameter=um", "--out", "points.csv"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("check --height, the units and --positive"), std::string::npos);
}

}  // namespace
