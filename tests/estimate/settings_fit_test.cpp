// Points of one setting of the apparatus share an error. The truth comes from the simulator of the
// reconstructions, the linear algebra from Eigen.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include "analysis/analysis.hpp"
#include "core/error.hpp"
#include "estimate/fit.hpp"
#include "estimate/input_errors.hpp"
#include "estimate/setting_error.hpp"
#include "estimate/shared_errors.hpp"
#include "mechanism/mechanism.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

constexpr double own_sd = 0.008;
constexpr double diameter = 4.9e-6;

double e_at(double velocity) {
  synthetic::Design design;
  design.diameters = {diameter};
  design.velocities = {velocity};
  return synthetic::dataset(design).points.front().restitution;
}

struct Drops {
  int settings = 12;
  int each = 6;
  double shared = 0.02;
  double own = own_sd;
  bool stated = true;
  bool named = true;
};

/// `each` drops at every velocity, all of one velocity off by the same error.
Dataset measured(const Drops& drops, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Dataset data = synthetic::dataset({});
  data.points.clear();
  data.series = {"drops"};
  for (int k = 0; k < drops.settings; ++k) {
    const double velocity = 4.0 * std::pow(15.0, k / (drops.settings - 1.0));
    static std::map<double, double> known;
    if (!known.contains(velocity)) known[velocity] = e_at(velocity);
    const double off = drops.shared * normal(random);
    for (int i = 0; i < drops.each; ++i) {
      ImpactPoint point;
      point.series = 0;
      point.diameter = diameter;
      point.incident_velocity = velocity;
      point.restitution = known[velocity] + off + drops.own * normal(random);
      if (drops.stated) point.restitution_sd = drops.own;
      if (drops.named) point.setting = fmt::format("height {}", k);
      data.points.push_back(point);
    }
  }
  return data;
}

FitResult fitted(const Dataset& data, const NoiseSpec& noise = {}) {
  FitOptions options;
  options.several_starts = false;
  const std::vector<Dataset> datasets = {data};
  return fit(make_model(synthetic::spec(), datasets), gather(datasets, noise), options);
}

/// Points whose residual falls by one per unit of e^2, so that loads are the effects of `sources`.
WeightedData points_with_errors(std::size_t count, std::vector<const ErrorSource*> sources) {
  WeightedData made;
  made.data.points.resize(count);
  made.data.sources = std::move(sources);
  made.weights.points.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    made.data.points[i].restitution = 1.0;
    made.weights.points[i].input_sd = 1.0;  // r = (e^2 - m) / input_sd without any other scatter
  }
  made.weights.predicted.assign(count, 1.0);
  made.weights.effects.assign(made.data.sources.size(), std::vector<double>(count, 0.0));
  return made;
}

TEST(SharedSettings, WhiteningIsTheInverseRootOfTheCovariance) {
  WeightedData made = points_with_errors(7, {&setting_error()});
  std::vector<Observation>& points = made.data.points;
  const double loads[] = {0.3, 2.0, 0.0, 1.1, 0.7, 5.0, 0.2};
  const std::size_t settings[] = {4, 4, 4, 9, 9, 4, 2};
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].setting = settings[i];
    made.weights.effects[0][i] = loads[i];
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(7, 7);
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 7; ++j) {
      if (settings[i] == settings[j]) covariance(i, j) += loads[i] * loads[j];
    }
  }
  // Row-major rows of the identity, whitened column by column, are the whitening matrix.
  std::vector<double> whitening(49, 0.0);
  for (std::size_t i = 0; i < 7; ++i) whitening[8 * i] = 1.0;
  const SharedErrors shared(made.data, made.weights);
  shared.whiten(whitening, 7);
  const Eigen::Map<const Eigen::Matrix<double, 7, 7, Eigen::RowMajor>> W(whitening.data());
  EXPECT_LT((W * covariance * W.transpose() - Eigen::MatrixXd::Identity(7, 7)).norm(), 1e-13);
  EXPECT_NEAR(shared.log_determinant(), std::log(covariance.determinant()), 1e-13);
}

