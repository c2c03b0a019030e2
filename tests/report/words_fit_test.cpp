// Every fact that a reader of a fit should beware of becomes one warning.
#include "report/words_fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "estimate/fit.hpp"
#include "example_analysis.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// A usable fit without warnings.
FitResult sound() {
  FitResult fitted = sample::four_diameters().fitted;
  fitted.usable = true;
  fitted.noise_verdict = NoiseVerdict::explained;
  fitted.at_bound.assign(fitted.theta.size(), false);
  fitted.starts.clear();
  StartSummary best;
  best.end = fitted.theta;
  best.ending = DescentEnd::minimum;
  best.outcome = StartOutcome::best;
  fitted.starts.push_back(best);
  return fitted;
}

template <class Change>
std::size_t warnings_after(const Change& change) {
  FitResult fitted = sound();
  change(fitted);
  return fit_warnings(fitted).size();
}

TEST(FitWarnings, OneForEveryFact) {
  EXPECT_TRUE(fit_warnings(sound()).empty());
  EXPECT_EQ(warnings_after([](FitResult& f) { f.data.noise.sd_stated = false; }), 0U);
  EXPECT_EQ(warnings_after([](FitResult& f) {
              f.data.noise.sd_stated = false;
              f.data.noise.sd_set_aside = 5;
            }),
            1U);
  EXPECT_EQ(warnings_after([](FitResult& f) { f.data.noise.sd_of_few = 3; }), 1U)
      << "standard deviations of few impacts";
  EXPECT_EQ(warnings_after([](FitResult& f) {
              f.data.points.resize(4);
              f.data.points[3].setting = 1;
              f.data.noise.setting_sd_estimated = true;
            }),
            1U)
      << "two settings and as many parameters";
  EXPECT_EQ(warnings_after([](FitResult& f) { f.weights_at_rest = false; }), 1U);
  EXPECT_EQ(warnings_after([](FitResult& f) {
              f.noise_verdict = NoiseVerdict::exceeded;
              f.noise_scale = 1.3;
            }),
            1U);
  EXPECT_EQ(warnings_after([](FitResult& f) { f.noise_verdict = NoiseVerdict::doubtful; }), 0U);
  EXPECT_EQ(warnings_after([](FitResult& f) { f.strained_points = 3; }), 1U);
  EXPECT_EQ(warnings_after([](FitResult& f) { f.covariance.clear(); }), 1U);
  EXPECT_EQ(warnings_after([](FitResult& f) { f.at_bound[0] = true; }), 1U);
  EXPECT_EQ(warnings_after([](FitResult& f) {
              f.covariance.clear();
              f.ending = DescentEnd::flat;
              f.flat = {1};
            }),
            1U);
  EXPECT_EQ(warnings_after([](FitResult& f) {
              f.unused_counts = {&mechanism_catalogue().front(), 2};
            }),
            1U);
}

TEST(FitWarnings, TellOfLawsOfAdhesionWithoutAdhesion) {
  const auto with = [](double adhesion_energy) {
    return warnings_after([&](FitResult& f) {
      f.model.chain = chain_of({"jkr_hysteresis"});
      f.model.surroundings.assign(1, {});
      f.model.surroundings.front().adhesion_energy = adhesion_energy;
    });
  };
  EXPECT_EQ(with(0.2), 0U);
  EXPECT_EQ(with(0.0), 1U);
}

TEST(FitWarnings, NameTheParametersThatMeanNothing) {
  FitResult fitted = sound();
  fitted.covariance.clear();
  fitted.flat = {0, 1};
  const std::vector<std::string> warnings = plain_texts(fit_warnings(fitted));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("do not depend on C_H, C_A "), std::string::npos) << warnings[0];
  // Where the fit is on flat ground, it is no news that starts are.
  fitted.starts.push_back(fitted.starts.front());
  fitted.starts.back().outcome = StartOutcome::flat;
  EXPECT_EQ(fit_warnings(fitted).size(), 1U);
}

TEST(FitWarnings, SetParametersAsSymbolsAndUnitsAsUnits) {
  FitResult fitted = sound();
  fitted.at_bound[0] = true;
  const std::vector<Sentence> warnings = fit_warnings(fitted);
  ASSERT_EQ(warnings.size(), 1U);
  const std::vector<recoil::Run>& runs = warnings[0].runs();
  EXPECT_EQ(runs.front(), (recoil::Run{RunKind::symbol, "C_H"}));
  EXPECT_NE(std::find(runs.begin(), runs.end(), recoil::Run{RunKind::unit, "s/m"}), runs.end())
      << plain_text(warnings[0]);
}

TEST(FitWarnings, TellOfStartsWhoseIterationsRanOut) {
  FitResult fitted = sound();
  fitted.starts.push_back(fitted.starts.front());
  fitted.starts.back().outcome = StartOutcome::not_converged;
  fitted.starts.back().ending = DescentEnd::limit;
  const std::vector<std::string> warnings = plain_texts(fit_warnings(fitted));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("iteration limit"), std::string::npos) << warnings[0];
}

TEST(FitWarnings, TellHowStartsEnded) {
  const auto with = [](StartOutcome outcome, std::vector<std::size_t> differing) {
    return warnings_after([&](FitResult& f) {
      StartSummary start = f.starts.front();
      start.outcome = outcome;
      start.differing = differing;
      f.starts.push_back(start);
    });
  };
  EXPECT_EQ(with(StartOutcome::same, {}), 0U);
  EXPECT_EQ(with(StartOutcome::worse, {}), 1U);
  EXPECT_EQ(with(StartOutcome::flat, {}), 1U);
  EXPECT_EQ(with(StartOutcome::not_converged, {}), 1U);
  EXPECT_EQ(with(StartOutcome::tie, {0, 1}), 2U);  // one for each parameter that differs
}

TEST(NoiseWords, ThereIsSomethingToSayOfEveryVerdict) {
  FitResult fitted = sound();
  for (const NoiseVerdict verdict :
       {NoiseVerdict::unchecked, NoiseVerdict::estimated, NoiseVerdict::explained,
        NoiseVerdict::doubtful, NoiseVerdict::exceeded}) {
    fitted.noise_verdict = verdict;
    EXPECT_FALSE(noise_words(fitted).empty());
  }
  fitted.usable = false;
  EXPECT_TRUE(noise_words(fitted).empty());
}

TEST(TwoPointWords, EveryEndHasItsOwn) {
  const Analysis analysis = sample::four_diameters();
  TwoPointResult result = analysis.uncertainty.two_point.front().result;
  std::set<std::string> words;
  for (const TwoPointStatus status : values_of<TwoPointStatus>()) {
    result.status = status;
    words.insert(plain_text(two_point_words(analysis.fitted, 0, result)));
  }
  EXPECT_EQ(words.size(), count_of<TwoPointStatus>);
}

}  // namespace
}  // namespace recoil
