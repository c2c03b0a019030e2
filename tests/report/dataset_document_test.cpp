#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <limits>

#include "report/dataset_report.hpp"
#include "report/words_dataset.hpp"
#include "support/dataset_folder.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;

Dataset dataset_of(const std::string& package, const std::string& points = example::points) {
  return parse_dataset(package, points, "folder");
}

/// The value of the row `name`; empty if there is no such row.
std::string value_of(const Table& table, const std::string& name) {
  for (const auto& row : table.rows) {
    if (plain_text(words_of_cell(row[0])) == name) return plain_text(words_of_cell(row[1]));
  }
  return "";
}

std::vector<std::string> titles(const Dataset& dataset) {
  std::vector<std::string> shown;
  for (const Section& section : dataset_sections(dataset)) {
    if (!empty(section)) shown.push_back(plain_text(section.title));
  }
  return shown;
}

TEST(DatasetDocument, SaysWhatWasReadWithUnits) {
  const Dataset dataset = dataset_of(example::package);
  const Table table = dataset_table(dataset);
  EXPECT_EQ(value_of(table, "dataset"), "example-quartz");
  EXPECT_EQ(value_of(table, "title"), dataset.title);
  EXPECT_EQ(value_of(table, "provenance"), "measured");
  EXPECT_THAT(value_of(table, "particle"),
              HasSubstr("polystyrene, density 1050 kg/m3, E 2.56 GPa"));
  EXPECT_THAT(value_of(table, "surface"), HasSubstr("quartz, E 73 GPa"));
  EXPECT_THAT(value_of(table, "columns"), HasSubstr("restitution_sd [%]"));
  EXPECT_EQ(value_of(table, "points"), "4 in 2 series");
  EXPECT_EQ(value_of(table, "stated"), "");
  EXPECT_EQ(value_of(table, "known to"), "");
  EXPECT_EQ(value_of(table, "sizes"), "");
  EXPECT_THAT(titles(dataset), testing::ElementsAre("Dataset", "Series", "Sources"));
}

TEST(DatasetDocument, SaysThatNormalComponentsAreUsed) {
  const std::string package = support::changed(
      example::package, "{ \"name\": \"restitution_sd\"",
      "{ \"name\": \"incidence_angle\", \"type\": \"number\", \"unit\": \"deg\" },\n"
      "{ \"name\": \"restitution_sd\"");
  const Dataset dataset = dataset_of(
      package,
      "series,diameter,incident_velocity,restitution,incidence_angle,restitution_sd,velocity_sd,"
      "events,captured\n"
      "a,5,2,0.7,5,,,,\na,5,3,0.8,0,,,,\na,5,4,0.8,12.5,,,,\na,5,5,0.8,31,,,,\n");
  EXPECT_THAT(value_of(dataset_table(dataset), "velocities"),
              HasSubstr("the normal component of the velocity, incident_velocity times "
                        "cos(incidence_angle), of 3 points at up to 31 degrees"));
  ASSERT_EQ(dataset.warnings.size(), 1U);
  EXPECT_THAT(warning_sentence(dataset.warnings.front()),
              testing::StartsWith("2 points with an angle of incidence above 8 degrees (first in "
                                  "line 4): kept, up to 31 degrees"));
  EXPECT_EQ(value_of(dataset_table(dataset_of(example::package)), "velocities"), "");
}

TEST(DatasetDocument, ShowsOverridesAndWarnings) {
  const Dataset dataset =
      dataset_of(support::changed(example::package, "\"provenance\"",
                                  "\"stiffness_K\": 3.745e9, \"adhesion_energy\": 0.235,\n"
                                  "\"adhesion_force_f0\": 5.74, \"reference_diameter\": 1.28e-6,"
                                  "\"provenance\""),
                 support::changed(example::points, "0.912", "1.1"));
  EXPECT_EQ(value_of(dataset_table(dataset), "stated"),
            "K 3.745 GPa, adhesion energy 0.235 J/m2, f0 5.74 N/m, reference diameter 1.28 um");
  EXPECT_THAT(titles(dataset), testing::Contains("Warnings"));
}