TEST(SharedSettings, SizesOfSeriesAndSettingsAddUpInTheCovariance) {
  WeightedData made = points_with_errors(6, {&setting_error(), &series_diameter_error()});
  std::vector<Observation>& points = made.data.points;
  const double of_setting[] = {0.4, 0.9, 0.0, 1.3, 0.6, 0.8};
  const double of_size[] = {0.7, 1.1, 0.5, 0.2, 0.0, 0.9};
  const std::size_t setting[] = {0, 0, 1, 1, 1, 2};
  const std::size_t series[] = {0, 0, 0, 1, 1, 1};
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].setting = setting[i];
    points[i].batch = series[i];
    points[i].series_diameter_sd = of_size[i];  // 0: the point has no such error
    made.weights.effects[0][i] = of_setting[i];
    made.weights.effects[1][i] = of_size[i];
  }
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(6, 6);
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      if (setting[i] == setting[j]) covariance(i, j) += of_setting[i] * of_setting[j];
      if (series[i] == series[j]) covariance(i, j) += of_size[i] * of_size[j];
    }
  }
  std::vector<double> whitening(36, 0.0);
  for (std::size_t i = 0; i < 6; ++i) whitening[7 * i] = 1.0;
  const SharedErrors shared(made.data, made.weights);
  shared.whiten(whitening, 6);
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> W(whitening.data());
  EXPECT_LT((W * covariance * W.transpose() - Eigen::MatrixXd::Identity(6, 6)).norm(), 1e-13);
  EXPECT_NEAR(shared.log_determinant(), std::log(covariance.determinant()), 1e-13);
}

/// The diameter of a series is off by 3 %, the same for its points: C_A of eight velocities is off
/// by far more than the noise of the points says. The error that `series_diameter_sd` claims is
/// that by which the estimates scatter, and the estimates of 60 sets lie within two of it as often
/// as normal ones do (57 expected, binomial sd 1.7).
TEST(SharedSizes, WidenTheErrorByTheSizeOfTheBatch) {
  int inside = 0;
  int inside_if_independent = 0;
  for (unsigned k = 0; k < 60; ++k) {
    std::mt19937 random(70 + k);
    std::normal_distribution<double> normal;
    synthetic::Design design;
    design.diameters = {4.9e-6 * (1.0 + 0.03 * normal(random))};
    design.velocities = {3.0, 4.0, 5.0, 6.5, 9.0, 14.0, 25.0, 50.0};
    Dataset data = synthetic::dataset(design);
    for (ImpactPoint& point : data.points) {
      point.diameter = 4.9e-6;
      point.restitution += 0.01 * normal(random);
      point.diameter_sd = 0.03 * point.diameter;
    }
    data.points.front().diameter_sd = 0.0301 * data.points.front().diameter;  // no batch
    const FitResult independent = fitted(data);
    for (ImpactPoint& point : data.points) std::swap(point.diameter_sd, point.series_diameter_sd);
    const FitResult shared = fitted(data);
    ASSERT_TRUE(shared.usable && independent.usable);
    EXPECT_EQ(shared.quantile_dof, 0) << "what is stated is not estimated";
    const auto holds = [](const FitResult& fit) {
      return std::abs(fit.theta[1] - 0.03) < 2.0 * fit.std_error[1] ? 1 : 0;
    };
    inside += holds(shared);
    inside_if_independent += holds(independent);
  }
  EXPECT_GE(inside, 53);
  EXPECT_LT(inside_if_independent, inside);
}

TEST(SharedSettings, ADatasetThatNamesNoneSharesNothing) {
  const FitResult plain = fitted(measured({.named = false}, 1));
  EXPECT_FALSE(plain.data.share(SharedBy::setting));
  EXPECT_TRUE(SharedErrors(plain.data, plain.weights).none());
  NoiseSpec noise;
  noise.every_setting = true;  // those of equal velocity
  const FitResult asked = fitted(measured({.named = false}, 1), noise);
  EXPECT_EQ(asked.weights.noise.setting_sd, fitted(measured({}, 1)).weights.noise.setting_sd);
}

