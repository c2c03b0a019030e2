// Every fact has words, and no two facts of a kind have the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "example_analysis.hpp"
#include "report/words_candidate.hpp"
#include "report/words_diagnosis.hpp"
#include "report/words_fit.hpp"

namespace recoil {
namespace {

/// Expects a different, non-empty text for every value of an enum.
template <class Enum, class Words>
void expect_words_for_all(const Words& words) {
  std::set<std::string> all;
  for (const Enum value : values_of<Enum>()) {
    const std::string text = words(value);
    EXPECT_FALSE(text.empty()) << name_of(value);
    EXPECT_TRUE(all.insert(text).second) << name_of(value) << ": " << text;
  }
}

TEST(Words, EveryFactHasItsOwn) {
  expect_words_for_all<IntervalKind>([](IntervalKind kind) { return words_of(kind); });
  expect_words_for_all<NoInterval>([](NoInterval why) { return missing_words(no_interval(why)); });
  expect_words_for_all<Caution>([](Caution caution) {
    Interval interval;
    interval.note = IntervalNote{caution, 1.0};
    return plain_text(note_words(interval, "C_A"));
  });
  expect_words_for_all<CaptureBecause>([](CaptureBecause because) {
    CaptureEstimate capture;
    capture.because = because;
    return recommended_words(capture);
  });
  expect_words_for_all<SchemeBecause>([](SchemeBecause because) {
    BootstrapResult bootstrap;
    bootstrap.because = because;
    return scheme_words(bootstrap);
  });
  expect_words_for_all<StructureQuestion>(
      [](StructureQuestion question) { return words_of(question); });
  expect_words_for_all<SetAside>([](SetAside why) {
    CandidateResult candidate;
    candidate.set_aside = why;
    return set_aside_words(candidate);
  });
}

TEST(Words, OfTheRecommendedInterval) {
  IntervalSet set;
  set.recommended = IntervalKind::profile;
  EXPECT_EQ(recommended_words(set), "profile likelihood");
  set.student = true;
  EXPECT_THAT(recommended_words(set), testing::HasSubstr("Student"));
  set.recommended = IntervalKind::wald;
  set[IntervalKind::profile] = no_interval(NoInterval::no_lower_end);
  EXPECT_EQ(recommended_words(set),
            "there is no profile: " + missing_words(no_interval(NoInterval::no_lower_end)));
}

TEST(Words, WarnOfAProfileWithoutAnEnd) {
  Analysis analysis = sample::four_diameters();
  IntervalSet& set = analysis.uncertainty.intervals.front();
  const std::size_t before = all_warnings(analysis).size();
  for (const NoInterval why : {NoInterval::no_ends, NoInterval::no_lower_end,
                               NoInterval::no_upper_end, NoInterval::noise_unknown}) {
    set[IntervalKind::profile] = no_interval(why);
    set.recommended = IntervalKind::wald;
    EXPECT_EQ(all_warnings(analysis).size(), before + (why != NoInterval::noise_unknown ? 1 : 0));
  }
}

TEST(Words, WhyNoDiameterIsHeldOut) {
  TwoPointComparison comparison;
  EXPECT_EQ(held_out_words(comparison), "");
  comparison.nothing_held_out = true;
  EXPECT_THAT(held_out_words(comparison), testing::HasSubstr("single diameter"));
  comparison.refit_failure = "too few points";
  EXPECT_THAT(held_out_words(comparison), testing::HasSubstr("failed: too few points"));
}

TEST(Words, OfAnImpossibleParameter) {
  static const PlausibleLimit limit{
      .quantity = "field over that of breakdown", .upper = 1.0, .why = "air sparks"};
  FoundParameter parameter;
  parameter.label = "surface_field";
  parameter.unit = "V/m";
  parameter.value = 2e8;
  parameter.upper = 1e8;
  parameter.range_why = "no charge is larger";
  EXPECT_EQ(implausible_words(parameter), "");
  parameter.implausible = true;
  EXPECT_EQ(implausible_words(parameter),
            "surface_field = 2e+08 V/m lies outside 0 to 1e+08: no charge is larger");
  parameter.limit = &limit;
  parameter.quantity = 2.071;
  EXPECT_EQ(implausible_words(parameter),
            "surface_field = 2e+08 V/m: the field over that of breakdown would be 2.1, but is at "
            "most 1: air sparks");
}

TEST(Words, EveryHindranceIsTold) {
  Analysis analysis = sample::four_diameters();
  expect_words_for_all<Hindrance>([&](Hindrance hindrance) {
    analysis.uncertainty.identifiability.parameter[0] = {false, hindrance, 0.4, 2.0};
    return plain_text(identifiability_words(analysis.fitted, analysis.uncertainty));
  });
  Identifiability& found = analysis.uncertainty.identifiability;
  found.parameter[0] = {false, Hindrance::large_error, 0.284, 0.3};
  const auto text = [&] {
    return plain_text(identifiability_words(analysis.fitted, analysis.uncertainty));
  };
  EXPECT_THAT(text(), testing::HasSubstr("C_H is known to 28 %"));
  EXPECT_THAT(text(), testing::Not(testing::HasSubstr("well determined")));
  found.rejected = true;
  EXPECT_THAT(text(),
              testing::StartsWith("the errors hold only if the model does, and it does not fit; "));
  found.parameter.clear();
  EXPECT_TRUE(identifiability_words(analysis.fitted, analysis.uncertainty).empty());
}

TEST(Words, WarnWhereRefitsFailed) {
  Analysis analysis = sample::four_diameters();
  UncertaintyResult& uncertainty = analysis.uncertainty;
  const auto warnings = [&] {
    return uncertainty_warnings(uncertainty, analysis.fitted.data).size();
  };
  const std::size_t before = warnings();
  uncertainty.bootstrap.failures.index = {3, 5};
  uncertainty.bootstrap.failed = 2;
  EXPECT_EQ(warnings(), before) << "two of 1999";
  uncertainty.bootstrap.failed = 21;
  EXPECT_TRUE(uncertainty.bootstrap.failed_often());
  EXPECT_FALSE(uncertainty.bootstrap.withheld());
  EXPECT_EQ(warnings(), before + 1);
}

TEST(Words, SayWhoseBoundTheReplicatesRestOn) {
  const Analysis analysis = sample::four_diameters();
  const std::string other = analysis.fitted.model.slots[1].label();
  IntervalSet set;
  set.disagreement = Disagreement{};
  set.disagreement->on_bound = Disagreement::OnBound{0, 0.3, 0.0};
  const std::string own = plain_text(disagreement_words(analysis.fitted, 0, set));
  EXPECT_NE(own.find("30 % of the replicates are at a bound"), std::string::npos) << own;
  set.disagreement->on_bound = Disagreement::OnBound{1, 0.3, -0.8};
  const std::string others = plain_text(disagreement_words(analysis.fitted, 0, set));
  EXPECT_NE(others.find("30 % of the replicates have " + other + " at its bound"),
            std::string::npos)
      << others;
}

}  // namespace
}  // namespace recoil
