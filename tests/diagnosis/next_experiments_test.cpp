#include "diagnosis/next_experiments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "estimate/predictor.hpp"
#include "search_with_exact_laws.hpp"
#include "support/noisy_case.hpp"

namespace recoil {
namespace {

/// Rivals that differ, as a search would have left them, beside a fit with errors of 0.01 in e.
class NextExperiments : public SearchWithExactLaws {
 protected:
  NextExperiments() {
    for (const auto& [id, value] :
         std::vector<std::pair<std::string, double>>{{"plastic_yield", 2e8},
                                                     {"electrostatic_image", 2e6},
                                                     {"jkr_hysteresis", 0.5},
                                                     {"gas_film", 1.0},
                                                     {"bulk_viscoelastic", 3e-9}}) {
      CandidateResult rival;
      rival.candidate = make_candidate(spec_, data_, {id});
      rival.refit.theta = rival.candidate.model.initial();
      rival.refit.theta.at(3) = value;
      rivals_.push_back(rival);
    }
  }

  std::vector<NextExperiment> of_first(std::size_t count) const {
    std::vector<const CandidateResult*> first;
    for (std::size_t k = 0; k < count; ++k) first.push_back(&rivals_[k]);
    return next_experiments(*base_, first).list;
  }

  double restitution(const std::string& name, const NextExperiment& at) const {
    for (const CandidateResult& rival : rivals_) {
      if (rival.candidate.name() != name) continue;
      const auto impact = predict(rival.candidate.model, rival.refit.theta, at.dataset, at.diameter,
                                  at.velocity, false);
      return std::sqrt(std::max(0.0, impact.restitution_squared));
    }
    ADD_FAILURE() << name;
    return NAN;
  }

  std::vector<CandidateResult> rivals_;
};

std::set<std::string> names_in(const std::vector<NextExperiment>& all) {
  std::set<std::string> names;
  for (const NextExperiment& experiment : all) names.insert({experiment.one, experiment.other});
  return names;
}

TEST_F(NextExperiments, AreForTheBestFourAndForFewerToo) {
  EXPECT_TRUE(of_first(0).empty());
  EXPECT_TRUE(of_first(1).empty());
  EXPECT_EQ(names_in(of_first(2)), (std::set<std::string>{"plastic_yield", "electrostatic_image"}));
  EXPECT_EQ(names_in(of_first(5)), names_in(of_first(4)));
  EXPECT_EQ(names_in(of_first(5)).size(), 4U);
}

TEST_F(NextExperiments, TakeAsManyImpactsAsOddsOfNinetyNineToOneNeed) {
  const std::vector<NextExperiment> all = of_first(4);
  int points = 0;
  for (const NextExperiment& experiment : all) {
    EXPECT_GE(experiment.log_odds, std::log(99.0) * (1.0 - 1e-12));
    if (experiment.kind != ExperimentKind::points) continue;
    ++points;
    EXPECT_NEAR(experiment.difference,
                restitution(experiment.one, experiment) - restitution(experiment.other, experiment),
                1e-9);
    // Every point is one impact with an error of 0.01 in e. Nothing moves in these rivals and laws
    // are exact, so that n impacts tell n (difference / sd)^2 / 2.
    const double each = 0.5 * std::pow(experiment.difference / 0.01, 2);
    EXPECT_NEAR(experiment.log_odds / experiment.events, each, 1e-6 * each);
    EXPECT_TRUE(experiment.events == 1 || each * (experiment.events - 1) < std::log(99.0));
  }
  EXPECT_EQ(points, 6);
}

TEST_F(NextExperiments, WatchACauseWhileItIsTakenAway) {
  bool pumped = false;
  for (const NextExperiment& experiment : of_first(4)) {
    if (experiment.kind != ExperimentKind::condition || experiment.one != "gas_film") continue;
    pumped = pumped || experiment.condition == Condition::ambient_pressure;
  }
  EXPECT_TRUE(pumped);
}

// Possible impacts reach below the capture velocity. There no sphere rebounds, however wrong the
// laws may be.
TEST(NextExperiment, IsNoImpactInWhichAllSpheresStick) {
  synthetic::Design design;
  design.diameters = {2.58e-6, 4.9e-6, 9.8e-6};
  design.sd = 0.006;
  design.velocities.clear();
  const double capture = true_capture_velocity(synthetic::truth_of(design), design.diameters[0]);
  for (int k = 0; k < 12; ++k) design.velocities.push_back(0.85 * capture * std::pow(1.26, k));
  const FitSpec spec = synthetic::spec();
  std::vector<Dataset> data = {synthetic::dataset(design)};
  for (ImpactPoint& point : data[0].points) point.incident_velocity += 0.08;
  const FitResult fitted = fit(make_model(spec, data), gather(data, spec.noise));
  const SearchBase base = search_base(spec, data, fitted, {});
  std::vector<CandidateResult> rivals(2);
  rivals[0].candidate = make_candidate(spec, data, {"velocity_offset"});
  rivals[1].candidate = make_candidate(spec, data, {});
  for (CandidateResult& rival : rivals) {
    std::vector<double> start = rival.candidate.model.initial();
    if (start.size() > 3) start[3] = -0.08;
    rival.refit = refit_candidate(rival.candidate, base.fitted.data, base.fitted.weights, start, 1);
    ASSERT_TRUE(rival.refit.usable);
    rival.refit.law_error = rival.candidate.added.empty() ? 0.12 : 0.0;
  }
  const auto next = next_experiments(base, {&rivals[0], &rivals[1]});
  for (const NextExperiment& experiment : next.list) {
    double most = -INFINITY;
    for (const CandidateResult& rival : rivals) {
      most = std::max(most, predict(rival.candidate.model, rival.refit.theta, experiment.dataset,
                                    experiment.diameter, experiment.velocity, false)
                                .restitution_squared);
    }
    EXPECT_GT(most, 0.0) << experiment.velocity;
  }
}

TEST(ScatterOfOneEvent, IsThatOfTheNearestPointInLogVelocity) {
  synthetic::Case c = synthetic::noisy_case();
  for (std::size_t i = 0; i < c.fitted.data.points.size(); ++i) {
    Observation& point = c.fitted.data.points[i];
    c.fitted.weights.points[i].sd = point.velocity < 10.0 ? 0.02 : 0.005;
    point.events = 1;
  }
  EXPECT_DOUBLE_EQ(scatter_of_one_event(c.fitted, 0, 3.0), 0.02);
  EXPECT_DOUBLE_EQ(scatter_of_one_event(c.fitted, 0, 400.0), 0.005);
}

TEST(ScatterOfOneEvent, IsAThousandthWhereLessIsStated) {
  synthetic::Case c = synthetic::noisy_case();
  for (PointWeights& own : c.fitted.weights.points) own.sd = 1e-6;
  EXPECT_DOUBLE_EQ(scatter_of_one_event(c.fitted, 0, 3.0), 1e-3);
  EXPECT_DOUBLE_EQ(scatter_of_one_event(c.fitted, 5, 3.0), 1e-3);  // a dataset without points
}

}  // namespace
}  // namespace recoil