TEST(SharedSettings, SchemesThatExchangePointsAreRefusedOnceTheFitHasFoundTheSharedError) {
  FitInputs inputs{synthetic::spec(), {measured({}, 1)}};
  for (const Scheme scheme :
       {Scheme::residual, Scheme::cases, Scheme::cluster, Scheme::automatic}) {
    inputs.spec.uncertainty.scheme = scheme;
    if (scheme == Scheme::residual || scheme == Scheme::cases) {
      EXPECT_THROW(analyse_fit(inputs), InputError) << to_string(scheme);
    } else {
      EXPECT_TRUE(analyse_fit(inputs).fitted.usable) << to_string(scheme);
    }
  }
}

TEST(Observations, ASubsetKeepsEverythingButTheOtherPoints) {
  NoiseSpec noise;
  noise.student_dof = 7.0;
  Observations all = gather({measured({}, 1)}, noise);
  all.noise.sd_set_aside = 2;
  all.noise.sd_missing = 3;
  all.constants = {1.5};
  const std::vector<std::size_t> indices = {5, 1};
  const Observations part = all.subset(indices);
  ASSERT_EQ(part.points.size(), 2U);
  EXPECT_EQ(part.points[0].restitution, all.points[5].restitution);
  EXPECT_EQ(part.points[1].restitution, all.points[1].restitution);
  EXPECT_EQ(part.noise.spec.student_dof, 7.0);
  EXPECT_EQ(part.noise.sd_stated, all.noise.sd_stated);
  EXPECT_EQ(part.noise.sd_set_aside, 2);
  EXPECT_EQ(part.noise.sd_missing, 3);
  EXPECT_EQ(part.constants, all.constants);
  EXPECT_EQ(part.sources, all.sources);
  EXPECT_EQ(part.noise.setting_sd_estimated, all.noise.setting_sd_estimated);
}

/// The means of every `each` points in turn, of no setting, with the errors sd(mean).
template <class Error>
Dataset means_of(const Dataset& all, std::size_t each, Error sd) {
  Dataset means = all;
  means.points.clear();
  for (std::size_t i = 0; i < all.points.size(); i += each) {
    ImpactPoint mean = all.points[i];
    mean.restitution = 0.0;
    for (std::size_t k = 0; k < each; ++k) {
      mean.restitution += all.points[i + k].restitution / static_cast<double>(each);
    }
    mean.restitution_sd = sd(mean);
    mean.setting_velocity_sd.reset();
    mean.setting = "";
    means.points.push_back(mean);
  }
  return means;
}

/// Ten drops from one height are one height's worth: with the shared error known, the fit of all
/// drops is that of their means with the variance shared^2 + own^2 / n.
TEST(SharedSettings, AllDropsSayWhatTheirMeansSay) {
  const Drops drops{.settings = 8, .each = 10};
  const Dataset all = measured(drops, 3);
  const Dataset means = means_of(all, 10, [&](const ImpactPoint&) {
    return std::hypot(drops.shared, own_sd / std::sqrt(10.0));
  });
  NoiseSpec noise;
  noise.setting_sd = drops.shared;
  const FitResult by_drops = fitted(all, noise);
  const FitResult by_means = fitted(means);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(by_drops.theta[j], by_means.theta[j], 0.02 * by_means.std_error[j]) << j;
    EXPECT_NEAR(by_drops.std_error[j] / by_drops.noise_scale,
                by_means.std_error[j] / by_means.noise_scale, 0.01 * by_means.std_error[j])
        << j;
  }
}

class SettingErrors : public testing::TestWithParam<bool> {};

