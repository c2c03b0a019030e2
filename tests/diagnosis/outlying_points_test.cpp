#include "diagnosis/outlying_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "diagnosis/diagnose.hpp"
#include "diagnosis/search.hpp"
#include "quick_diagnosis.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

constexpr double scatter_of_e = 0.008;

/// Sixty points of four sizes, from a model that loses `yielding` of the energy above 10 m/s beside
/// what the base model loses.
Dataset sixty_points(std::mt19937& random, double yielding) {
  synthetic::Design design;
  design.diameters = {2.58e-6, 3.42e-6, 4.9e-6, 6.89e-6};
  design.velocities = {4.5,  5.5,  6.5,  8.0,  10.0, 12.5, 15.0, 19.0,
                       24.0, 30.0, 37.0, 46.0, 58.0, 72.0, 90.0};
  design.sd = scatter_of_e;
  Dataset data = synthetic::dataset(design);
  std::normal_distribution<double> normal;
  for (ImpactPoint& point : data.points) {
    const double fast = std::log(std::max(point.incident_velocity / 10.0, 1.0));
    point.restitution = point.restitution * (1.0 - yielding * fast) + scatter_of_e * normal(random);
  }
  return data;
}

std::set<std::size_t> accused_in(const Dataset& data) {
  const std::vector<Dataset> datasets = {data};
  const FitSpec spec = synthetic::spec();
  const FitResult fitted = fit(make_model(spec, datasets), gather(datasets, spec.noise));
  std::set<std::size_t> indices;
  for (const OutlyingPoint& point : outlying_points(search_base(spec, datasets, fitted, quick()))) {
    indices.insert(point.index);
  }
  return indices;
}

/// Moves five points by 6 to 12 standard deviations of their scatter; returns which.
std::set<std::size_t> disturb_five(Dataset& data, std::mt19937& random) {
  std::uniform_int_distribution<std::size_t> any(0, data.points.size() - 1);
  std::uniform_real_distribution<double> by(6.0, 12.0);
  std::set<std::size_t> odd;
  while (odd.size() < 5) odd.insert(any(random));
  for (const std::size_t i : odd) {
    const double sign = random() % 2 == 0 ? 1.0 : -1.0;
    data.points[i].restitution =
        std::max(0.0, data.points[i].restitution + sign * by(random) * scatter_of_e);
  }
  return odd;
}

TEST(OutlyingPoints, AreFoundAndNoOthers) {
  for (const double yielding : {0.0, 0.1}) {  // the second: a model that is wrong by 20 sd
    std::mt19937 random(7);
    int odd = 0, found = 0, good = 0, accused = 0;
    for (int set = 0; set < 20; ++set) {
      Dataset data = sixty_points(random, yielding);
      const std::set<std::size_t> truth = disturb_five(data, random);
      const std::set<std::size_t> named = accused_in(data);
      for (const std::size_t i : named) (truth.contains(i) ? found : accused) += 1;
      odd += static_cast<int>(truth.size());
      good += static_cast<int>(data.points.size() - truth.size());
    }
    EXPECT_GE(found, (yielding > 0.0 ? 0.9 : 0.95) * odd) << yielding;
    EXPECT_LE(accused, 0.01 * good) << yielding;
  }
}

TEST(OutlyingPoints, AreRareWhereThereAreNone) {
  std::mt19937 random(11);
  int sets = 0;
  for (int set = 0; set < 60; ++set) sets += accused_in(sixty_points(random, 0.1)).empty() ? 0 : 1;
  // One set of twenty: more than eight of sixty would be one chance in two hundred.
  EXPECT_LE(sets, 8);
}

TEST(Diagnose, SetsOddPointsAsideFirst) {
  std::mt19937 random(3);
  Dataset data = sixty_points(random, 0.0);
  const std::set<std::size_t> truth = disturb_five(data, random);
  for (std::size_t i = 0; i < data.points.size(); ++i)
    data.points[i].line = static_cast<int>(i) + 2;
  const Diagnosis found = diagnose(synthetic::spec(), {data}, quick());
  EXPECT_EQ(found.verdict(), Verdict::adequate);
  ASSERT_EQ(found.outlying.size(), truth.size());
  for (const OutlyingPoint& point : found.outlying) {
    EXPECT_TRUE(truth.contains(static_cast<std::size_t>(point.line) - 2));
    EXPECT_GT(std::abs(point.residual), 3.3);
  }
  ASSERT_TRUE(found.for_all);
  EXPECT_NE(found.for_all->verdict, Verdict::adequate);
  EXPECT_NE(found.for_all->verdict, Verdict::cause_named);
}

}  // namespace
}  // namespace recoil
