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

  /// The relative variances of parameters and capture velocities under the settings of a plan.
  Eigen::VectorXd variances(const std::vector<PlannedSetting>& settings) const {
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
      const double rebounds = options_.events * (1.0 - now.captured);
      if (rebounds < 0.5) continue;
      information += impacts * (1.0 - now.captured) / now.variance * mean * mean.transpose();
    }
    const Eigen::MatrixXd covariance = information.inverse();
    Eigen::VectorXd all(p + static_cast<Eigen::Index>(options_.diameters.size()));
    all.head(p) = covariance.diagonal();
    Eigen::Index next = p;
    for (const double diameter : options_.diameters) {
      Eigen::VectorXd slope(p);
      for (Eigen::Index j = 0; j < p; ++j) {
        const auto k = static_cast<std::size_t>(j);
        slope(j) =
            std::log(up_[k].capture.at(diameter) / down_[k].capture.at(diameter)) / (2.0 * step);
      }
      all(next++) = slope.dot(covariance * slope);
    }
    return all;
  }

 private:
  static constexpr double step = 0.02;
  PlanOptions options_;
  World here_;
  std::vector<World> up_, down_;
};

/// The plan of somebody who guesses `by`, for those values alone or for draws about them.
ExperimentPlan plan_of(const Factors& by, const PlanOptions& options, bool for_draws) {
  const recoil::FitSpec spec = recoil::synthetic::spec(by.size() > 2);
  Design design = changed(by);
  design.velocities.clear();
  const std::vector<recoil::Dataset> datasets =
      recoil::datasets_to_plan({recoil::synthetic::dataset(design)}, options.diameters);
  const recoil::ImpactModel model = recoil::make_model(spec, datasets);
  recoil::Guess guess{model.initial(), {}};
  guess.theta[model.slot_C_H[0]] = design.C_H;
  guess.theta[model.slot_C_A[0]] = design.C_A;
  guess.theta[model.slot_adhesion[0]] = design.f0;
  return recoil::plan_experiment(
      spec, datasets, recoil::drawn_values(model, guess, 1, for_draws ? recoil::guesses_drawn : 1),
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

double middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}
double most(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

std::vector<double> theta_of(const Factors& by, const recoil::ImpactModel& model) {
  Design design = changed(by);
  std::vector<double> theta = model.initial();
  theta[model.slot_C_H[0]] = design.C_H;
  theta[model.slot_C_A[0]] = design.C_A;
  theta[model.slot_adhesion[0]] = design.f0;
  return theta;
}

ExperimentPlan plan_for_all(const std::vector<Factors>& all, const PlanOptions& options) {
  const recoil::FitSpec spec = recoil::synthetic::spec(all.front().size() > 2);
  Design design;
  design.velocities.clear();
  const std::vector<recoil::Dataset> datasets =
      recoil::datasets_to_plan({recoil::synthetic::dataset(design)}, options.diameters);
  const recoil::ImpactModel model = recoil::make_model(spec, datasets);
  std::vector<std::vector<double>> draws;
  for (const Factors& one : all) draws.push_back(theta_of(one, model));
  return recoil::plan_experiment(spec, datasets, draws, options);
}

std::vector<PlannedSetting> joined(std::vector<PlannedSetting> one,
                                   const std::vector<PlannedSetting>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

void losses(std::size_t parameters, PlanOptions options) {
  const Factors guess(parameters, 1.0);
  const ExperimentPlan robust = plan_of(guess, options, true);
  const ExperimentPlan local = plan_of(guess, options, false);
  const ExperimentPlan ceiling = plan_for_all(wrong_by_two(parameters), options);
  PlanOptions quarter = options, rest = options;
  quarter.impacts = options.impacts / 4;
  rest.impacts = options.impacts - quarter.impacts;
  const ExperimentPlan first = plan_of(guess, quarter, true);
  std::vector<double> r, l, c, t;
  for (const Factors& truth : wrong_by_two(parameters)) {
    const Judge judge(truth, options);
    const double least = judge.variances(plan_of(truth, options, false).settings).sum();
    r.push_back(1.0 - least / judge.variances(robust.settings).sum());
    l.push_back(1.0 - least / judge.variances(local.settings).sum());
    c.push_back(1.0 - least / judge.variances(ceiling.settings).sum());
    t.push_back(
        1.0 -
        least /
            judge.variances(joined(first.settings, plan_of(truth, rest, false).settings)).sum());
    for (const double f : truth) std::printf("%5.2f", f);
    std::printf("  %6.3f %6.3f %6.3f %6.3f\n", r.back(), l.back(), c.back(), t.back());
  }
  std::printf(
      "median robust %.3f local %.3f ceiling %.3f two stages %.3f worst %.3f %.3f %.3f %.3f\n",
      middle(r), middle(l), middle(c), middle(t), most(r), most(l), most(c), most(t));
}

TEST(WrongGuess, TwoParameters) { losses(2, far_sizes()); }
TEST(WrongGuess, ThreeParameters) { losses(3, far_sizes()); }

}  // namespace