TEST_P(SettingErrors, AreEstimatedAndTheErrorsOfTheParametersHold) {
  const Drops drops{.stated = GetParam()};
  constexpr int sets = 150;
  double square = 0.0;
  double error[2] = {0.0, 0.0};
  double claimed[2] = {0.0, 0.0};
  double without[2] = {0.0, 0.0};
  NoiseSpec none;
  none.setting_sd = 0.0;
  if (!drops.stated) none.variance = VarianceFunction::constant;
  NoiseSpec shared = none;
  shared.setting_sd.reset();
  const double truth[] = {3e-3, 0.03};
  for (unsigned k = 0; k < sets; ++k) {
    const Dataset data = measured(drops, 100 + k);
    const FitResult own = fitted(data, shared);
    ASSERT_TRUE(own.usable) << own.failure;
    square += std::pow(own.weights.noise.setting_sd, 2) / sets;
    const FitResult plain = fitted(data, none);
    for (std::size_t j = 0; j < 2; ++j) {
      error[j] += std::pow(own.theta[j] / truth[j] - 1.0, 2) / sets;
      claimed[j] += std::pow(own.std_error[j] / truth[j], 2) / sets;
      without[j] += std::pow(plain.std_error[j] / truth[j], 2) / sets;
    }
  }
  // A variance of ten degrees of freedom scatters by 45 %, its mean over 150 sets by 4 %.
  EXPECT_NEAR(square / (0.02 * 0.02), 1.0, 0.15);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(error[j] / claimed[j], 1.0, 0.4) << j;  // 3.5 times sqrt(2 / 150)
    EXPECT_GT(error[j] / without[j], 2.0) << j;  // what points that share nothing would claim
  }
}

INSTANTIATE_TEST_SUITE_P(Noise, SettingErrors, testing::Bool(), [](const auto& test) {
  return std::string(test.param ? "StatedNoise" : "EstimatedNoise");
});

TEST(SharedSettings, WhereThereIsNoErrorNoneIsFound) {
  int alarms = 0;
  for (unsigned k = 0; k < 40; ++k) {
    const FitResult result = fitted(measured({.shared = 0.0}, 500 + k));
    alarms += result.weights.noise.setting_sd > 0.6 * own_sd ? 1 : 0;
  }
  EXPECT_LE(alarms, 2);
}

TEST(SharedSettings, FewerSettingsThanParametersSayNothing) {
  const FitResult result = fitted(measured({.settings = 2, .each = 20}, 1));
  EXPECT_TRUE(result.data.share(SharedBy::setting));
  EXPECT_EQ(result.weights.noise.setting_sd, 0.0);
}

/// Settings less parameters are the degrees of freedom with which sigma is known, and so are those
/// of the quantiles; from none nothing is estimated.
TEST(SharedSettings, FewSettingsGiveFewDegreesOfFreedom) {
  const FitResult none = fitted(measured({.settings = 2, .shared = 0.05}, 2));
  EXPECT_EQ(none.weights.noise.setting_sd, 0.0);
  EXPECT_EQ(none.quantile_dof, 0);
  const FitResult three = fitted(measured({.settings = 5, .shared = 0.05}, 2));
  EXPECT_GT(three.weights.noise.setting_sd, 0.0);
  EXPECT_EQ(three.quantile_dof, 3);
}

/// Five settings of eight points, an error of e shared by each: the errors of theta in units of the
/// stated ones follow Student's t with 3 degrees of freedom. With 200 sets the share inside the 95
/// % quantile is binomial with a standard deviation of 1.5 %; normal quantiles give about 84 %.
TEST(SharedSettings, QuantilesOfStudentHoldWithFewSettings) {
  int inside = 0;
  constexpr unsigned sets = 200;
  for (unsigned k = 0; k < sets; ++k) {
    const FitResult result = fitted(measured({.settings = 5, .each = 8, .shared = 0.02}, 900 + k));
    ASSERT_TRUE(result.usable);
    constexpr double student = 3.182446;  // scipy.stats.t.ppf(0.975, 3)
    EXPECT_EQ(result.quantile_dof, 3);
    inside += std::abs(result.theta[1] - 0.03) < student * result.std_error[1] ? 1 : 0;
  }
  EXPECT_GE(inside, 180);
}

