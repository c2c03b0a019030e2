// The benchmark's data, its arithmetic and its table. Nothing here is timed.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/files.hpp"
#include "design.hpp"
#include "impact/impact.hpp"
#include "measure.hpp"
#include "support/temporary_folder.hpp"
#include "table.hpp"

namespace recoil::bench {
namespace {

namespace fs = std::filesystem;

/// A folder with the peers' case, removed afterwards.
class PeerCase : public ::testing::Test {
 protected:
  void SetUp() override { write_peer_case(folder_.path()); }

  /// The columns of points.csv after the series, line by line.
  std::vector<std::vector<double>> rows() const {
    std::ifstream file(folder_ / "points.csv");
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line, "series,diameter,incident_velocity,restitution,restitution_sd");
    std::vector<std::vector<double>> table;
    while (std::getline(file, line)) {
      std::istringstream cells(line.substr(line.find(',') + 1));
      table.emplace_back();
      for (std::string cell; std::getline(cells, cell, ',');) {
        table.back().push_back(std::stod(cell));
      }
    }
    return table;
  }

  support::TemporaryFolder folder_;
};

TEST_F(PeerCase, HasFourDiametersOfFifteenVelocitiesAboveCapture) {
  std::map<double, std::set<double>> velocities;
  for (const auto& row : rows()) velocities[row.at(0)].insert(row.at(1));
  ASSERT_EQ(velocities.size(), 4U);
  for (const auto& [diameter, of_diameter] : velocities) {
    EXPECT_EQ(of_diameter.size(), 15U) << diameter;
    EXPECT_EQ(*of_diameter.rbegin(), 60.0) << diameter;
    // Three digits of 1.1 times the velocity below which these spheres stay.
    const double capture = true_capture_velocity(truth(), diameter * 1e-6);
    EXPECT_NEAR(*of_diameter.begin() / capture, 1.1, 0.0056) << diameter;
  }
}

/// The data come from GSL's integrator; this is another one.
double restitution_by_cvodes(double diameter, double velocity) {
  const Truth nature = truth();
  const double f0 = nature.adhesion_force * std::cbrt(diameter / nature.reference_diameter);
  const ImpactResult impact =
      simulate_impact(impact_groups({diameter, velocity, nature.density, nature.stiffness, f0,
                                     nature.C_H, nature.C_A}),
                      {});
  return std::sqrt(impact.restitution_squared);
}

TEST_F(PeerCase, NoiseIsTwoPercentAndNormal) {
  double sum = 0.0, squares = 0.0;
  const auto table = rows();
  for (const auto& row : table) {
    const double e = row.at(3) / 0.02;
    EXPECT_NEAR(e, restitution_by_cvodes(row.at(0) * 1e-6, row.at(1)), 1e-8);
    const double z = (row.at(2) - e) / row.at(3);
    EXPECT_LT(std::abs(z), 4.0);
    sum += z;
    squares += z * z;
  }
  const double n = static_cast<double>(table.size());
  EXPECT_NEAR(sum / n, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1.0, 4.0 * std::sqrt(2.0 / n));
}

TEST_F(PeerCase, ThePeersAreToldWhatRecoilIsTold) {
  const Json constants = Json::parse(read_text_file(folder_ / "constants.json"));
  const Case loaded = load_case(folder_ / "fit.toml");
  const ImpactModel& model = loaded.model;
  EXPECT_EQ(constants.at("density").get<double>(), model.contacts.at(0).particle_density);
  EXPECT_EQ(constants.at("stiffness").get<double>(), model.contacts.at(0).stiffness);
  EXPECT_EQ(constants.at("reference_diameter").get<double>(),
            model.contacts.at(0).reference_diameter);
  std::string csv = "density,stiffness,reference_diameter,start_C_H,start_C_A,start_f0\n";
  for (const ParameterSlot& slot : model.slots) {
    EXPECT_TRUE(slot.free) << slot.parameter->name;
    EXPECT_EQ(constants.at("start").at(slot.parameter->name).get<double>(), slot.initial)
        << slot.parameter->name;
  }
  EXPECT_EQ(read_text_file(folder_ / "constants.csv"),
            csv + "1350,1789000000,4.9e-06,0.0015,0.06,8\n");
}

TEST_F(PeerCase, IsFittedToWhereItCameFrom) {
  const Case loaded = load_case(folder_ / "fit.toml");
  FitOptions options;
  options.several_starts = false;
  const FitResult fitted = fit(loaded.model, loaded.data, options);
  ASSERT_TRUE(fitted.usable) << fitted.failure;
  const std::vector<double> nature = {truth().C_H, truth().C_A, truth().adhesion_force};
  for (std::size_t j = 0; j < 3; ++j) {
    EXPECT_LT(std::abs(fitted.theta[j] - nature[j]), 4.0 * fitted.std_error[j]) << j;
    EXPECT_LT(fitted.std_error[j], 0.15 * nature[j]) << j << ": hardly determined";
  }
  EXPECT_GT(fitted.p_value, 1e-3);
}

TEST(LargeCase, HasThePointsAndTheParametersThatItIsAskedFor) {
  for (const int parameters : {1, 2, 3, 4, 10}) {
    const Case large = large_case(403, parameters);
    EXPECT_EQ(large.data.points.size(), 403U);
    int free_count = 0;
    for (const ParameterSlot& slot : large.model.slots) free_count += slot.free ? 1 : 0;
    EXPECT_EQ(free_count, parameters);
    for (const Observation& point : large.data.points) EXPECT_GT(point.restitution, 0.0);
  }
}

TEST(LargeCase, ComesFromTheModelThatFitsIt) {
  const Case large = large_case(2000, 5);
  FitOptions options;
  options.several_starts = false;
  const FitResult fitted = fit(large.model, large.data, options);
  ASSERT_TRUE(fitted.usable) << fitted.failure;
  // 1995 degrees of freedom: chi2 / dof is 1 within 0.032; the table's interpolation adds little.
  EXPECT_NEAR(fitted.chi2 / fitted.dof, 1.0, 0.13);
}

TEST(Measure, ExponentOfAPowerLawIsItsExponent) {
  std::vector<double> sizes, costs;
  for (const double size : {1e2, 1e3, 1e4, 1e6}) {
    sizes.push_back(size);
    costs.push_back(3e-7 * std::pow(size, 1.25));
  }
  EXPECT_NEAR(growth_exponent(sizes, costs), 1.25, 1e-12);
  // By hand: ln y = 0, 1, 1 at ln x = 0, 1, 2 has slope 1/2.
  EXPECT_NEAR(growth_exponent({1.0, M_E, M_E * M_E}, {1.0, M_E, M_E}), 0.5, 1e-12);
}

TEST(Measure, MedianIsTheMiddle) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 9.0}), 3.0);
}

