// A plan keeps what it promises: its errors are those of fits to simulated experiments, and no
// experiment that is evenly spaced does better.
#include "plan/experiment_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "coverage/simulated_impacts.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/fit.hpp"
#include "support/mistake.hpp"
#include "support/synthetic.hpp"

namespace {

using recoil::ExperimentPlan;
using recoil::PlannedQuantity;
using recoil::PlannedSetting;
using recoil::PlanOptions;
using recoil::synthetic::Design;

/// Materials and no points.
recoil::Dataset without_points() {
  Design design;
  design.velocities.clear();
  return recoil::synthetic::dataset(design);
}

PlanOptions two_sizes() {
  PlanOptions options;
  options.diameters = {2.58e-6, 4.9e-6};
  options.slowest = 1.0;
  options.fastest = 80.0;
  return options;
}

ExperimentPlan plan_for(const PlanOptions& options, bool f0_free = false) {
  const recoil::FitSpec spec = recoil::synthetic::spec(f0_free);
  const std::vector<recoil::Dataset> datasets =
      recoil::datasets_to_plan({without_points()}, options.diameters);
  recoil::ImpactModel model = recoil::make_model(spec, datasets);
  const Design truth;
  std::vector<double> theta = model.initial();
  theta[model.slot_C_H[0]] = truth.C_H;
  theta[model.slot_C_A[0]] = truth.C_A;
  theta[model.slot_adhesion[0]] = truth.f0;
  return recoil::plan_experiment(spec, datasets, {theta}, options);
}

const PlannedQuantity& quantity(const ExperimentPlan& plan, const std::string& label) {
  for (const PlannedQuantity& one : plan.quantities) {
    if (one.label == label) return one;
  }
  throw std::out_of_range(label);
}

const PlannedQuantity& capture(const ExperimentPlan& plan, double diameter) {
  for (const PlannedQuantity& one : plan.quantities) {
    if (!one.is_parameter() && one.diameter == diameter) return one;
  }
  throw std::out_of_range("capture velocity");
}

int points_of(const ExperimentPlan& plan) {
  int points = 0;
  for (const PlannedSetting& setting : plan.settings) points += setting.points;
  return points;
}

/// The experiment, from the simulator of the reconstructions: impacts whose capture velocities
/// differ, each e read with an error; of every point the mean and its deviation as one would state
/// it, from the differences of its impacts.
class Laboratory {
 public:
  explicit Laboratory(const ExperimentPlan& plan) : plan_(plan) {
    const recoil::Truth truth = recoil::synthetic::truth_of(Design{});
    for (const double diameter : plan.options.diameters) {
      curves_.try_emplace(
          diameter, [&](double v) { return recoil::true_restitution(truth, diameter, v); },
          recoil::true_capture_velocity(truth, diameter), 200.0);
    }
  }

  recoil::Dataset experiment(std::mt19937_64& random) const {
    std::normal_distribution<double> normal;
    recoil::Dataset dataset = plan_.datasets.front();
    const std::vector<recoil::ImpactPoint> settings = dataset.points;
    dataset.points.clear();
    for (std::size_t i = 0; i < settings.size(); ++i) {
      const recoil::TrueCurve& curve = curves_.at(settings[i].diameter);
      for (int k = 0; k < plan_.settings[i].points; ++k) {
        recoil::ImpactPoint point = settings[i];
        point.events = plan_.options.events;
        std::vector<double> seen;
        for (int n = 0; n < point.events; ++n) {
          const double e =
              curve(point.incident_velocity * std::exp(plan_.options.spread * normal(random)));
          if (!(e > 0.0)) continue;
          seen.push_back(e + std::hypot(plan_.options.scatter * e, plan_.options.floor) *
                                 normal(random));
        }
        finish(point, seen);
        dataset.points.push_back(point);
      }
    }
    return dataset;
  }