/// Series that differ by 0.1 have no error of settings in common: what is left is that of 0.01.
TEST(SharedSettings, DoNotAbsorbSeriesThatDiffer) {
  const Dataset one = measured({.settings = 10, .shared = 0.01}, 4);
  Dataset both = one;
  both.series.emplace_back("others");
  for (ImpactPoint point : one.points) {
    point.series = 1;
    point.restitution -= 0.1;
    point.setting += " of the others";
    both.points.push_back(point);
  }
  Observations data = gather({both});
  std::vector<double> predicted;
  for (const Observation& point : data.points) {
    predicted.push_back(std::pow(e_at(point.velocity), 2));
  }
  const double sd = setting_sd_at(data, first_weights(data), predicted, 2);
  // From 17 deviations: within a factor of 1.5 nearly always.
  EXPECT_GT(sd, 0.01 / 1.5);
  EXPECT_LT(sd, 0.01 * 1.5);
}

/// Where every velocity states its error, settings share no more than that makes of e.
TEST(SharedSettings, AreBoundedByWhatIsStatedOfTheVelocities) {
  Dataset data = measured({.settings = 12, .shared = 0.05}, 6);
  double most = 0.0;
  for (ImpactPoint& point : data.points) {
    point.velocity_sd = 0.01 * point.incident_velocity;
    most = std::max(most, 0.01 * point.restitution);
  }
  EXPECT_NEAR(fitted(data).weights.noise.setting_sd, most, 1e-12);
}

/// Drops from heights whose velocities are off by `relative` of V, the same for all drops of one:
/// e is read as the rebound over the velocity that was meant.
Dataset measured_from_heights(double relative, int settings, int each, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Dataset data = measured({.settings = settings, .each = each}, seed);
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    static std::map<std::pair<double, double>, double> known;
    static double off = 0.0;
    if (i % static_cast<std::size_t>(each) == 0) off = relative * normal(random);
    ImpactPoint& point = data.points[i];
    const double velocity = point.incident_velocity;
    const auto [place, is_new] = known.try_emplace({velocity, off}, 0.0);
    if (is_new) place->second = e_at(velocity * (1.0 + off));
    point.restitution = place->second * (1.0 + off) + own_sd * normal(random);
    point.setting_velocity_sd = relative * velocity;
  }
  return data;
}

TEST(SettingVelocities, AreTheErrorsOfTheMeansOfTheirSettings) {
  const double relative = 0.02;
  const Dataset all = measured_from_heights(relative, 8, 10, 7);
  // e_read = e(V (1 + x)) (1 + x): d e_read / dx = e + V de/dV, by differences of the simulator.
  const Dataset means = means_of(all, 10, [&](const ImpactPoint& mean) {
    const double velocity = mean.incident_velocity;
    const double slope =
        (e_at(velocity * 1.01) * 1.01 - e_at(velocity * 0.99) * 0.99) / (2.0 * 0.01);
    return std::hypot(slope * relative, own_sd / std::sqrt(10.0));
  });
  const FitResult by_drops = fitted(all);
  const FitResult by_means = fitted(means);
  EXPECT_FALSE(by_drops.data.noise.setting_sd_estimated) << "what is stated is not estimated";
  EXPECT_EQ(by_drops.weights.noise.setting_sd, 0.0);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(by_drops.theta[j], by_means.theta[j], 0.1 * by_means.std_error[j]) << j;
    EXPECT_NEAR(by_drops.std_error[j] / by_drops.noise_scale,
                by_means.std_error[j] / by_means.noise_scale, 0.05 * by_means.std_error[j])
        << j;
  }
}

