// A diagnosis that takes what it has from an earlier run says what one says that has nothing.
#include "diagnosis/kept_pieces.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "quick_diagnosis.hpp"
#include "report/json_diagnosis.hpp"
#include "support/synthetic.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

constexpr std::size_t first_beside_calibration = std::size_t{1} << 32;

/// Points that no single mechanism explains, so that pairs are tried, and one of which is odd, so
/// that all is done twice.
Dataset hard_to_explain() {
  synthetic::Design design;
  design.diameters = {2.58e-6, 3.42e-6, 4.9e-6};
  design.velocities = {4.5, 7.0, 11.0, 18.0, 30.0, 60.0};
  design.sd = 0.01;
  Dataset data = synthetic::dataset(design);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (ImpactPoint& point : data.points) {
    const double away = std::log(point.incident_velocity / 15.0) / 0.4;
    const double dip = point.series == 1 ? 0.1 * std::exp(-0.5 * away * away) : 0.0;
    point.restitution = std::max(0.0, point.restitution - dip + 0.01 * normal(random));
  }
  data.points.back().restitution -= 0.3;
  return data;
}

DiagnosisOptions few() {
  DiagnosisOptions options = quick();
  options.simulated = 99;
  options.compared = 9;
  options.threads = 1;
  return options;
}

TEST(KeptPieces, AnyPartOfThemGivesTheSameAnswer) {
  const std::vector<Dataset> data = {hard_to_explain()};
  const FitSpec spec = synthetic::spec();
  const Diagnosis alone = diagnose(spec, data, few());
  ASSERT_FALSE(alone.pairs.empty());
  ASSERT_FALSE(alone.outlying.empty());
  const std::string expected = diagnosis_json(alone);

  const support::TemporaryFolder folder;
  DiagnosisOptions options = few();
  options.kept = std::make_shared<KeptRows>(folder / "all", "k");
  ASSERT_EQ(diagnosis_json(diagnose(spec, data, options)), expected);
  options.kept->keep();
  std::set<std::size_t> kinds;
  for (const auto& [piece, row] : options.kept->rows()) {
    kinds.insert(piece / first_beside_calibration);
  }
  // The calibration of both sets of data, and the three kinds of pieces of each.
  const std::size_t second = (options.pieces() + 1) * 4;
  EXPECT_EQ(kinds, (std::set<std::size_t>{0, 4, 5, 6, second, second + 1, second + 2}));

  options.kept = std::make_shared<KeptRows>(folder / "all", "k");
  const std::size_t all = options.kept->size();
  EXPECT_EQ(diagnosis_json(diagnose(spec, data, options)), expected);
  EXPECT_EQ(options.kept->size(), all);

  std::mt19937 random(1);
  auto some = std::make_shared<KeptRows>("", "");
  for (const auto& [piece, row] : options.kept->rows()) {
    if (random() % 2 == 0) some->put(piece, row);
  }
  options.kept = some;
  EXPECT_EQ(diagnosis_json(diagnose(spec, data, options)), expected);
  EXPECT_EQ(some->size(), all);
}

TEST(KeptPieces, AreWhatTheAnswerRestsOn) {
  const std::vector<Dataset> data = {hard_to_explain()};
  DiagnosisOptions options = few();
  options.kept = std::make_shared<KeptRows>("", "");
  const Diagnosis honest = diagnose(synthetic::spec(), data, options);
  for (const auto& [piece, row] : std::map(options.kept->rows())) {
    const std::size_t kind = piece / first_beside_calibration;
    const bool first_side = kind == 4 || kind == 6;  // singles and pairs of all points
    if (!first_side || row.empty()) continue;
    Json marked = row;
    marked[2][0] = -1e6;  // all gain the same
    options.kept->put(piece, marked);
  }
  const Diagnosis misled = diagnose(synthetic::spec(), data, options);
  EXPECT_NE(diagnosis_json(misled), diagnosis_json(honest));
}

TEST(KeptPieces, DamagedRowsAreRunAgain) {
  const std::vector<Dataset> data = {hard_to_explain()};
  DiagnosisOptions options = few();
  options.kept = std::make_shared<KeptRows>("", "");
  const std::string expected = diagnosis_json(diagnose(synthetic::spec(), data, options));
  for (const auto& [piece, row] : std::map(options.kept->rows())) {
    options.kept->put(piece, Json::object({{"no", "row"}}));
  }
  EXPECT_EQ(diagnosis_json(diagnose(synthetic::spec(), data, options)), expected);
}

TEST(KeptPieces, NumbersComeBackWhateverTheyAre) {
  const std::vector<double> values = {-0.0, 1.0 / 3.0, 5e-324, INFINITY, -INFINITY};
  const std::vector<double> back = row_of(Json::parse(row_json(values).dump()));
  EXPECT_EQ(back, values);
  EXPECT_TRUE(std::signbit(back.front()));
  EXPECT_TRUE(std::isnan(row_of(Json::parse(row_json({std::nan("")}).dump())).front()));
}

}  // namespace
}  // namespace recoil
