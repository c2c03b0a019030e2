// Each scheme against what it promises, on a fit with two series and a captured point.
#include "uncertainty/resample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "estimate/setting_error.hpp"
#include "support/noisy_case.hpp"

namespace recoil {
namespace {

using synthetic::Case;
using testing::HasSubstr;

/// The noisy case with a captured point among its fourteen, fitted.
Case with_capture() {
  Case made = synthetic::noisy_case();
  ImpactPoint caught = made.datasets[0].points.front();
  caught.incident_velocity = 0.3;
  caught.restitution = 0.0;
  caught.captured = 1;
  made.datasets[0].points.push_back(caught);
  made.data = gather(made.datasets);
  made.fitted = fit(made.fitted.model, made.data);
  return made;
}

Observations drawn(const ResamplingPlan& plan, std::uint64_t index) {
  Observations sample;
  resample(plan, 1, index, sample);
  return sample;
}

double leverage_scaled(const FitResult& fitted, std::size_t i, double power) {
  return fitted.residuals[i] / std::pow(1.0 - fitted.leverage[i], power);
}

TEST(Plan, AutomaticFollowsWhatIsStated) {
  Case c = with_capture();
  EXPECT_EQ(plan_resampling(c.fitted, Scheme::automatic).scheme, Scheme::parametric);
  c.fitted.data.noise.sd_stated = false;
  const ResamplingPlan plan = plan_resampling(c.fitted, Scheme::automatic);
  EXPECT_EQ(plan.scheme, Scheme::wild);
  EXPECT_EQ(plan.because, SchemeBecause::sd_not_stated);
}

TEST(Plan, ObstaclesAreNamed) {
  Case c = with_capture();
  EXPECT_FALSE(scheme_obstacle(Scheme::cluster, c.data));
  for (Observation& point : c.data.points) point.batch = 0;
  EXPECT_THAT(scheme_obstacle(Scheme::cluster, c.data).value_or(""), HasSubstr("one series"));
  for (Observation& point : c.data.points) point.censored = true;
  EXPECT_THAT(scheme_obstacle(Scheme::wild, c.data).value_or(""), HasSubstr("no point rebounded"));
  EXPECT_FALSE(scheme_obstacle(Scheme::cases, c.data));
}

/// The same with every second point of one setting, whose points share an error of e.
Case with_settings(double shared) {
  Case made = synthetic::noisy_case();
  made.fitted.data.noise.spec.setting_sd = shared;
  made.fitted.data.sources = {&setting_error()};
  Weights& weights = made.fitted.weights;
  weights.noise.setting_sd = shared;
  weights.predicted = made.fitted.prediction_squared;
  weights.effects.emplace_back();
  for (const double e : made.fitted.prediction) weights.effects[0].push_back(2.0 * e * shared);
  for (std::size_t i = 0; i < made.fitted.data.points.size(); ++i) {
    made.fitted.data.points[i].setting = i % 2;
  }
  return made;
}

TEST(Plan, SinglePointsOfASettingAreNotExchanged) {
  const Case c = with_settings(0.05);
  for (const Scheme scheme : {Scheme::residual, Scheme::wild, Scheme::cases}) {
    EXPECT_THAT(scheme_obstacle(scheme, c.fitted.data).value_or(""), HasSubstr("setting_sd"));
  }
  EXPECT_FALSE(scheme_obstacle(Scheme::cluster, c.fitted.data));
  EXPECT_EQ(plan_resampling(c.fitted, Scheme::cluster).units(), 2U);
}

TEST(Parametric, PointsOfASettingMoveTogether) {
  constexpr double shared = 0.05;
  const Case c = with_settings(shared);
  const ResamplingPlan plan = plan_resampling(c.fitted, Scheme::parametric);
  const double own = c.fitted.weights.points[4].sd;
  double together = 0.0;
  double apart = 0.0;
  constexpr int count = 4000;
  for (int r = 0; r < count; ++r) {
    const Observations sample = drawn(plan, static_cast<std::uint64_t>(r));
    const auto moved = [&](std::size_t i) {
      return sample.points[i].restitution - c.fitted.prediction[i];
    };
    together += moved(4) * moved(6) / count;
    apart += moved(4) * moved(5) / count;
  }
  // Four standard errors of a mean of products.
  const double error = 4.0 * (shared * shared + own * own) * std::sqrt(2.0 / count);
  EXPECT_NEAR(together, shared * shared, error);
  EXPECT_NEAR(apart, 0.0, error);
}

TEST(Cluster, ASettingDrawnTwiceIsTwoSettings) {
  const Case c = with_settings(0.05);
  const Observations sample = drawn(plan_resampling(c.fitted, Scheme::cluster), 3);
  std::map<std::size_t, std::size_t> size;
  for (const Observation& point : sample.points) ++size[point.setting];
  EXPECT_EQ(size.size(), 2U);
  for (const auto& [setting, points] : size) EXPECT_EQ(points, 7U);
}

TEST(Parametric, HasTheStatedMomentsAndKeepsCaptures) {
  const Case c = with_capture();
  const ResamplingPlan plan = plan_resampling(c.fitted, Scheme::parametric);
  double sum = 0.0;
  double square = 0.0;
  constexpr int count = 4000;
  for (int r = 0; r < count; ++r) {
    const Observations sample = drawn(plan, static_cast<std::uint64_t>(r));
    const double z = (sample.points[3].restitution - c.fitted.prediction[3]) / c.data.points[3].sd;
    sum += z;
    square += z * z;
    ASSERT_TRUE(sample.points.back().censored);
    ASSERT_EQ(sample.points.back().velocity, 0.3);
  }
  EXPECT_NEAR(sum / count, 0.0, 0.06);  // four standard errors
  EXPECT_NEAR(square / count, std::pow(c.fitted.noise_scale, 2), 0.09);
}

TEST(Residual, DrawsFromTheCentredPool) {
  const Case c = with_capture();
  const ResamplingPlan plan = plan_resampling(c.fitted, Scheme::residual);
  std::vector<double> pool;
  for (std::size_t i = 0; i + 1 < c.data.points.size(); ++i) {
    pool.push_back(leverage_scaled(c.fitted, i, 0.5));
  }
  double mean = 0.0;
  for (const double r : pool) mean += r / static_cast<double>(pool.size());
  const Observations sample = drawn(plan, 5);
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const double rho =
        (sample.points[i].restitution - c.fitted.prediction[i]) / c.data.points[i].sd;
    const bool known = std::any_of(pool.begin(), pool.end(),
                                   [&](double r) { return std::abs(r - mean - rho) < 1e-9; });
    EXPECT_TRUE(known) << i;
  }
}

TEST(Wild, KeepsEachResidualUpToItsSign) {
  const Case c = with_capture();
  const ResamplingPlan plan = plan_resampling(c.fitted, Scheme::wild);
  int positive = 0;
  for (std::uint64_t r = 0; r < 200; ++r) {
    const Observations sample = drawn(plan, r);
    for (std::size_t i = 0; i + 1 < c.data.points.size(); ++i) {
      const double moved =
          (sample.points[i].restitution - c.fitted.prediction[i]) / c.data.points[i].sd;
      const double own = leverage_scaled(c.fitted, i, 1.0);
      EXPECT_NEAR(std::abs(moved), std::abs(own), 1e-9);
      positive += moved * own > 0.0 ? 1 : 0;
    }
  }
  EXPECT_NEAR(positive / 2800.0, 0.5, 0.04);  // four standard errors
}

TEST(Cases, DrawWholePointsCapturedOnesToo) {
  const Case c = with_capture();
  const ResamplingPlan plan = plan_resampling(c.fitted, Scheme::cases);
  std::map<double, double> restitution_at;  // velocities are distinct within a diameter
  for (const Observation& point : c.data.points) {
    restitution_at[point.velocity + point.diameter] = point.restitution;
  }
  int captured = 0;
  for (std::uint64_t r = 0; r < 500; ++r) {
    const Observations sample = drawn(plan, r);
    ASSERT_EQ(sample.points.size(), c.data.points.size());
    for (const Observation& point : sample.points) {
      EXPECT_EQ(point.restitution, restitution_at.at(point.velocity + point.diameter));
      captured += point.censored ? 1 : 0;
    }
  }
  EXPECT_NEAR(captured / 500.0, 1.0, 0.2);  // once a sample on average, four standard errors
}

TEST(Cluster, DrawsWholeSeries) {
  const Case c = with_capture();  // series 0 has eight points with the captured one, series 1 seven
  const ResamplingPlan plan = plan_resampling(c.fitted, Scheme::cluster);
  EXPECT_EQ(plan.units(), 2U);
  std::set<std::size_t> sizes;
  for (std::uint64_t r = 0; r < 50; ++r) sizes.insert(drawn(plan, r).points.size());
  EXPECT_EQ(sizes, (std::set<std::size_t>{14, 15, 16}));
}

TEST(Disturbance, AgreesWithWhatWasDrawn) {
  const Case c = with_capture();
  for (const Scheme scheme : {Scheme::cases, Scheme::cluster}) {
    const ResamplingPlan plan = plan_resampling(c.fitted, scheme);
    const Observations sample = drawn(plan, 9);
    const std::vector<double> extra = perturbation(plan, 1, 9);
    for (std::size_t i = 0; i < c.data.points.size(); ++i) {
      const auto times =
          std::count_if(sample.points.begin(), sample.points.end(), [&](const Observation& point) {
            return point.velocity == c.data.points[i].velocity &&
                   point.diameter == c.data.points[i].diameter;
          });
      EXPECT_EQ(static_cast<double>(times) - 1.0, extra[i]);
    }
  }
}

TEST(Schemes, NamesGoBothWays) {
  for (const std::string& name : all_names<Scheme>())
    EXPECT_EQ(to_string(*value_named<Scheme>(name)), name);
  EXPECT_FALSE(value_named<Scheme>("jackknife"));
}

}  // namespace
}  // namespace recoil
