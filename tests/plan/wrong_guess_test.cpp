// What a plan loses by a guess that is wrong: the truth is a factor of two away. The likelihood of
// the points, its information and the capture velocities are calculated here, from the simulator of
// the reconstructions.
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>

#include "coverage/simulated_impacts.hpp"
#include "plan/experiment_plan.hpp"
#include "plan/guesses.hpp"
#include "support/synthetic.hpp"

namespace {

using recoil::ExperimentPlan;
using recoil::PlannedSetting;
using recoil::PlanOptions;
using recoil::synthetic::Design;

using Factors = std::vector<double>;  // of C_H, C_A and f0, on those of the guess

Design changed(const Factors& by) {
  Design design;
  design.C_H *= by[0];
  design.C_A *= by[1];
  if (by.size() > 2) design.f0 *= by[2];
  return design;
}

/// What one truth does to the points of an experiment.
struct World {
  std::map<double, recoil::TrueCurve> curves;
  std::map<double, double> capture;

  World(const Factors& by, const PlanOptions& options) {
    const recoil::Truth truth = recoil::synthetic::truth_of(changed(by));
    for (const double diameter : options.diameters) {
      capture[diameter] = recoil::true_capture_velocity(truth, diameter);
      curves.try_emplace(
          diameter, [&](double v) { return recoil::true_restitution(truth, diameter, v); },
          capture[diameter], 1.5 * options.fastest);
    }
  }
};

struct Expected {
  double captured = 0.0, mean = 0.0, variance = 0.0;  // of one impact; the last two of a rebound
};

/// The impacts of a setting: ln V* scatters normally, and e is read with an error.
Expected expected(const World& world, const PlannedSetting& at, const PlanOptions& options) {
  const recoil::TrueCurve& curve = world.curves.at(at.diameter);
  const double least = std::log(world.capture.at(at.diameter) / at.velocity) / options.spread;
  Expected found;
  found.captured = gsl_cdf_ugaussian_P(least);
  const double from = std::max(least, -5.0);
  const double to = std::max(from, 0.0) + 5.0;
  constexpr int steps = 60;  // in the root of z above capture, of which e is smooth
  double weight = 0.0, squares = 0.0, errors = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double t = (k + 0.5) / steps;
    const double z = from + (to - from) * t * t;
    const double w = t * gsl_ran_ugaussian_pdf(z);
    const double e = curve(at.velocity * std::exp(options.spread * z));
    weight += w;
    found.mean += w * e;
    squares += w * e * e;
    errors += w * (std::pow(options.scatter * e, 2) + std::pow(options.floor, 2));
  }
  found.mean /= weight;
  found.variance = errors / weight + squares / weight - found.mean * found.mean;
  return found;
}

/// The truth `by`, and its neighbours for differences.
class Judge {
 public:
  Judge(const Factors& by, const PlanOptions& options) : options_(options), here_(by, options) {
    for (std::size_t j = 0; j < by.size(); ++j) {
      Factors up = by, down = by;
      up[j] *= std::exp(step);
      down[j] *= std::exp(-step);
      up_.emplace_back(up, options);
      down_.emplace_back(down, options);
    }
  }

  /// The covariance of the logarithms of the parameters, from the settings of a plan.
  Eigen::MatrixXd covariance(const std::vector<PlannedSetting>& settings) const {
    const auto p = static_cast<Eigen::Index>(up_.size());
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(p, p);
    for (const PlannedSetting& at : settings) {
      const Expected now = expected(here_, at, options_);
      Eigen::VectorXd captured(p), mean(p);
      for (Eigen::Index j = 0; j < p; ++j) {
        const Expected up = expected(up_[static_cast<std::size_t>(j)], at, options_);
        const Expected down = expected(down_[static_cast<std::size_t>(j)], at, options_);
        captured(j) = (up.captured - down.captured) / (2.0 * step);
        mean(j) = (up.mean - down.mean) / (2.0 * step);
      }
      const double impacts = at.points * options_.events;
      const double both = now.captured * (1.0 - now.captured);
      if (both > 1e-12) information += impacts / both * captured * captured.transpose();
      if (options_.events * (1.0 - now.captured) < 0.5) continue;
      information += impacts * (1.0 - now.captured) / now.variance * mean * mean.transpose();
    }
    return information.inverse();
  }