TEST(DatasetDocument, SumsUpEverySeries) {
  const Dataset dataset = dataset_of(example::package);
  const Table table = series_table(dataset);
  ASSERT_EQ(table.rows.size(), 2U);
  double points = 0.0;
  for (const auto& row : table.rows) points += std::get<Number>(row[2]).value;
  EXPECT_EQ(points, 4.0);
  EXPECT_EQ(plain_text(words_of_cell(table.rows[0][0])), dataset.series[0]);
}

/// Processor time of `recoil check` [s], the smallest of three runs.
double cost_of_check(const std::string& title, std::size_t series) {
  std::string points =
      "series,diameter,incident_velocity,restitution,restitution_sd,velocity_sd,"
      "events,captured\n";
  for (std::size_t i = 0; i < series; ++i) {
    points += "s" + std::to_string(i) + ",4.9," + std::to_string(i + 1) + "e-5,0.9,,,,\n";
  }
  const std::string package = support::changed(example::package, "Spheres on quartz", title);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const std::clock_t begin = std::clock();
    EXPECT_GT(dataset_text(dataset_of(package, points)).size(), title.size() + series);
    least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return least;
}

// 16 times as much costs 16 times as much where the cost is linear, and 256 times where it is
// quadratic.
TEST(DatasetDocument, TheCostOfACheckIsLinearInTheSeries) {
  EXPECT_LT(cost_of_check("title", 32'000), 64.0 * cost_of_check("title", 2'000));
}

TEST(DatasetDocument, TheCostOfACheckIsLinearInTheTitle) {
  for (const std::string piece : {"x", "x ", "ü", "*", "`", "[", "<"}) {
    std::string few, many;
    for (int i = 0; i < 60'000; ++i) few += piece;
    for (int i = 0; i < 16; ++i) many += few;
    EXPECT_LT(cost_of_check(many, 1), 64.0 * cost_of_check(few, 1)) << piece;
  }
}

TEST(Provenance, EachHasItsOneSentence) {
  for (const Provenance provenance : {Provenance::measured, Provenance::digitised,
                                      Provenance::reconstruction, Provenance::synthetic}) {
    const std::string sentence = provenance_sentence(provenance);
    EXPECT_EQ(std::count(sentence.begin(), sentence.end(), '.'), 1) << sentence;
    Dataset dataset = dataset_of(example::package);
    dataset.provenance = provenance;
    EXPECT_EQ(value_of(dataset_table(dataset), "provenance"), to_string(provenance));
    const auto sections = dataset_sections(dataset);
    const auto* words = std::get_if<Paragraph>(&sections[0].blocks.at(1).content());
    ASSERT_NE(words, nullptr);
    EXPECT_EQ(plain_text(words->text), sentence);
  }
}

TEST(Provenance, AReconstructionSaysThatNothingWasMeasured) {
  EXPECT_THAT(provenance_sentence(Provenance::reconstruction), HasSubstr("not measured"));
}

TEST(DatasetDocument, SaysHowWellConstantsAreKnownAndWhichSizesAreMixed) {
  Dataset dataset = dataset_of(example::package);
  dataset.system.errors = {{Body::particle, Constant::youngs_modulus, 0.256e9},
                           {Body::surface, Constant::poisson_ratio, 0.02}};
  dataset.mixed_sizes.emplace();
  dataset.mixed_sizes->bins = {{1.5e-6, 1.0, 1e-6}, {2.5e-6, 1.0, 1e-6}};
  dataset.mixed_sizes->smallest = 1e-6;
  dataset.mixed_sizes->largest = 3e-6;
  dataset.mixed_sizes->probe_height = 1e-3;
  const Table table = dataset_table(dataset);
  EXPECT_EQ(value_of(table, "known to"),
            "particle: Young's modulus 10 %; surface: Poisson's ratio 0.02");
  EXPECT_THAT(value_of(table, "sizes"),
              HasSubstr("every point averages over 1 to 3 um (mean 2 um"));
  EXPECT_THAT(value_of(table, "sizes"), HasSubstr("rebounds below 0.14 m/s are not detected"));
}

}  // namespace
}  // namespace recoil
