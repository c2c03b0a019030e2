// What a design could have shown, where a batch is so clear that no data set hides it.
#include "diagnosis/rates.hpp"

#include <gtest/gtest.h>

#include <random>

#include "diagnosis/diagnose.hpp"
#include "quick_diagnosis.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

/// Four series with offsets of several standard deviations each.
Dataset four_batches() {
  synthetic::Design design;
  design.diameters = {2.58e-6, 3.42e-6, 4.9e-6, 6.89e-6};
  design.velocities = {4.5, 6.5, 9.0, 13.0, 20.0, 30.0, 50.0, 90.0};
  design.sd = 0.008;
  Dataset data = synthetic::dataset(design);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (ImpactPoint& point : data.points) {
    point.restitution += batch_offset[point.series] + 0.008 * normal(random);
  }
  return data;
}

TEST(DesignRates, NamesWhatEveryDataSetShowsAndLittleElse) {
  DiagnosisOptions options = quick();
  options.simulated = 99;
  const Diagnosis found = diagnose(synthetic::spec(), {four_batches()}, options);
  ASSERT_EQ(found.named(), std::vector<std::string>{"series_offset"});
  constexpr int datasets = 4;
  const DesignRates rates(found, datasets);
  ASSERT_EQ(rates.pieces(), 3U * datasets);
  std::vector<std::vector<double>> rows;
  for (std::size_t piece = 0; piece < rates.pieces(); ++piece) rows.push_back(rates.run(piece));
  EXPECT_EQ(rates.run(1), rows[1]);
  const OwnDesign design = rates.count(rows);
  ASSERT_EQ(design.detection.size(), 2U);
  for (const Detection& one : design.detection) {
    EXPECT_EQ(one.id, "series_offset");
    EXPECT_EQ(one.datasets, datasets);
    EXPECT_EQ(one.wrong, 0);
    EXPECT_EQ(one.named + one.listed, datasets) << one.strength;
  }
  EXPECT_EQ(design.detection[0].strength, 1.0);
  EXPECT_EQ(design.detection[1].strength, 0.5);
  EXPECT_EQ(design.datasets, datasets);
  // At most one of twenty each: two of four would be one chance in seventy.
  EXPECT_LE(design.alarms, 1);
}

}  // namespace
}  // namespace recoil