 private:
  static void finish(recoil::ImpactPoint& point, const std::vector<double>& seen) {
    const auto n = static_cast<double>(seen.size());
    point.captured = point.events - static_cast<int>(seen.size());
    point.counted = true;
    point.restitution = 0.0;
    point.restitution_sd.reset();
    if (seen.empty()) return;
    double sum = 0.0;
    double squares = 0.0;
    for (const double e : seen) sum += e;
    for (const double e : seen) squares += std::pow(e - sum / n, 2);
    point.restitution = std::max(sum / n, 1e-3);
    point.restitution_sd = n > 2.0 ? std::sqrt(squares / (n * (n - 1.0))) : 0.05;
  }

  const ExperimentPlan& plan_;
  std::map<double, recoil::TrueCurve> curves_;
};

struct Spread {
  double sum = 0.0, squares = 0.0;
  int count = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double sd() const {
    const double mean = sum / count;
    return std::sqrt((squares - count * mean * mean) / (count - 1));
  }
};

void expect_errors_of_fits(const PlanOptions& options, std::uint64_t seed) {
  const ExperimentPlan plan = plan_for(options);
  const Laboratory laboratory(plan);
  const recoil::FitSpec spec = recoil::synthetic::spec();
  recoil::FitOptions once;
  once.several_starts = false;
  Spread C_H, C_A, small, large;
  std::mt19937_64 random(seed);
  int lost = 0;
  constexpr int experiments = 300;
  for (int k = 0; k < experiments; ++k) {
    const std::vector<recoil::Dataset> datasets = {laboratory.experiment(random)};
    const recoil::FitResult fitted =
        recoil::fit(recoil::make_model(spec, datasets), recoil::gather(datasets, spec), once);
    if (!fitted.usable) {
      ++lost;
      continue;
    }
    C_H.add(fitted.theta[fitted.model.slot_C_H[0]]);
    C_A.add(fitted.theta[fitted.model.slot_C_A[0]]);
    small.add(recoil::capture_velocity(fitted.model, fitted.theta, 0, 2.58e-6).value);
    large.add(recoil::capture_velocity(fitted.model, fitted.theta, 0, 4.9e-6).value);
  }
  EXPECT_LE(lost, experiments / 50);
  const auto expect_near = [](const PlannedQuantity& promised, const Spread& found,
                              const char* name) {
    const double ratio = found.sd() / (promised.error * promised.value);
    EXPECT_GT(ratio, 0.85) << name;
    EXPECT_LT(ratio, 1.15) << name;
  };
  expect_near(quantity(plan, "C_H"), C_H, "C_H");
  expect_near(quantity(plan, "C_A"), C_A, "C_A");
  expect_near(capture(plan, 2.58e-6), small, "V* of 2.58 um");
  expect_near(capture(plan, 4.9e-6), large, "V* of 4.9 um");
}

TEST(ExperimentPlan, ItsErrorsAreThoseOfFits) {
  PlanOptions options = two_sizes();
  options.impacts = 1600;
  options.events = 40;
  expect_errors_of_fits(options, 1);
}

TEST(ExperimentPlan, ItsErrorsAreThoseOfFitsWhereAllSpheresAreAlike) {
  PlanOptions options = two_sizes();
  options.impacts = 1600;
  options.events = 40;
  options.spread = 0.0;
  options.checks = 1.0;  // evenly: the best points lie where every sphere is about to stay
  options.slowest = 4.0;
  expect_errors_of_fits(options, 2);
}

/// Sum of the relative variances of C_H and C_A, by slopes of the other simulator and the inverse
/// of a 2 x 2 matrix. All impacts of a size are alike, so that captured ones tell nothing.
double independent_sum(const std::vector<PlannedSetting>& settings, const PlanOptions& options) {
  const auto e_at = [](const PlannedSetting& at, double C_H, double C_A) {
    recoil::Truth truth = recoil::synthetic::truth_of(Design{});
    truth.C_H *= C_H;
    truth.C_A *= C_A;
    return recoil::true_restitution(truth, at.diameter, at.velocity);
  };
  double a = 0.0, b = 0.0, c = 0.0;
  constexpr double h = 1e-4;
  for (const PlannedSetting& at : settings) {
    const double e = e_at(at, 1.0, 1.0);
    if (!(e > 0.05)) continue;
    const double by_C_H = (e_at(at, 1.0 + h, 1.0) - e_at(at, 1.0 - h, 1.0)) / (2.0 * h);
    const double by_C_A = (e_at(at, 1.0, 1.0 + h) - e_at(at, 1.0, 1.0 - h)) / (2.0 * h);
    const double own = std::hypot(options.scatter * e, options.floor);
    const double weight = at.points * options.events / (own * own);
    a += weight * by_C_H * by_C_H;
    b += weight * by_C_H * by_C_A;
    c += weight * by_C_A * by_C_A;
  }
  return (a + c) / (a * c - b * b);
}

TEST(ExperimentPlan, IsAtLeastAsGoodAsEvenlySpacedOnes) {
  PlanOptions options = two_sizes();
  options.spread = 0.0;
  options.checks = 0.0;
  options.slowest = 4.0;
  options.impacts = 800;
  for (const double diameter : {2.58e-6, 4.9e-6}) {
    options.diameters = {diameter};
    const ExperimentPlan plan = plan_for(options);
    std::vector<PlannedSetting> even;
    for (int k = 0; k < plan.points; ++k) {
      PlannedSetting setting;
      setting.diameter = diameter;
      setting.velocity = 4.0 * std::pow(20.0, k / (plan.points - 1.0));
      setting.points = 1;
      even.push_back(setting);
    }
    EXPECT_LT(independent_sum(plan.settings, options), 0.9 * independent_sum(even, options));
    // and what it says of both is what they are
    const double said =
        std::pow(quantity(plan, "C_H").error, 2) + std::pow(quantity(plan, "C_A").error, 2);
    EXPECT_NEAR(said / independent_sum(plan.settings, options), 1.0, 0.05);
    for (const PlannedQuantity& one : plan.quantities) {
      EXPECT_LE(*one.alone_impacts, *one.impacts * 1.02) << one.label;
    }
  }
}

TEST(ExperimentPlan, TheFewestImpactsThatGiveTheWantedError) {
  PlanOptions options = two_sizes();
  options.error = 0.02;  // needs more than the fewest points
  const ExperimentPlan plan = plan_for(options);
  EXPECT_TRUE(plan.reached);
  EXPECT_EQ(points_of(plan), plan.points);
  double worst = 0.0;
  for (const PlannedQuantity& one : plan.quantities) worst = std::max(worst, one.error);
  EXPECT_LE(worst, 0.02);
  EXPECT_GT(worst, 0.018);
  options.impacts = plan.impacts / 2;
  const ExperimentPlan half = plan_for(options);
  EXPECT_FALSE(half.reached);
  EXPECT_LE(half.impacts, options.impacts);
  EXPECT_NEAR(half.points, 0.5 * plan.points, 1.0);
}

TEST(ExperimentPlan, APartOfThePointsChecksTheModel) {
  PlanOptions options = two_sizes();
  options.impacts = 2000;
  options.checks = 0.0;
  const ExperimentPlan none = plan_for(options);
  options.checks = 0.4;
  const ExperimentPlan some = plan_for(options);
  EXPECT_GE(some.settings.size(), none.settings.size() + 15);
  EXPECT_GT(none.efficiency, 0.9);
  EXPECT_LE(none.efficiency, 1.0 + 1e-9);
  EXPECT_LT(some.efficiency, none.efficiency);
  EXPECT_GT(some.efficiency, 0.6);
}

// A size that is captured at every velocity within reach is left alone; the other one is measured.
TEST(ExperimentPlan, NoPointIsWastedOnSpheresThatNeverReturn) {
  PlanOptions options = two_sizes();
  options.slowest = 0.9;
  options.fastest = 2.0;  // V* of 2.58 um is 2.3 m/s
  options.impacts = 4000;
  const ExperimentPlan plan = plan_for(options);
  int wasted = 0;
  for (const PlannedSetting& setting : plan.settings) {
    if (setting.captured > 0.99) wasted += setting.points;
  }
  EXPECT_LE(wasted, 1);
}

// Where f0 is free it can be learnt, and everything else becomes harder.
TEST(ExperimentPlan, AFurtherParameterCosts) {
  PlanOptions options = two_sizes();
  options.impacts = 1000;
  const ExperimentPlan two = plan_for(options);
  const ExperimentPlan three = plan_for(options, true);
  EXPECT_EQ(three.quantities.size(), two.quantities.size() + 1);
  EXPECT_GT(quantity(three, "C_A").error, quantity(two, "C_A").error);
  EXPECT_GT(quantity(three, "f0").error, 0.0);
}

// A density that is known to 10 % only: V / V_a decides, V_a ~ f0^(5/4) density^(-1/2), so that f0
// follows it with the power 2/5, however many impacts there are; the capture velocity itself is
// seen.
TEST(ExperimentPlan, ConstantsWithAnErrorLimitWhatCanBeKnown) {
  PlanOptions options = two_sizes();
  options.impacts = 20000;
  const recoil::FitSpec spec = recoil::synthetic::spec(true);
  recoil::Dataset dataset = without_points();
  dataset.system.errors.push_back({recoil::Body::particle, recoil::Constant::density, 135.0});
  const std::vector<recoil::Dataset> datasets =
      recoil::datasets_to_plan({dataset}, options.diameters);
  const recoil::ImpactModel model = recoil::make_model(spec, datasets);
  ASSERT_FALSE(model.constants.empty());
  const ExperimentPlan plan = recoil::plan_experiment(spec, datasets, {model.initial()}, options);
  EXPECT_NEAR(quantity(plan, "f0").error, 0.4 * std::sqrt(std::log(1.01)), 0.002);
  options.error = 0.02;
  const ExperimentPlan wanted = recoil::plan_experiment(spec, datasets, {model.initial()}, options);
  EXPECT_FALSE(wanted.reached);
  EXPECT_FALSE(quantity(wanted, "f0").impacts) << "no number of impacts determines so well";
  EXPECT_TRUE(quantity(wanted, "C_H").impacts);
  EXPECT_LT(capture(plan, 4.9e-6).error, 0.02);
}

TEST(ExperimentPlan, F0BelongsToTheDiameterToWhichItDid) {
  recoil::Dataset dataset = without_points();
  dataset.system.reference_diameter.reset();
  dataset.system.adhesion_force_f0.reset();
  const auto of_plan = recoil::datasets_to_plan({dataset}, {5e-6, 1e-6, 2e-6, 2e-6});
  EXPECT_EQ(of_plan[0].system.reference_diameter, 2e-6);
  EXPECT_EQ(of_plan[0].points.size(), 3U);
  recoil::ImpactPoint point;
  point.diameter = 7e-6;
  dataset.points = {point};
  EXPECT_EQ(recoil::datasets_to_plan({dataset}, {1e-6})[0].system.reference_diameter, 7e-6);
  EXPECT_EQ(recoil::datasets_to_plan({dataset}, {})[0].points.front().diameter, 7e-6);
}

TEST(ExperimentPlan, WhatCannotBePlannedIsSaid) {
  PlanOptions options = two_sizes();
  EXPECT_NE(support::message_of([] {
              recoil::datasets_to_plan({without_points()}, {});
            }).find("the diameters of the spheres are not known"),
            std::string::npos);
  recoil::FitSpec fixed = recoil::synthetic::spec();
  for (recoil::ParameterSpec& parameter : fixed.parameters) parameter.free = false;
  const auto datasets = recoil::datasets_to_plan({without_points()}, options.diameters);
  const std::vector<double> theta = recoil::make_model(fixed, datasets).initial();
  EXPECT_NE(support::message_of([&] {
              recoil::plan_experiment(fixed, datasets, {theta}, options);
            }).find("no parameter is free"),
            std::string::npos);
  options.slowest = 0.01;  // everything is captured
  options.fastest = 0.02;
  EXPECT_THROW(plan_for(options), recoil::ComputationError);
}

}  // namespace
