// The posterior of a fit, against integrals on a grid with another simulator.
#include "uncertainty/posterior.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/noisy_case.hpp"

namespace recoil {
namespace {

/// Marginal quantiles of C_A by brute force: e from the reconstructions' simulator, the likelihood
/// of points with sd 0.01 far from capture written out again, flat priors, one sum over a grid.
struct GridAnswer {
  double mean = 0.0, sd = 0.0;
};
GridAnswer damping_on_a_grid(const Dataset& data, bool scale_known, double centre_H, double sd_H,
                             double centre_A, double sd_A) {
  constexpr int half = 14;
  constexpr double reach = 4.5;
  double total = 0.0, sum = 0.0, square = 0.0, most = -INFINITY;
  std::vector<std::pair<double, double>> weighed;  // C_A, ln density
  for (int i = -half; i <= half; ++i) {
    for (int k = -half; k <= half; ++k) {
      synthetic::Design design;
      design.C_H = centre_H + reach * sd_H * i / half;
      design.C_A = centre_A + reach * sd_A * k / half;
      if (design.C_H < 0.0 || design.C_A < 0.0) continue;
      const Truth truth = synthetic::truth_of(design);
      double chi2 = 0.0;
      int n = 0;
      for (const ImpactPoint& point : data.points) {
        const double e = true_restitution(truth, point.diameter, point.incident_velocity);
        if (point.all_captured()) continue;
        chi2 += std::pow((point.restitution - e) / *point.restitution_sd, 2);
        ++n;
      }
      const double ln = scale_known ? -0.5 * chi2 : -0.5 * n * std::log(chi2);
      weighed.emplace_back(design.C_A, ln);
      most = std::max(most, ln);
    }
  }
  for (const auto& [C_A, ln] : weighed) {
    const double w = std::exp(ln - most);
    total += w;
    sum += w * C_A;
    square += w * C_A * C_A;
  }
  return {sum / total, std::sqrt(square / total - std::pow(sum / total, 2))};
}

TEST(Posterior, AgreesWithSumsOnAGrid) {
  synthetic::Design design;
  design.velocities = {6.5, 9.0, 12.0, 18.0, 25.0, 50.0, 90.0};  // far from capture
  Dataset data = synthetic::dataset(design);
  RandomStream random(7, RandomPurpose::coverage, 0);
  for (ImpactPoint& point : data.points) point.restitution += 0.01 * random.normal();
  for (const bool stated : {true, false}) {
    Dataset used = data;
    if (!stated) {
      for (ImpactPoint& point : used.points) point.restitution_sd.reset();
    }
    NoiseSpec noise;
    if (!stated) noise.variance = VarianceFunction::constant;
    const FitResult fitted = fit(make_model(synthetic::spec(), {used}), gather({used}, noise));
    ASSERT_TRUE(fitted.usable);
    const PosteriorResult found = sample_posterior(fit_alternatives(fitted), {}, {});
    ASSERT_TRUE(found.available());
    const GridAnswer grid = damping_on_a_grid(data, stated, fitted.theta[0], fitted.std_error[0],
                                              fitted.theta[1], fitted.std_error[1]);
    const PosteriorMarginal& C_A = found.parameters[1];
    EXPECT_LT(C_A.check.r_hat, 1.01);
    EXPECT_GE(std::min(C_A.check.bulk, C_A.check.tail), 400.0);
    EXPECT_NEAR(C_A.mean, grid.mean, 0.08 * grid.sd) << stated;
    EXPECT_NEAR(C_A.sd / grid.sd, 1.0, 0.06) << stated;
    EXPECT_TRUE(C_A.interval.contains(grid.mean));
    EXPECT_FALSE(found.parameters[2].interval.available());  // f0 is fixed
  }
}

TEST(Posterior, ConstantsOfWhichThePointsSayNothingKeepTheirPrior) {
  // With f0 free the points say nothing of the density: its posterior is what is stated, a
  // lognormal with median 1350 and ln sd 0.0997513, and f0 takes up 2/5 of it.
  Dataset data = synthetic::noisy_case().datasets.front();
  data.system.errors = {{Body::particle, Constant::density, 135.0}};
  const FitResult fitted = fit(make_model(synthetic::spec(true), {data}), gather({data}));
  ASSERT_TRUE(fitted.usable);
  const PosteriorResult found = sample_posterior(fit_alternatives(fitted), {}, {});
  ASSERT_TRUE(found.available());
  const double sd = std::sqrt(std::log1p(0.01));
  const PosteriorMarginal& density = found.parameters[fitted.model.first_constant()];
  EXPECT_NEAR(std::log(*density.interval.upper / 1350.0) / (1.959964 * sd), 1.0, 0.1);
  EXPECT_NEAR(std::log(*density.interval.lower / 1350.0) / (-1.959964 * sd), 1.0, 0.1);
  double product = 0.0, square = 0.0, mean_f = 0.0, mean_d = 0.0;
  const auto n = static_cast<double>(found.draws.size());
  for (const auto& draw : found.draws) {
    mean_f += std::log(draw[2]) / n;
    mean_d += std::log(draw[3]) / n;
  }
  for (const auto& draw : found.draws) {
    product += (std::log(draw[2]) - mean_f) * (std::log(draw[3]) - mean_d) / n;
    square += std::pow(std::log(draw[3]) - mean_d, 2) / n;
  }
  EXPECT_NEAR(product / square, 0.4, 0.12);
}

TEST(Posterior, SameDigitsAtAnyThreadsAndOthersForAnotherSeed) {
  const synthetic::Case c = synthetic::noisy_case();
  PosteriorOptions one;
  one.threads = 1;
  PosteriorOptions three;
  three.threads = 3;
  PosteriorOptions other;
  other.seed = 4;
  const PosteriorResult a = sample_posterior(fit_alternatives(c.fitted), {}, one);
  const PosteriorResult b = sample_posterior(fit_alternatives(c.fitted), {}, three);
  EXPECT_EQ(a.draws, b.draws);
  EXPECT_EQ(a.parameters[1].interval.lower, b.parameters[1].interval.lower);
  EXPECT_NE(a.draws, sample_posterior(fit_alternatives(c.fitted), {}, other).draws);
}

TEST(Posterior, LeavesOutPointsAsRefitsToTheOthersWould) {
  // Against the definition: ln of the mean density of the point over the posterior of a fit to all
  // others. With stated noise that density is normal in e, with the standard deviation sigma.
  const synthetic::Case c = synthetic::noisy_case();
  const PosteriorResult all = sample_posterior(fit_alternatives(c.fitted), {}, {});
  ASSERT_TRUE(all.available());
  ASSERT_EQ(all.left_out.points.size(), c.data.points.size());
  for (const std::size_t left : {std::size_t{1}, c.data.points.size() - 1}) {
    std::vector<Dataset> others = c.datasets;
    auto& points = others.front().points;
    const ImpactPoint point = points[left];
    ASSERT_FALSE(point.all_captured());
    points.erase(points.begin() + static_cast<std::ptrdiff_t>(left));
    const FitResult fitted = fit(make_model(synthetic::spec(), others), gather(others));
    const PosteriorResult found = sample_posterior(fit_alternatives(fitted), {}, {});
    ASSERT_TRUE(found.available());
    double density = 0.0;
    const double sd = *point.restitution_sd;
    for (std::size_t k = 0; k < found.draws.size(); k += 10) {
      synthetic::Design design;
      design.C_H = found.draws[k][0];
      design.C_A = found.draws[k][1];
      const double e =
          true_restitution(synthetic::truth_of(design), point.diameter, point.incident_velocity);
      density += std::exp(-0.5 * std::pow((point.restitution - e) / sd, 2)) / sd /
                 std::sqrt(2.0 * M_PI) / (static_cast<double>(found.draws.size()) / 10.0);
    }
    // 400 draws: the error of ln of the mean is below 0.05 for points with little leverage.
    EXPECT_NEAR(all.left_out.points[left].elpd, std::log(density), 0.1) << left;
    EXPECT_LT(all.left_out.points[left].pareto_k, 0.7);
  }
}

TEST(Posterior, LikelihoodOfThePointsIsNormalInRestitution) {
  // Far from capture, with stated errors: ln p = -(e - e_model)^2 / (2 sd^2) - ln(sd sqrt(2 pi)),
  // with e_model from the simulator of the reconstructions. The density is exactly normal in a
  // function of e^2, whose r differs from this one by sd / (2 e) = 0.008.
  synthetic::Design design;
  design.velocities = {6.5, 9.0, 12.0, 18.0, 25.0, 50.0, 90.0};
  std::vector<Dataset> data = {synthetic::dataset(design)};
  RandomStream random(11, RandomPurpose::coverage, 0);
  for (ImpactPoint& point : data[0].points) point.restitution += 0.01 * random.normal();
  const FitResult fitted = fit(make_model(synthetic::spec(), data), gather(data));
  const PosteriorResult found = sample_posterior(fit_alternatives(fitted), {}, {});
  ASSERT_TRUE(found.available());
  ASSERT_EQ(found.pointwise.size(), data[0].points.size());
  for (std::size_t k = 0; k < found.draws.size(); k += 400) {
    synthetic::Design drawn;
    drawn.C_H = found.draws[k][0];
    drawn.C_A = found.draws[k][1];
    const Truth truth = synthetic::truth_of(drawn);
    double sum = 0.0;
    for (std::size_t i = 0; i < data[0].points.size(); ++i) {
      const ImpactPoint& point = data[0].points[i];
      const double r =
          (point.restitution - true_restitution(truth, point.diameter, point.incident_velocity)) /
          0.01;
      const double expected = -0.5 * r * r - std::log(0.01 * std::sqrt(2.0 * M_PI));
      EXPECT_NEAR(found.pointwise[i][k], expected, 0.01 * (1.0 + std::abs(r))) << i;
      sum += found.pointwise[i][k];
    }
    EXPECT_NEAR(found.log_likelihood[k], sum, 1e-9);
  }
}

TEST(Posterior, ConstantsThatTheFitHoldsAreDrawnFromWhatIsStated) {
  // The density is held: its draws are the stated lognormal. Adhesion slows down a lighter sphere
  // of the same stiffness more, which C_A makes up for.
  Dataset data = synthetic::noisy_case().datasets.front();
  data.system.errors = {{Body::particle, Constant::density, 135.0}};
  FitSpec spec = synthetic::spec();
  const auto drawn = [&](Materials materials) {
    spec.uncertainty.materials = materials;
    const FitResult fitted = fit(make_model(spec, {data}), gather({data}));
    return sample_posterior(fit_alternatives(fitted), {}, {});
  };
  const PosteriorResult found = drawn(Materials::propagated);
  const PosteriorResult without = drawn(Materials::exact);
  ASSERT_TRUE(found.available());
  ASSERT_TRUE(without.available());
  ASSERT_EQ(found.draws.front().size(), 4U) << "C_H, C_A, f0 and the density";
  const auto n = static_cast<double>(found.draws.size());
  double mean = 0.0, square = 0.0;
  for (const auto& draw : found.draws) mean += std::log(draw[3] / 1350.0) / n;
  for (const auto& draw : found.draws) square += std::pow(std::log(draw[3] / 1350.0) - mean, 2) / n;
  const double sd = std::sqrt(std::log1p(0.01));
  EXPECT_NEAR(mean / sd, 0.0, 4.0 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(square) / sd, 1.0, 4.0 / std::sqrt(2.0 * n));
  EXPECT_GT(found.parameters[1].sd, 1.1 * without.parameters[1].sd);
}

TEST(Posterior, CaptureVelocitiesAreThoseOfTheDraws) {
  const synthetic::Case c = synthetic::noisy_case();
  CaptureEstimate at;
  at.diameter = 4.9e-6;
  at.value = 1.0;
  const PosteriorResult found = sample_posterior(fit_alternatives(c.fitted), {at}, {});
  ASSERT_TRUE(found.available());
  for (const std::size_t k : {0U, 333U, 777U}) {
    synthetic::Design design;
    design.C_H = found.draws.at(k)[0];
    design.C_A = found.draws[k][1];
    const Truth truth = synthetic::truth_of(design);
    const double V = found.capture_draws.at(k).at(0);
    EXPECT_EQ(true_restitution(truth, at.diameter, 0.999 * V), 0.0) << V;
    EXPECT_GT(true_restitution(truth, at.diameter, 1.001 * V), 0.0) << V;
  }
  EXPECT_TRUE(found.capture.at(0).interval.available());
}

TEST(Posterior, HasNoAnswerWithoutAFreeParameterOrANoise) {
  const synthetic::Case c = synthetic::noisy_case();
  FitResult held = c.fitted;
  for (ParameterSlot& slot : held.model.slots) slot.free = false;
  EXPECT_TRUE(sample_posterior(fit_alternatives(held), {}, {}).draws.empty());
  Dataset few = c.datasets.front();
  few.points.resize(2);
  for (ImpactPoint& point : few.points) point.restitution_sd.reset();
  const FitResult exact = fit(make_model(synthetic::spec(), {few}), gather({few}));
  const PosteriorResult found = sample_posterior(fit_alternatives(exact), {}, {});
  EXPECT_FALSE(found.available());
  EXPECT_EQ(found.missing, NoPosterior::few_points);
}

TEST(Posterior, RefusesWhatHasNotSettled) {
  const synthetic::Case c = synthetic::noisy_case();
  PosteriorOptions options;
  options.length = 20;
  options.most_steps = 40;
  const PosteriorResult found = sample_posterior(fit_alternatives(c.fitted), {}, options);
  ASSERT_FALSE(found.available());
  EXPECT_EQ(*found.missing, NoPosterior::not_settled);
  EXPECT_FALSE(found.parameters[0].interval.available());
  EXPECT_TRUE(found.draws.empty());
}

}  // namespace
}  // namespace recoil