  /// The sum of the relative variances of parameters and capture velocities.
  double sum_of_variances(const std::vector<PlannedSetting>& settings) const {
    const Eigen::MatrixXd of_parameters = covariance(settings);
    double sum = of_parameters.trace();
    for (const double diameter : options_.diameters) {
      Eigen::VectorXd slope(of_parameters.rows());
      for (std::size_t j = 0; j < up_.size(); ++j) {
        slope(static_cast<Eigen::Index>(j)) =
            std::log(up_[j].capture.at(diameter) / down_[j].capture.at(diameter)) / (2.0 * step);
      }
      sum += slope.dot(of_parameters * slope);
    }
    return sum;
  }

 private:
  static constexpr double step = 0.02;
  PlanOptions options_;
  World here_;
  std::vector<World> up_, down_;
};

/// The plan of somebody who guesses `by`.
/// @param covariance of the logarithms, from earlier points; empty: there are none
/// @param draws 1: a plan for these values alone
ExperimentPlan plan_of(const Factors& by, const PlanOptions& options,
                       const Eigen::MatrixXd& covariance, int draws = recoil::guesses_drawn) {
  const recoil::FitSpec spec = recoil::synthetic::spec(by.size() > 2);
  Design design = changed(by);
  design.velocities.clear();
  const std::vector<recoil::Dataset> datasets =
      recoil::datasets_to_plan({recoil::synthetic::dataset(design)}, options.diameters);
  const recoil::ImpactModel model = recoil::make_model(spec, datasets);
  recoil::Guess guess{model.initial(), {}};
  const std::vector<std::size_t> slots = {model.slot_C_H[0], model.slot_C_A[0],
                                          model.slot_adhesion[0]};
  guess.theta[slots[0]] = design.C_H;
  guess.theta[slots[1]] = design.C_A;
  guess.theta[slots[2]] = design.f0;
  if (covariance.size() > 0) {
    const std::size_t n = model.slots.size();
    guess.covariance.assign(n, std::vector<double>(n, 0.0));
    for (std::size_t i = 0; i < by.size(); ++i) {
      for (std::size_t j = 0; j < by.size(); ++j) {
        guess.covariance[slots[i]][slots[j]] =
            covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
            guess.theta[slots[i]] * guess.theta[slots[j]];
      }
    }
  }
  return recoil::plan_experiment(spec, datasets, recoil::drawn_values(model, guess, 1, draws),
                                 options);
}

/// All truths that are a factor of two away in some or all parameters: {1/2, 1, 2}^p without the
/// guess itself.
std::vector<Factors> wrong_by_two(std::size_t parameters) {
  std::vector<Factors> all = {{}};
  for (std::size_t j = 0; j < parameters; ++j) {
    std::vector<Factors> longer;
    for (const Factors& one : all) {
      for (const double factor : {0.5, 1.0, 2.0}) {
        longer.push_back(one);
        longer.back().push_back(factor);
      }
    }
    all = longer;
  }
  std::erase(all, Factors(parameters, 1.0));
  return all;
}

PlanOptions far_sizes() {
  PlanOptions options;
  options.diameters = {2.58e-6, 4.9e-6};
  options.slowest = 0.5;
  options.fastest = 80.0;
  options.impacts = 2000;
  return options;
}

/// 1 - efficiency: the information lost against a plan for the right values with as many impacts.
struct Losses {
  std::vector<double> local, robust, two_steps;  // of each truth
};