TEST(Table, ReplacesOnlyWhatIsBetweenTheMarkers) {
  const std::string before = std::string("a\n") + begin_marker + "old\n" + end_marker + "b\n";
  EXPECT_EQ(between_markers(before), "old\n");
  EXPECT_EQ(with_block(before, "new\nlines\n"),
            std::string("a\n") + begin_marker + "new\nlines\n" + end_marker + "b\n");
  EXPECT_THROW(with_block("a\nb\n", "new\n"), std::invalid_argument);
  EXPECT_THROW(with_block(std::string(end_marker) + begin_marker, "new\n"), std::invalid_argument);
  EXPECT_THROW(with_block(before + before, "new\n"), std::invalid_argument);
}

TEST(Table, PutsEarlierFiguresBesideTheirLikes) {
  const Json results = Json::parse(R"({
    "impact_with_gradient": {"fast_ns": 500.0, "reference_ns": 2e6, "laws": [{"adhesion": "jkr", "fast_ns": 800.0}]},
    "bootstrap": {"scaling": [{"threads": 1, "seconds": 0.4}]},
    "peer": {"fits": [{"seconds_of_full_fit": 0.02}]},
    "shipped_fits": {"fits": 7, "pages": 8, "seconds": 50.0},
    "scaling": [{"points": 100, "seconds": 0.001, "peak_memory_mb": 17.0},
                {"points": 1000000, "seconds": 4.0, "peak_memory_mb": 430.0}]})");
  const Json earlier = Json::parse(R"({"of": "a version", "reference_seconds": 1e-3, "figures": [
    {"what": "one", "key": "ring", "seconds": 1e-6},
    {"what": "two", "key": "jkr", "seconds": 1.6e-6},
    {"what": "three", "key": "refits_1", "seconds": 0.6},
    {"what": "four", "key": "refits_16", "seconds": 0.1},
    {"what": "five", "key": "points_1000000", "seconds": 16.0, "memory_mb": 1254.0},
    {"what": "six", "key": "shipped_fits", "seconds": 75.0}]})");
  const std::string text = earlier_section(results, earlier);
  EXPECT_NE(text.find("of a version."), std::string::npos) << text;
  for (const char* row :
       {"| one | 1 us | 500 ns | 2 | 4 |\n", "| two | 1.6 us | 800 ns | 2 | 4 |\n",
        "| three | 600 ms | 400 ms | 1.5 | 3 |\n",
        "| five | 16 s, 1254 MB | 4 s, 430 MB | 4 | 8 |\n", "| six | 75 s | 50 s | 1.5 | 3 |\n"}) {
    EXPECT_NE(text.find(row), std::string::npos) << row << text;
  }
  EXPECT_EQ(text.find("four"), std::string::npos) << "there is no figure of 16 threads to compare";
}

/// The cells of the rows of a Markdown table, without its head.
std::vector<std::vector<std::string>> cells_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| ", 0) != 0 || line.rfind("| what", 0) == 0) continue;
    std::istringstream row(line.substr(1));
    rows.emplace_back();
    for (std::string cell; std::getline(row, cell, '|');) {
      const std::size_t begin = cell.find_first_not_of(' ');
      rows.back().push_back(begin == std::string::npos ? "" : cell.substr(begin));
    }
  }
  return rows;
}

/// "22.5 us ..." in seconds.
double seconds_in(const std::string& cell) {
  static const std::map<std::string, double> units = {{"ns", 1e-9}, {"us", 1e-6},  {"ms", 1e-3},
                                                      {"s", 1.0},   {"min", 60.0}, {"h", 3600.0}};
  std::istringstream stream(cell);
  double value = 0.0;
  std::string unit;
  stream >> value >> unit;
  return value * units.at(unit.substr(0, unit.find_first_not_of("numsih")));
}

TEST(Table, TheManualQuotesTheLastRun) {
  const fs::path root = RECOIL_SOURCE_DIR;
  const std::string block = between_markers(read_text_file(root / "docs/speed.md"));
  EXPECT_EQ(block, between_markers(read_text_file(root / "reports/benchmark.md")));

  int ratios = 0;
  for (const std::vector<std::string>& row : cells_of(block)) {
    ASSERT_GE(row.size(), 4U);
    std::string digits = row[3];
    std::erase(digits, ',');
    if (digits.empty()) continue;
    const double ratio = std::stod(digits);
    // Two digits of the ratio and three of each time.
    EXPECT_NEAR(ratio * seconds_in(row[1]) / seconds_in(row[2]), 1.0, 0.07) << row[0];
    ++ratios;
  }
  EXPECT_GE(ratios, 2);
}

}  // namespace
}  // namespace recoil::bench
