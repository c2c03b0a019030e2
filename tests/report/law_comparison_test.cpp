// One fit under every law of adhesion: the fits, the section of the page, and the file for scripts.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "report/comparison_report.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

struct Fitted {
  std::vector<Dataset> datasets = {synthetic::dataset({})};
  FitSpec spec = synthetic::spec();
  std::vector<LawFit> laws;

  Fitted() { laws = under_every_law(); }
  std::vector<LawFit> under_every_law() const {
    return fit_under_every_law(spec, datasets,
                               fit(make_model(spec, datasets), gather(datasets, spec)));
  }
};

const Fitted& fitted() {
  static const Fitted made;
  return made;
}

TEST(LawChoice, FitsEveryLawAndTheTrueOneIsBest) {
  const std::vector<LawFit>& laws = fitted().laws;
  ASSERT_EQ(laws.size(), 3U);                      // maugis only where it is asked for
  EXPECT_EQ(laws.front().law, AdhesionLaw::ring);  // the truth, without noise
  for (const LawFit& law : laws) {
    ASSERT_TRUE(law.fitted && law.fitted->usable) << to_string(law.law);
    EXPECT_EQ(law.fitted->model.adhesion, law.law);
    EXPECT_GE(law.fitted->chi2, laws.front().fitted->chi2);
    EXPECT_TRUE(law.held_out_rmse.has_value());
    EXPECT_EQ(law.captures.size(), 2U);
  }
  EXPECT_LT(laws.front().fitted->chi2, 1e-3);
}

TEST(LawChoice, ALawThatAMechanismRefusesHasNoFit) {
  Fitted with = fitted();
  with.spec.mechanisms = {"jkr_hysteresis"};
  const FitSpec jkr = under_law(with.spec, AdhesionLaw::jkr, with.datasets);
  EXPECT_EQ(jkr.parameters.size(), 4U);
  for (const LawFit& law : with.under_every_law()) {
    EXPECT_EQ(law.fitted.has_value(), law.law == AdhesionLaw::ring);
    EXPECT_EQ(law.refused.empty(), law.law == AdhesionLaw::ring);
  }
}

TEST(LawChoice, AStatedForceBecomesTheWorkThatGoesWithIt) {
  FitSpec spec = fitted().spec;
  for (ParameterSpec& parameter : spec.parameters) {
    if (!parameter.parameter->is_adhesion()) continue;
    parameter.initial = 8.9;
    parameter.initial_stated = true;
  }
  const FitSpec other = under_law(spec, AdhesionLaw::dmt, fitted().datasets);
  const ParameterSpec& W = other.parameters.back();
  EXPECT_EQ(W.parameter->name, "W");
  // W = (2 pi f0)^(3/2) / (6 pi (K r)^(1/2)), K 1.789 GPa, r 2.45 um: 0.33509 J/m2.
  EXPECT_NEAR(W.initial, 0.33509, 1e-3);
  const FitSpec back = under_law(other, AdhesionLaw::ring, fitted().datasets);
  EXPECT_NEAR(back.parameters.back().initial, 8.9, 1e-9);
}

TEST(LawComparison, ShowsTheQualityOfEveryLaw) {
  const std::vector<ComparedFit> laws = compared_laws(fitted().laws, fitted().datasets);
  EXPECT_EQ(Json::parse(laws_json(laws)).at("laws").size(), laws.size());
  const std::vector<Block> blocks = law_blocks(laws);
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(std::get<Table>(blocks[0].content()).rows.size(), laws.size());
  EXPECT_TRUE(law_blocks({laws.front()}).empty());
}

TEST(LawComparison, AnIntervalIsTwiceOnePointNineSixStandardErrors) {
  const LawFit& ring = fitted().laws.front();
  const std::vector<ComparedFit> laws = compared_laws(fitted().laws, fitted().datasets);
  const ComparedQuantity& C_A = laws.front().quantities.at(1);
  EXPECT_EQ(C_A.name, "C_A");
  ASSERT_TRUE(C_A.interval.has_value());
  EXPECT_NEAR((*C_A.interval)[1] - (*C_A.interval)[0], 2.0 * 1.96 * ring.fitted->std_error[1],
              1e-9);
}

}  // namespace
}  // namespace recoil