/// The guess is wrong by each of `truths`. `two_steps` measures a quarter of the impacts by the
/// robust plan and plans the rest from an estimate with the errors of these points.
Losses losses(const std::vector<Factors>& truths, const PlanOptions& options) {
  const Factors guess(truths.front().size(), 1.0);
  PlanOptions first = options, rest = options;
  first.impacts = options.impacts / 4;
  rest.impacts = options.impacts - first.impacts;
  const ExperimentPlan local = plan_of(guess, options, {}, 1);
  const ExperimentPlan robust = plan_of(guess, options, {});
  const ExperimentPlan begun = plan_of(guess, first, {});
  Losses all;
  for (std::size_t k = 0; k < truths.size(); ++k) {
    const Judge judge(truths[k], options);
    const double least = judge.sum_of_variances(plan_of(truths[k], options, {}, 1).settings);
    const auto lost = [&](const std::vector<PlannedSetting>& settings) {
      return 1.0 - least / judge.sum_of_variances(settings);
    };
    all.local.push_back(lost(local.settings));
    all.robust.push_back(lost(robust.settings));
    const Eigen::MatrixXd covariance = judge.covariance(begun.settings);
    std::mt19937_64 random(k);
    std::normal_distribution<double> normal;
    Eigen::VectorXd z(covariance.rows());
    for (double& one : z) one = normal(random);
    z = covariance.llt().matrixL() * z;
    Factors estimate = truths[k];
    for (std::size_t j = 0; j < estimate.size(); ++j) {
      estimate[j] *= std::exp(z(static_cast<Eigen::Index>(j)));
    }
    std::vector<PlannedSetting> both = plan_of(estimate, rest, covariance).settings;
    both.insert(both.end(), begun.settings.begin(), begun.settings.end());
    all.two_steps.push_back(lost(both));
  }
  return all;
}

double middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double worst(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

void expect_little_lost(const Losses& all) {
  for (const auto* one : {&all.local, &all.robust, &all.two_steps}) {
    std::printf("information lost: median %.3f, worst %.3f of %zu\n", middle(*one), worst(*one),
                one->size());
  }
  EXPECT_LT(worst(all.robust), worst(all.local));
  EXPECT_LT(middle(all.two_steps), 0.15);
  EXPECT_LT(worst(all.two_steps), worst(all.robust));
}

TEST(WrongGuess, OfTwoParametersCostsLittleInTwoSteps) {
  expect_little_lost(losses(wrong_by_two(2), far_sizes()));
}

TEST(WrongGuess, OfThreeParametersCostsLittleInTwoSteps) {
  expect_little_lost(
      losses({{0.5, 0.5, 0.5}, {0.5, 2.0, 2.0}, {2.0, 0.5, 2.0}, {2.0, 2.0, 0.5}}, far_sizes()));
}

// C_H and C_A as a fit knows them, correlated; f0 as a guess does: ln f0 has the deviation ln 2.
TEST(WrongGuess, DrawsHaveTheCovarianceOfAFitOrAFactorOfTwo) {
  const recoil::ImpactModel model =
      recoil::make_model(recoil::synthetic::spec(true), {recoil::synthetic::dataset(Design{})});
  const std::size_t h = model.slot_C_H[0], a = model.slot_C_A[0], f = model.slot_adhesion[0];
  recoil::Guess guess{model.initial(), {}};
  const std::size_t n = model.slots.size();
  guess.covariance.assign(n, std::vector<double>(n, 0.0));
  const double sd_h = 0.05 * guess.theta[h], sd_a = 0.1 * guess.theta[a];
  guess.covariance[h][h] = sd_h * sd_h;
  guess.covariance[a][a] = sd_a * sd_a;
  guess.covariance[h][a] = guess.covariance[a][h] = -0.6 * sd_h * sd_a;
  constexpr int count = 20000;
  const auto draws = recoil::drawn_values(model, guess, 3, count);
  EXPECT_EQ(draws.front(), guess.theta);
  EXPECT_EQ(draws, recoil::drawn_values(model, guess, 3, count));
  double hh = 0.0, aa = 0.0, ha = 0.0, ff = 0.0, hf = 0.0;
  for (const std::vector<double>& theta : draws) {
    const double of_h = std::log(theta[h] / guess.theta[h]);
    const double of_a = std::log(theta[a] / guess.theta[a]);
    const double of_f = std::log(theta[f] / guess.theta[f]);
    hh += of_h * of_h / count;
    aa += of_a * of_a / count;
    ha += of_h * of_a / count;
    ff += of_f * of_f / count;
    hf += of_h * of_f / count;
  }
  EXPECT_NEAR(std::sqrt(hh), 0.05, 0.002);
  EXPECT_NEAR(std::sqrt(aa), 0.1, 0.003);
  EXPECT_NEAR(ha / std::sqrt(hh * aa), -0.6, 0.03);
  EXPECT_NEAR(std::sqrt(ff), std::log(2.0), 0.02);
  EXPECT_NEAR(hf / std::sqrt(hh * ff), 0.0, 0.03);
}

}  // namespace
