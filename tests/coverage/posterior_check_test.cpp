// Posterior SBC: it believes a posterior that is right and finds one that is not. Measurements are
// repeated by the simulator of the reconstructions, which shares no code with the fitter.
#include "coverage/posterior_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "support/synthetic.hpp"
#include "support/workplace.hpp"

namespace recoil {
namespace {

constexpr double sd = 0.01;

synthetic::Design far_from_capture() {
  synthetic::Design design;
  design.velocities = {6.5, 9.0, 12.0, 18.0, 25.0, 50.0, 90.0};
  design.sd = sd;
  return design;
}

/// The points of `design` with normal errors of e.
std::vector<Dataset> measured(const synthetic::Design& design, double error, unsigned seed) {
  std::vector<Dataset> data = {synthetic::dataset(design)};
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, error);
  for (ImpactPoint& point : data[0].points) point.restitution += normal(random);
  return data;
}

/// What the repeated measurements do otherwise than the model of the fit says.
struct Wrong {
  double error = 1.0;      ///< factor on the error of e
  double adhesion = 1.0;   ///< factor on f0, which the fit takes as exact
  double posterior = 1.0;  ///< factor on the draws of C_H and C_A about their means
};

PosteriorCheck check_of(const Wrong& wrong, int sets) {
  FitSpec spec = synthetic::spec();
  spec.uncertainty.materials = Materials::exact;
  UncertaintyOptions options;
  options.seed = 5;
  PosteriorStudy study = posterior_study(spec, measured(far_from_capture(), sd, 3), options);
  for (std::size_t j = 0; j < 2; ++j) {
    const double centre = study.posterior.parameters[j].mean;
    for (std::vector<double>& draw : study.posterior.draws) {
      draw[j] = centre + wrong.posterior * (draw[j] - centre);
    }
  }
  study.simulate = [&](const FitResult& truth, std::uint64_t index) {
    synthetic::Design design = far_from_capture();
    design.C_H = truth.theta[0];
    design.C_A = truth.theta[1];
    design.f0 *= wrong.adhesion;
    return measured(design, wrong.error * sd, static_cast<unsigned>(index) + 100);
  };
  study.steps = 300;  // two parameters: some tens of effective draws
  return check_posterior(study, sets, 0);
}

TEST(PosteriorCheck, BelievesWhatIsRight) {
  const PosteriorCheck check = check_of({}, 100);
  EXPECT_EQ(check.failed, 0);
  ASSERT_EQ(check.parameters.size(), 2U);
  // A right posterior is not believed once in 100 times, and open in four more.
  EXPECT_NE(check.verdict, PosteriorVerdict::not_believed);
  for (const RankedParameter& one : check.parameters) {
    // 100 normal scores: the standard errors are 0.07 of their standard deviation, 0.1 of the mean,
    // and 3 of the number of 90 % intervals that hold.
    EXPECT_NEAR(one.error_ratio, 1.0, 0.25) << one.parameter;
    EXPECT_NEAR(one.shift, 0.0, 0.35) << one.parameter;
    EXPECT_NEAR(one.held, 90, 10) << one.parameter;
    EXPECT_LT(one.ratio_lower, one.error_ratio);
    EXPECT_GT(one.ratio_upper, one.error_ratio);
  }
}

TEST(PosteriorCheck, FindsWhatIsWrong) {
  // A posterior of half the measured and half the repeated points has half the variance s^2 of the
  // first one. Its mean is off by half of the truth's draw and half of the repeated error, so that
  // the ratio of the squares is (draw^2 + error^2) / 2, in units of s.
  const auto ratio = [](double draw, double error) {
    return std::sqrt((draw * draw + error * error) / 2.0);
  };
  const PosteriorCheck wide = check_of({.error = 0.25}, 200);
  EXPECT_EQ(wide.verdict, PosteriorVerdict::not_believed);
  EXPECT_NEAR(wide.parameters[1].error_ratio, ratio(1.0, 0.25), 0.15);
  const PosteriorCheck narrow = check_of({.posterior = 2.0}, 100);
  EXPECT_EQ(narrow.verdict, PosteriorVerdict::not_believed);
  EXPECT_GT(narrow.parameters[1].ratio_lower, 1.0);
  EXPECT_NEAR(narrow.parameters[1].error_ratio, ratio(2.0, 1.0), 0.35);
  const PosteriorCheck shifted = check_of({.adhesion = 1.1}, 100);
  EXPECT_EQ(shifted.verdict, PosteriorVerdict::not_believed);
  // More adhesion in the repeated points looks like more damping: the truth is below the posterior.
  EXPECT_LT(shifted.parameters[1].shift, -3.0 * shifted.parameters[1].shift_sd);
}

TEST(PosteriorCheck, IsOpenWithFewSets) {
  const PosteriorCheck check = check_of({}, 10);
  EXPECT_EQ(check.verdict, PosteriorVerdict::unknown);
  EXPECT_EQ(check.because, NoVerdict::few_sets);
}

TEST(PosteriorCheck, PValuesOfUniformRanksAreUniform) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> rank(0, most_rank);
  std::vector<std::vector<int>> all(1000, std::vector<int>(100));
  for (auto& ranks : all) {
    for (int& one : ranks) one = rank(random);
  }
  const std::vector<double> p = rank_p_values(all);
  // Binomial limits of three standard deviations: 0.007 of 0.05, 0.016 of 0.5.
  for (const double level : {0.05, 0.5}) {
    const auto below = std::count_if(p.begin(), p.end(), [&](double one) { return one <= level; });
    EXPECT_NEAR(static_cast<double>(below) / 1000.0, level,
                3.0 * std::sqrt(level * (1.0 - level) / 1000.0));
  }
}

TEST(PosteriorCheck, TheCommandAnswersFirst) {
  const support::Workplace place;
  const support::Words command = {"coverage", "fit.toml", "--posterior", "--datasets", "2"};
  const support::Outcome run = place.run(support::with(command, {"--json"}));
  ASSERT_EQ(run.status, 0) << run.err;
  const auto found = nlohmann::json::parse(run.out);
  const auto& check = found["posterior"];
  EXPECT_EQ(found["truth"], "posterior");
  EXPECT_EQ(found["simulated"], 2);
  EXPECT_EQ(check["sets"].get<int>() + found["failed"].get<int>(), 2);
  EXPECT_TRUE(check["parameters"].contains("C_A"));
  EXPECT_EQ(check["verdict"], "unknown");
  EXPECT_EQ(check["because"], "few_sets");
  const std::string printed = place.run(command).out, answer = check["text"];
  EXPECT_EQ(printed.substr(0, 40), answer.substr(0, 40));
  EXPECT_EQ(place.run(support::with(command, {"--replicates", "19"})).status, 2);
}

}  // namespace
}  // namespace recoil