TEST(SettingVelocities, TheErrorsOfTheParametersHoldForFewHeights) {
  constexpr int sets = 100;
  const double truth[] = {3e-3, 0.03};
  double error[2] = {0.0, 0.0};
  double claimed[2] = {0.0, 0.0};
  for (unsigned k = 0; k < sets; ++k) {
    const FitResult own = fitted(measured_from_heights(0.02, 4, 10, 900 + k));
    ASSERT_TRUE(own.usable) << own.failure;
    for (std::size_t j = 0; j < 2; ++j) {
      error[j] += std::pow(own.theta[j] - truth[j], 2) / sets;
      claimed[j] += std::pow(own.std_error[j] / own.noise_scale, 2) / sets;
    }
  }
  // A mean square of 100 scatters by sqrt(2 / 100): 0.42 is three of these.
  for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(error[j] / claimed[j], 1.0, 0.42) << j;
}

TEST(SettingVelocities, DoNotGoWithStudentsResiduals) {
  NoiseSpec noise;
  noise.student = true;
  EXPECT_THROW(gather({measured_from_heights(0.02, 4, 3, 1)}, noise), InputError);
}

/// A launch of a ball that loses a constant share: ten instants with independent errors, V and e of
/// the flights between them, and the sd of e that these errors give by their first derivatives.
Dataset timed_launch(double e, double sd_of_instants, std::mt19937& random,
                     Eigen::MatrixXd* covariance = nullptr) {
  constexpr double g = 9.80665;
  constexpr Eigen::Index instants = 10;
  std::normal_distribution<double> normal;
  Eigen::VectorXd t(instants);
  double velocity = 5.3;
  t(0) = 0.25;
  for (Eigen::Index k = 1; k < instants; ++k) {
    velocity *= e;
    t(k) = t(k - 1) + 2.0 * velocity / g;
  }
  for (double& at : t) at += sd_of_instants * normal(random);
  const auto quotients = [&](const Eigen::VectorXd& at) {
    const Eigen::VectorXd flights = at.tail(instants - 1) - at.head(instants - 1);
    return Eigen::VectorXd(flights.tail(instants - 2).cwiseQuotient(flights.head(instants - 2)));
  };
  const Eigen::VectorXd seen = quotients(t);
  Eigen::MatrixXd slopes(instants - 2, instants);
  for (Eigen::Index k = 0; k < instants; ++k) {
    const Eigen::VectorXd step = 1e-6 * Eigen::VectorXd::Unit(instants, k);
    slopes.col(k) = (quotients(t + step) - quotients(t - step)) / 2e-6;
  }
  const Eigen::MatrixXd squares = sd_of_instants * sd_of_instants * slopes * slopes.transpose();
  if (covariance != nullptr) *covariance = squares;
  Dataset data = synthetic::dataset({});
  data.points.clear();
  data.series = {"ball"};
  data.system.adhesion_force_f0.reset();
  data.system.reference_diameter.reset();
  data.system.adhesion_energy = 0.0;
  for (Eigen::Index k = 0; k < seen.size(); ++k) {
    ImpactPoint point;
    point.diameter = 0.04;
    point.incident_velocity = 0.5 * g * (t(k + 1) - t(k));
    point.restitution = seen(k);
    point.restitution_sd = std::sqrt(squares(k, k));
    point.launch = "1";
    data.points.push_back(point);
  }
  return data;
}

