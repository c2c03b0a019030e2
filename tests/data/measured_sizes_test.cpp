// Size distributions: reading them, and the two that ship with datasets.
#include "data/measured_sizes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/mistake.hpp"
#include "support/temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;
using recoil::load_sizes;
using recoil::MeasuredSizes;

/// A folder of its own with a sizes.csv in it.
class Sizes : public testing::Test {
 protected:
  MeasuredSizes read(const std::string& text, const std::string& unit = "") const {
    folder_.write("sizes.csv", text);
    return load_sizes(folder_ / "sizes.csv", unit);
  }
  std::string complaint(const std::string& text, const std::string& unit = "") const {
    return support::message_of([&] { read(text, unit); });
  }

  support::TemporaryFolder folder_;
};

TEST_F(Sizes, CountsOfDiameters) {
  const MeasuredSizes sizes = read("diameter,count\n60,1\n40,3\n60,2\n80,0\n");
  ASSERT_EQ(sizes.bins.size(), 2U);
  EXPECT_DOUBLE_EQ(sizes.bins[0].diameter, 40e-6);
  EXPECT_DOUBLE_EQ(sizes.bins[0].weight, 3.0);
  EXPECT_DOUBLE_EQ(sizes.bins[1].weight, 3.0);
  EXPECT_DOUBLE_EQ(sizes.mean_diameter(), 50e-6);
  EXPECT_DOUBLE_EQ(sizes.smallest, 40e-6);
  EXPECT_DOUBLE_EQ(sizes.largest, 60e-6);
}

TEST_F(Sizes, TwoColumnsOfOneMeaningOrMoreSizesThanAreSimulated) {
  EXPECT_THAT(complaint("diameter,count,weight\n1,2,3\n"),
              testing::HasSubstr("sizes.csv:1:16: 'weight' is a second column"));
  std::string many = "diameter,count\n";
  for (int i = 1; i <= 2'001; ++i) many += std::to_string(i) + "e-3,1\n";
  EXPECT_THAT(complaint(many), testing::HasSubstr("sort them into bins"));
}

TEST_F(Sizes, AHeightOfTheProbeBesideThemHasToBeOne) {
  folder_.write("datapackage.json",
                R"({"resources": [{"path": "sizes.csv", "probe_height": -1}]})");
  EXPECT_THAT(complaint("diameter,count\n60,1\n"),
              testing::HasSubstr("datapackage.json:1:54: probe_height = -1 m"));
}

TEST_F(Sizes, BinsWithEnds) {
  const MeasuredSizes sizes = read("lower,upper,fraction\n20,30,0.25\n30,40,0.75\n");
  EXPECT_NEAR(sizes.mean_diameter(), 32.5e-6, 1e-18);
  EXPECT_DOUBLE_EQ(sizes.smallest, 20e-6);
  EXPECT_DOUBLE_EQ(sizes.largest, 40e-6);
  const auto spread = recoil::spread_within_bins(sizes.bins, 4);
  ASSERT_EQ(spread.size(), 8U);
  EXPECT_NEAR(spread.front().diameter, 21.25e-6, 1e-18);
  double weight = 0.0;
  double mean = 0.0;
  for (const recoil::SizeBin& bin : spread) {
    weight += bin.weight;
    mean += bin.weight * bin.diameter;
  }
  EXPECT_NEAR(weight, 1.0, 1e-14);
  EXPECT_NEAR(mean, 32.5e-6, 1e-18);
}

TEST_F(Sizes, SingleDiametersAreOneParticleEach) {
  EXPECT_DOUBLE_EQ(read("diameter\n1\n1\n4\n").total(), 3.0);
}

TEST_F(Sizes, TheUnitIsThatOfTheOptionThenOfThePackage) {
  EXPECT_DOUBLE_EQ(read("diameter\n2\n", "mm").bins[0].diameter, 2e-3);
  folder_.write(
      "datapackage.json",
      R"({"resources": [{"path": "points.csv"}, {"path": "sizes.csv", "provenance": "measured",
            "description": "by PDPA", "probe_height": 0.002,
            "schema": {"fields": [{"name": "diameter", "unit": "mm"}]}}]})");
  const MeasuredSizes sizes = read("diameter\n0.05\n");
  EXPECT_DOUBLE_EQ(sizes.bins[0].diameter, 50e-6);
  EXPECT_EQ(sizes.provenance, "measured");
  EXPECT_EQ(sizes.description, "by PDPA");
  EXPECT_DOUBLE_EQ(*sizes.probe_height, 0.002);
  EXPECT_DOUBLE_EQ(read("diameter\n50\n", "um").bins[0].diameter, 50e-6);
}

TEST_F(Sizes, MistakesSayWhereTheyAre) {
  using testing::HasSubstr;
  EXPECT_THAT(complaint("diameter,count\n40,3\nx,1\n"), HasSubstr("sizes.csv:3:1: 'x' is not a"));
  EXPECT_THAT(complaint("diameter,count\n40,-3\n"), HasSubstr("sizes.csv:2:4: -3 particles"));
  EXPECT_THAT(complaint("d,count\n40,3\n"), HasSubstr("sizes.csv:1:1: unknown column 'd'"));
  EXPECT_THAT(complaint("count\n3\n"), HasSubstr("neither 'diameter' nor 'lower'"));
  EXPECT_THAT(complaint("lower,upper\n3,2\n"),
              HasSubstr("sizes.csv:2:3: upper = 2 lies below lower"));
  EXPECT_THAT(complaint("diameter,count\n"), HasSubstr("no particles"));
  EXPECT_THAT(complaint("diameter\n40\n", "inch"), HasSubstr("unknown unit 'inch'"));
  EXPECT_THAT(complaint("diameter\n-1\n"), HasSubstr("a diameter of -1"));
}

/// What is published, and the log-normal shape that is assumed.
void expect_shipped(const std::string& id, double lower, double upper, double d10, double median,
                    double log_sd) {
  const auto sizes = recoil::sizes_of_dataset(fs::path(RECOIL_SOURCE_DIR) / "datasets" / id);
  ASSERT_TRUE(sizes.has_value()) << id;
  EXPECT_NEAR(sizes->smallest, lower, 1e-12) << id;
  EXPECT_NEAR(sizes->largest, upper, 1e-12) << id;
  EXPECT_NEAR(sizes->mean_diameter(), d10, 0.5e-6) << id;
  EXPECT_EQ(sizes->provenance, "reconstruction") << id;
  EXPECT_NE(sizes->description.find("Assumed"), std::string::npos) << id;
  const auto below = [&](double d) {
    return 0.5 * std::erfc(-std::log(d / median) / (log_sd * std::sqrt(2.0)));
  };
  for (const recoil::SizeBin& bin : sizes->bins) {
    const double part =
        (below(bin.diameter + bin.width / 2) - below(bin.diameter - bin.width / 2)) /
        (below(upper) - below(lower));
    EXPECT_NEAR(bin.weight, part, 6e-6) << id << " " << bin.diameter;
  }
}

TEST(ShippedSizes, AreWhatTheirDescriptionSays) {
  expect_shipped("li1999-sst65-silicon", 20e-6, 110e-6, 49e-6, 46.3e-6, 0.35);
  expect_shipped("li1999-sst125-silicon", 60e-6, 125e-6, 75e-6, 72.3e-6, 0.15);
}

}  // namespace
