// What the plan says of causes, against refits of what they would do.
#include "plan/planned_causes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/candidate.hpp"
#include "diagnosis/other_target.hpp"
#include "estimate/fit.hpp"
#include "estimate/predictor.hpp"
#include "mechanism/catalogue.hpp"
#include "plan/datasets_to_plan.hpp"
#include "plan/experiment_plan.hpp"
#include "plan/planned_target.hpp"
#include "support/synthetic.hpp"

namespace {

using recoil::Condition;
using recoil::ExperimentPlan;
using recoil::PlannedCause;
using recoil::PlanOptions;

recoil::Dataset materials_alone() {
  recoil::synthetic::Design design;
  design.velocities.clear();
  return recoil::synthetic::dataset(design);
}

ExperimentPlan examined_plan(const recoil::FitSpec& spec, const recoil::Dataset& dataset,
                             int impacts = 2000,
                             std::vector<double> diameters = {2.58e-6, 4.9e-6}) {
  PlanOptions options;
  options.diameters = std::move(diameters);
  options.slowest = 2.0;
  options.fastest = 80.0;
  options.impacts = impacts;
  const auto datasets = recoil::datasets_to_plan({dataset}, options.diameters);
  return recoil::plan_experiment(spec, datasets, recoil::make_model(spec, datasets).initial(),
                                 options);
}

/// Evenly spread points of spheres that are all alike.
ExperimentPlan plan_of_equal_spheres(const recoil::FitSpec& spec) {
  PlanOptions options;
  options.diameters = {2.58e-6, 4.9e-6};
  options.slowest = 5.0;
  options.fastest = 80.0;
  options.impacts = 2000;
  options.spread = 0.0;
  options.checks = 1.0;
  const auto datasets = recoil::datasets_to_plan({materials_alone()}, options.diameters);
  return recoil::plan_experiment(spec, datasets, recoil::make_model(spec, datasets).initial(),
                                 options);
}

recoil::FitSpec exact_laws() {
  recoil::FitSpec spec = recoil::synthetic::spec();
  spec.law_error = 0.0;
  return spec;
}

const PlannedCause* cause_of(const ExperimentPlan& plan, const std::string& id) {
  const auto found = std::find_if(plan.expected.causes.begin(), plan.expected.causes.end(),
                                  [&](const PlannedCause& cause) { return cause.id == id; });
  return found == plan.expected.causes.end() ? nullptr : &*found;
}

/// What the base model leaves of the effect of `id` when it is refitted to e that have it, without
/// noise and with the standard deviations of the plan: half of chi2.
double log_odds_by_refit(const recoil::FitSpec& spec, const ExperimentPlan& plan,
                         const PlannedCause& cause) {
  const recoil::Candidate with = recoil::make_candidate(spec, plan.datasets, {cause.id});
  std::vector<double> theta = with.model.initial();
  for (std::size_t j = 0; j < theta.size(); ++j) {
    const recoil::ParameterSlot& slot = with.model.slots[j];
    if (slot.parameter->name == cause.parameter) theta[j] = cause.strength;
    for (std::size_t k = 0; k < plan.theta.size(); ++k) {
      if (plan.model.slots[k].label() == slot.label()) theta[j] = plan.theta[k];
    }
  }
  std::vector<recoil::Dataset> datasets;
  datasets.push_back(plan.datasets.front());
  std::vector<recoil::ImpactPoint>& points = datasets.front().points;
  for (recoil::ImpactPoint& point : points) {
    point.restitution =
        recoil::predict(with.model, theta, 0, point.diameter, point.incident_velocity, false)
            .restitution();
    point.captured = 0;
  }
  std::erase_if(points, [](const recoil::ImpactPoint& point) {
    return point.restitution < 0.1 || !point.restitution_sd;
  });
  recoil::FitOptions options;
  options.several_starts = false;
  options.start = plan.theta;
  const recoil::FitResult fitted =
      recoil::fit(recoil::make_model(spec, datasets), recoil::gather(datasets, spec), options);
  return 0.5 * fitted.chi2;
}

TEST(PlannedCauses, WhatIsSeenIsWhatARefitLeaves) {
  const recoil::FitSpec spec = exact_laws();
  const ExperimentPlan plan = plan_of_equal_spheres(spec);
  int compared = 0;
  for (const PlannedCause& cause : plan.expected.causes) {
    if (std::abs(cause.change) > 0.05 || cause.log_odds < 0.05) continue;  // linear, and visible
    EXPECT_NEAR(cause.log_odds / log_odds_by_refit(spec, plan, cause), 1.0, 0.3) << cause.id;
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

TEST(PlannedCauses, ErrorsOfLawsMakeThemHarderToSee) {
  const ExperimentPlan exact = examined_plan(exact_laws(), materials_alone());
  const ExperimentPlan doubtful = examined_plan(recoil::synthetic::spec(), materials_alone());
  ASSERT_EQ(exact.expected.causes.size(), doubtful.expected.causes.size());
  for (const PlannedCause& cause : exact.expected.causes) {
    EXPECT_LE(cause_of(doubtful, cause.id)->log_odds, cause.log_odds * (1.0 + 1e-6)) << cause.id;
  }
}

TEST(PlannedCauses, EveryOneOfTheListIsSaidOnceAndWithinWhatItCanBe) {
  const ExperimentPlan plan = examined_plan(recoil::synthetic::spec(), materials_alone());
  std::set<std::string> ids;
  for (const PlannedCause& cause : plan.expected.causes) {
    EXPECT_TRUE(ids.insert(cause.id).second) << cause.id;
    EXPECT_GE(cause.strength, cause.lower) << cause.id;
    EXPECT_LE(cause.strength, cause.upper) << cause.id;
    EXPECT_GE(cause.log_odds, 0.0) << cause.id;
    EXPECT_TRUE(std::isfinite(cause.log_odds)) << cause.id;
    EXPECT_LE(static_cast<int>(cause.confused.size()), cause.rivals) << cause.id;
    if (!cause.seen()) {
      EXPECT_TRUE(cause.confused.empty()) << cause.id;
    } else {
      EXPECT_FALSE(cause.remedy) << cause.id;
    }
    for (const recoil::Confusion& rival : cause.confused) {
      EXPECT_LT(rival.log_odds, recoil::wanted_log_odds) << cause.id << " " << rival.id;
    }
  }
  EXPECT_GT(ids.size(), 10U);
}

// One size cannot tell what acts on the size alone from the adhesion; the manual of the mechanism
// says so.
TEST(PlannedCauses, BulkViscosityIsNotToldFromTheBaseModelAtOneSize) {
  const ExperimentPlan one = examined_plan(exact_laws(), materials_alone(), 4000, {4.9e-6});
  const ExperimentPlan two = examined_plan(exact_laws(), materials_alone(), 4000);
  ASSERT_NE(cause_of(one, "bulk_viscoelastic"), nullptr);
  EXPECT_LT(cause_of(one, "bulk_viscoelastic")->log_odds,
            cause_of(two, "bulk_viscoelastic")->log_odds);
}

TEST(PlannedCauses, ConditionsThatAreStatedTakeCausesAway) {
  recoil::Dataset vacuum = materials_alone();
  EXPECT_NE(cause_of(examined_plan(exact_laws(), vacuum), "gas_film"), nullptr);
  vacuum.system.conditions.set(Condition::ambient_pressure, 0.0);
  EXPECT_EQ(cause_of(examined_plan(exact_laws(), vacuum), "gas_film"), nullptr);
  vacuum.system.conditions.set(Condition::ambient_pressure, 1e5);
  const ExperimentPlan air = examined_plan(exact_laws(), vacuum);
  ASSERT_NE(cause_of(air, "gas_film"), nullptr);
  EXPECT_TRUE(cause_of(air, "gas_film")->stated);
  EXPECT_EQ(cause_of(air, "gas_film")->strength, 1e5);
}

// Where two causes are not told apart, a condition that takes one of them away can be what helps:
// it is one that does so, and it is never offered for two that it takes away together.
TEST(PlannedCauses, RemediesAreOfTheirCauses) {
  const ExperimentPlan plan = examined_plan(recoil::synthetic::spec(), materials_alone(), 600);
  int conditions = 0;
  int remedies = 0;
  const auto look = [&](const std::optional<recoil::PlanRemedy>& remedy) {
    if (!remedy) return;
    ++remedies;
    EXPECT_GE(remedy->impacts, 1);
    EXPECT_GE(remedy->velocity, 0.69 * plan.options.slowest);
    EXPECT_LE(remedy->velocity, 1.51 * plan.options.fastest);
    if (remedy->kind != recoil::ExperimentKind::condition) return;
    ++conditions;
    EXPECT_FALSE(remedy->doing.empty());
  };
  for (const PlannedCause& cause : plan.expected.causes) {
    look(cause.remedy);
    for (const recoil::Confusion& rival : cause.confused) look(rival.remedy);
  }
  // The steps and what is beyond reach are all that the plan lacks, each once.
  std::multiset<recoil::CausePair> named(plan.expected.beyond.begin(), plan.expected.beyond.end());
  for (const recoil::PlanStep& step : plan.expected.steps) {
    look(step.remedy);
    EXPECT_EQ(step.remedy.impacts % plan.options.events, 0);
    named.insert(step.tells.begin(), step.tells.end());
  }
  std::set<recoil::CausePair> lacking;
  for (const PlannedCause& cause : plan.expected.causes) {
    if (!cause.seen()) lacking.insert({cause.id, ""});
    for (const recoil::Confusion& rival : cause.confused) {
      lacking.insert({std::min(cause.id, rival.id), std::max(cause.id, rival.id)});
    }
  }
  EXPECT_TRUE(std::equal(named.begin(), named.end(), lacking.begin(), lacking.end()));
  EXPECT_GT(remedies, 5);
  EXPECT_GT(conditions, 0);
}

/// Half of the chi2 that the base model leaves when it is refitted to e of both targets that have
/// the effect of `cause`: `impacts` on the second one, at the places of `remedy`. C_H and C_A are
/// each target's own; so is f0 on the second one where `free_f0`.
double log_odds_on_two_targets(const recoil::FitSpec& spec, const ExperimentPlan& plan,
                               const PlannedCause& cause, const recoil::PlanRemedy& remedy,
                               bool free_f0) {
  std::vector<recoil::Dataset> datasets = {plan.datasets.front()};
  datasets.push_back(recoil::on_target(datasets.front(), remedy.material));
  for (const recoil::ExperimentPlace& place : remedy.places) {
    recoil::ImpactPoint point;
    point.diameter = place.diameter;
    point.incident_velocity = place.velocity;
    point.events = place.events;
    datasets.back().points.push_back(point);
  }
  recoil::FitSpec own = spec;
  for (recoil::ParameterSpec& stated : own.parameters) {
    stated.per_dataset = true;
    if (stated.parameter->is_adhesion()) stated.free = free_f0;
  }
  const recoil::Candidate with = recoil::make_candidate(own, datasets, {cause.id});
  std::vector<double> theta = with.model.initial();
  for (std::size_t j = 0; j < theta.size(); ++j) {
    if (with.model.slots[j].parameter->name == cause.parameter) theta[j] = cause.strength;
  }
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (recoil::ImpactPoint& point : datasets[d].points) {
      point.restitution =
          recoil::predict(with.model, theta, d, point.diameter, point.incident_velocity, false)
              .restitution();
      point.captured = 0;
      const double sd = std::hypot(plan.options.scatter * point.restitution, plan.options.floor);
      if (d == 1) point.restitution_sd = sd / std::sqrt(point.events);
    }
    std::erase_if(datasets[d].points, [](const recoil::ImpactPoint& point) {
      return point.restitution < 0.1 || !point.restitution_sd;
    });
  }
  const recoil::FitResult fitted =
      recoil::fit(recoil::make_model(own, datasets), recoil::gather(datasets, own), {});
  return 0.5 * fitted.chi2;
}

// What bulk viscosity does depends on how long a contact lasts, so a stiffer or softer target shows
// it: the odds are those of a refit, within the errors of straight lines and of priors that a refit
// does not know.
TEST(PlannedTarget, ShowsWhatARefitOfBothTargetsLeaves) {
  const recoil::FitSpec spec = exact_laws();
  const ExperimentPlan plan = plan_of_equal_spheres(spec);
  const PlannedCause* cause = cause_of(plan, "bulk_viscoelastic");
  ASSERT_NE(cause, nullptr);
  const recoil::PlanGround ground = recoil::ground_of(spec, plan);
  const auto possible =
      recoil::possible_cause(spec, plan, ground, *recoil::find_mechanism("bulk_viscoelastic"));
  ASSERT_TRUE(possible);
  int shown = 0;
  for (const recoil::TargetMaterial& material : recoil::other_targets(plan.datasets.front())) {
    const recoil::PlannedTarget target(spec, plan, {*possible}, material);
    const auto impacts = target.impacts_for(0, std::nullopt);
    if (!impacts) continue;
    ++shown;
    const recoil::PlanRemedy remedy = target.remedy(*impacts);
    EXPECT_EQ(remedy.kind, recoil::ExperimentKind::target);
    EXPECT_EQ(*impacts % (plan.options.events * static_cast<int>(remedy.places.size())), 0);
    const double free = log_odds_on_two_targets(spec, plan, *cause, remedy, true);
    const double known = log_odds_on_two_targets(spec, plan, *cause, remedy, false);
    EXPECT_LE(free, known * (1.0 + 1e-6)) << material.name;
    EXPECT_GT(free, 0.8 * recoil::wanted_log_odds) << material.name;
    EXPECT_LT(known, 2.0 * recoil::wanted_log_odds) << material.name;
  }
  EXPECT_GT(shown, 0);
}

}  // namespace