TEST(TimedBounces, HaveTheCovarianceOfTheirInstants) {
  std::mt19937 random(3);
  Eigen::MatrixXd covariance;
  const Observations data = gather({timed_launch(0.82, 1e-3, random, &covariance)}, NoiseSpec());
  ASSERT_TRUE(data.share(SharedBy::launch));
  const Eigen::VectorXd sd = covariance.diagonal().cwiseSqrt();
  const Eigen::MatrixXd correlation =
      sd.cwiseInverse().asDiagonal() * covariance * sd.cwiseInverse().asDiagonal();
  const Weights weights = first_weights(data);
  const SharedErrors settings(data, weights);
  EXPECT_NEAR(settings.log_determinant(), std::log(correlation.determinant()), 1e-5);
  std::vector<double> r = {0.3, -1.2, 0.7, 0.1, 2.0, -0.4, 0.9, -0.8};
  const Eigen::VectorXd raw = Eigen::Map<Eigen::VectorXd>(r.data(), 8);
  settings.whiten(r);
  const double expected = raw.dot(correlation.ldlt().solve(raw));
  EXPECT_NEAR(Eigen::Map<Eigen::VectorXd>(r.data(), 8).squaredNorm() / expected, 1.0, 1e-5);

  Eigen::MatrixXd drawn = Eigen::MatrixXd::Zero(8, 8);
  constexpr int draws = 20000;
  for (int i = 0; i < draws; ++i) {
    RandomStream stream(5, RandomPurpose::settings, static_cast<std::uint64_t>(i));
    const std::vector<double> errors = draw_shared_errors(data, weights, 1.0, stream);
    const Eigen::VectorXd scaled =
        Eigen::Map<const Eigen::VectorXd>(errors.data(), 8).cwiseQuotient(sd);
    drawn += scaled * scaled.transpose() / draws;
  }
  // Four standard errors of a covariance of 1 from 20,000 draws.
  EXPECT_LT((drawn - correlation).cwiseAbs().maxCoeff(), 4.0 * std::sqrt(2.0 / draws));
}

TEST(TimedBounces, AreIndependentWhereOneIsMissingOrNoErrorIsStated) {
  std::mt19937 random(4);
  Dataset data = timed_launch(0.82, 1e-3, random);
  data.points = {data.points[0], data.points[2], data.points[4]};
  EXPECT_FALSE(gather({data}, NoiseSpec()).share(SharedBy::launch));
  data = timed_launch(0.82, 1e-3, random);
  for (ImpactPoint& point : data.points) point.restitution_sd.reset();
  EXPECT_FALSE(gather({data}, NoiseSpec()).share(SharedBy::launch));
}

TEST(TimedBounces, NarrowTheErrorOfAConstantRestitutionAndItHolds) {
  std::mt19937 random(6);
  constexpr double share = 1.0 - 0.82 * 0.82;
  constexpr int launches = 200;
  FitSpec spec = synthetic::spec();
  for (ParameterSpec& parameter : spec.parameters) {
    parameter.free = false;
    parameter.initial = parameter.lower = 0.0;
    parameter.initial_stated = true;
  }
  spec.mechanisms = {"hysteretic_loss"};
  ParameterSpec& lost = spec.parameters.emplace_back();
  lost.parameter = &find_mechanism("hysteretic_loss")->info.parameters.front();
  lost.initial = lost.parameter->initial;
  lost.lower = lost.parameter->lower;
  lost.upper = lost.parameter->upper;
  double squares = 0.0, claimed = 0.0, chi2 = 0.0;
  for (int k = 0; k < launches; ++k) {
    const std::vector<Dataset> data = {timed_launch(0.82, 3e-4, random)};
    FitOptions options;
    options.several_starts = false;
    const FitResult found = fit(make_model(spec, data), gather(data, NoiseSpec()), options);
    ASSERT_TRUE(found.usable) << found.failure;
    const std::size_t slot = found.model.slots.size() - 1;
    squares += std::pow(found.theta[slot] - share, 2) / launches;
    claimed += found.std_error[slot] / launches;
    chi2 += found.objective / launches;
  }
  // The scatter of 200 is known to 5 %, the mean chi2 of 7 degrees of freedom to 0.26.
  EXPECT_NEAR(std::sqrt(squares) / claimed, 1.0, 0.15);
  EXPECT_NEAR(chi2, 7.0, 1.0);
  // With independent errors of e of 0.0006 to 0.003 it would be 5 times as wide.
  EXPECT_LT(claimed, 0.0004);
}

}  // namespace
}  // namespace recoil
