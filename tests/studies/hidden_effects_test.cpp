// The bars of the study in small: fixed data sets with a known truth, diagnosed by the built
// command. A wrong answer fails. `./run study hidden-effects` counts over many.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "analysis/analysis.hpp"
#include "core/files.hpp"
#include "diagnosis/diagnose.hpp"
#include "validation/studies/diagnosis_answer.hpp"
#include "validation/synthetic/case.hpp"

namespace {

using namespace recoil;
using namespace recoil::hidden;

struct Question {
  CaseOrder order;
  std::vector<Mark> right;  ///< answers that are true
  std::string cause = {};   ///< of which all rivals are laws when it is listed among them
};

void PrintTo(const Question& question, std::ostream* out) { *out << question.order.key(); }

std::string test_name(const testing::TestParamInfo<Question>& info) {
  std::string name;
  for (const char c : info.param.order.key()) {
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  }
  return name;
}

class Bar : public testing::TestWithParam<Question> {};

/// Is the effect among the causes that are listed beside an error of the laws?
bool is_hinted(const Answered& answer) {
  const std::string& effect = answer.order.effects.front();
  return std::find(answer.hinted.begin(), answer.hinted.end(), effect) != answer.hinted.end();
}

TEST_P(Bar, TheAnswerIsTrue) {
  const Question& question = GetParam();
  const Answered answer = ask(question.order, RECOIL_BINARY, {});
  ASSERT_TRUE(answer.reached) << "largest misfit " << answer.signal_to_noise;
  ASSERT_EQ(answer.status, 0) << answer.complaint;
  std::string listed;
  for (const std::string& id : answer.named) listed += " " + id;
  for (const std::string& id : answer.rivals) listed += " (" + id + ")";
  const Mark mark = mark_of(answer);
  if (question.order.other_law && mark == Mark::nothing) {
    // An error of the laws competes with a law that the catalogue does not have.
    EXPECT_TRUE(is_hinted(answer)) << answer.verdict << listed;
    return;
  }
  EXPECT_NE(std::find(question.right.begin(), question.right.end(), mark), question.right.end())
      << answer.verdict << listed << ", p = " << answer.p_value;
  if (!has_several_diameters(question.order.design)) {
    EXPECT_TRUE(answer.certain.empty()) << "no cause is certain: " << answer.certain.front();
  }
  if (mark == Mark::inside) {
    EXPECT_EQ(answer.shared_cause, question.cause) << listed;
  }
}

std::vector<Question> clear_causes() {
  std::vector<Question> all;
  // One for each place where causes act: in the contact, on the way, in what is seen, in a batch.
  for (const char* effect : {"plastic_yield", "gas_film", "rebound_truncation", "series_offset"}) {
    all.push_back({{"wall", {effect}, 20.0, 0}, {Mark::named}});
  }
  // Off with its sign: the incident velocity too high, that of the rebound too low.
  all.push_back({{"li", {"velocity_offset"}, 20.0, 0}, {Mark::named}});
  return all;
}

CaseOrder with_conditions(const char* effect, Circumstances circumstances) {
  CaseOrder order{"wall", {effect}, 20.0, 0};
  order.circumstances = circumstances;
  return order;
}

/// A condition that is known, or changed, tells what velocities and sizes alone may not.
std::vector<Question> known_conditions() {
  return {{with_conditions("gas_film", Circumstances::stated), {Mark::named}},
          {with_conditions("gas_film", Circumstances::varied), {Mark::named}},
          {with_conditions("capillary", Circumstances::varied), {Mark::named}}};
}

/// Nearly alike: naming the right one or listing it is true, anything else is not. (JKR's work and
/// hysteresis per area, deepened by adhesion, leave a misfit of 1.6 of one another where each alone
/// leaves 20. The charge that air can hold on such a sphere leaves the same, so that the two have
/// no cause in common.)
std::vector<Question> close_causes() {
  const std::vector<Mark> right = {Mark::named, Mark::inside};
  return {{{"wall", {"jkr_hysteresis"}, 40.0, 0}, right},
          {{"wall", {"survivor_bias"}, 10.0, 0}, right, "unequal impacts averaged in one point"},
          {{"li", {"plate_flexure"}, 20.0, 0}, right},
          {{"wall", {"plastic_yield", "jkr_hysteresis"}, 20.0, 0},
           {Mark::named, Mark::part, Mark::inside}}};
}

std::vector<Question> nothing_hidden() {
  std::vector<Question> all;
  for (std::uint64_t i = 0; i < 4; ++i) {
    for (const char* design : {"wall", "li"})
      all.push_back({{design, {}, 0.0, i}, {Mark::nothing}});
  }
  return all;
}

/// Laws that are wrong by a smooth factor of 10 %: right, or listed, or its shape recognised.
std::vector<Question> bent_laws() {
  std::vector<Question> all;
  for (const char* effect : {"gas_film", "asperity_loss"}) {
    all.push_back({{"wall", {effect}, 20.0, 0}, {Mark::named, Mark::inside, Mark::resembled}});
    all.back().order.law_bend = 0.1;
  }
  all.push_back(
      {{"wall", {"plastic_yield"}, 40.0, 0}, {Mark::named, Mark::inside, Mark::resembled}});
  all.back().order.law_bend = 0.1;
  return all;
}

/// Made by a published law that is not the catalogue's.
std::vector<Question> other_laws() {
  std::vector<Question> all;
  const std::pair<const char*, const char*> cases[] = {
      {"drops", "plate_flexure"}, {"li", "plastic_yield"}, {"wall", "gas_film"}};
  for (const auto& [design, effect] : cases) {
    all.push_back({{design, {effect}, 10.0, 0}, {Mark::named, Mark::inside, Mark::resembled}});
    all.back().order.other_law = true;
  }
  return all;
}

/// As strong as nature has it this is little more than losses that are good to 3 %: an error of the
/// laws explains as much.
std::vector<Question> within_law_errors() {
  return {{{"li", {"bulk_viscoelastic"}, 10.0, 0}, {Mark::inside}}};
}

/// The answer also says what exact laws would leave; where nothing is hidden it does so in one of
/// twenty.
TEST(IfExact, TellsWhatTheErrorsOfLawsHide) {
  const Answered hidden = ask(within_law_errors().front().order, RECOIL_BINARY, {});
  ASSERT_EQ(hidden.status, 0) << hidden.complaint;
  EXPECT_TRUE(hidden.hint);
  EXPECT_EQ(std::count(hidden.hinted.begin(), hidden.hinted.end(), "bulk_viscoelastic"), 1);
  int hints = 0;
  for (const Question& question : nothing_hidden()) {
    hints += ask(question.order, RECOIL_BINARY, {}).hint ? 1 : 0;
  }
  EXPECT_LE(hints, 2) << "of 8: more has a probability of 0.6 % at one of twenty";
}

/// How well points tell a cause from its nearest rival, against fits of that rival to points
/// without noise. The diagnosis sees noisy points, whose fit has a strength that is off by its
/// error: here at most a fifth, so that lambda may be off by two fifths and by its own
/// linearisation.
TEST(Separation, AgreesWithFitsToPointsWithoutNoise) {
  for (const char* effect : {"plastic_yield", "gas_film", "velocity_offset"}) {
    const Case made = make_case({"wall", {effect}, 20.0, 0});
    ASSERT_TRUE(made.reached);
    const ScratchFolder noisy, clean;
    const FitSpec spec = load_fit(write_case(made, noisy.path()));
    const Diagnosis found = diagnose(spec, load_datasets(spec), DiagnosisOptions());
    const auto cause = std::ranges::find(found.candidates, std::string(effect),
                                         [](const auto& c) { return c.candidate.name(); });
    ASSERT_NE(cause, found.candidates.end()) << effect;
    ASSERT_TRUE(cause->separation) << effect;
    const double left =
        misfit_left(write_case(without_noise(made), clean.path()), cause->separation->rival);
    const auto rival = std::ranges::find(found.candidates, cause->separation->rival,
                                         [](const auto& c) { return c.candidate.name(); });
    ASSERT_NE(rival, found.candidates.end());
    // A rival with free exponents, which the diagnosis may prefer, fits better.
    if (!rival->candidate.released) {
      EXPECT_GT(cause->separation->lambda, 0.5 * left * left) << effect;
    }
    EXPECT_LT(cause->separation->lambda, 2.0 * left * left) << effect;
    EXPECT_LE(cause->separation_allowed->probability, cause->separation->probability) << effect;
  }
}

/// Losses of the base model that are wrong by 3 % are no alarm.
std::vector<Question> bent_base() {
  std::vector<Question> all;
  for (const char* design : {"wall", "li"}) {
    for (std::uint64_t i = 0; i < 2; ++i) {
      all.push_back({{design, {}, 0.0, i}, {Mark::nothing}});
      all.back().order.base_bend = 0.03;
    }
  }
  return all;
}

/// Nothing is named in the place of what cannot be.
std::vector<Question> impossible_sizes() {
  std::vector<Question> all;
  all.push_back({{"wall", {"velocity_offset"}, 0.0, 0}, {Mark::resembled, Mark::unexplained}});
  all.back().order.beyond = 10.0;
  // 0.40(16) m/s, the error being that of a trade with its second parameter: below 0.1 m/s, which a
  // velocimeter has, it does not fit.
  all.push_back({{"wall", {"velocity_offset"}, 0.0, 0}, {Mark::resembled, Mark::unexplained}});
  all.back().order.beyond = 3.0;
  // A charge of 8.8(8)e6 V/m and a plane at 6.5(1.1) mm, where planes lie within 5 mm, take the
  // same: neither is to be named.
  all.push_back({{"li", {"electrostatic_image"}, 0.0, 0},
                 {Mark::inside, Mark::resembled, Mark::unexplained}});
  all.back().order.beyond = 3.0;
  return all;
}

/// A plane ten times as far as planes lie takes what a charge takes that air can hold: neither may
/// be named, and both are listed.
TEST(ImpossiblePlane, KeepsAChargeFromBeingNamed) {
  CaseOrder order{"wall", {"probe_plane"}, 0.0, 0};
  order.beyond = 10.0;
  const Answered answer = ask(order, RECOIL_BINARY, {});
  ASSERT_EQ(answer.status, 0) << answer.complaint;
  EXPECT_TRUE(answer.named.empty()) << answer.named.front();
  for (const char* cause : {"probe_plane", "electrostatic_image"}) {
    EXPECT_EQ(std::count(answer.rivals.begin(), answer.rivals.end(), cause), 1) << cause;
  }
}

std::vector<Question> outside_the_catalogue() {
  return {{{"wall", {"dip"}, 20.0, 0}, {Mark::unexplained}},
          {{"wall", {"wave"}, 20.0, 0}, {Mark::unexplained}}};
}

/// One size tells no cause: whatever is seen, no name may be given.
std::vector<Question> one_diameter() {
  return {{{"wall-one", {"jkr_hysteresis"}, 10.0, 0}, {Mark::inside, Mark::outside}}};
}

/// A larger error of the laws than 3 % is as likely there as a cause, and the answer lists both.
TEST(OneDiameter, ListsTheCauseBesideAnErrorOfTheLaws) {
  const std::vector<CaseOrder> orders = {{"wall-one", {"hysteretic_loss"}, 10.0, 0},
                                         {"dahneke", {"hysteretic_loss"}, 20.0, 0},
                                         {"dahneke", {"crack_rate"}, 20.0, 0}};
  for (const CaseOrder& order : orders) {
    const Answered answer = ask(order, RECOIL_BINARY, {});
    ASSERT_TRUE(answer.reached) << order.key();
    ASSERT_EQ(answer.status, 0) << answer.complaint;
    EXPECT_EQ(answer.verdict, "not_separable") << order.key();
    const auto lists = [&](const std::string& id) {
      return std::count(answer.rivals.begin(), answer.rivals.end(), id);
    };
    EXPECT_EQ(lists(order.effects.front()), 1) << order.key();
    EXPECT_EQ(lists("law_error"), 1) << order.key();
    EXPECT_TRUE(answer.certain.empty());
    EXPECT_EQ(answer.shared_cause, "");
  }
}

/// Balls of millimetres that are dropped by hand: a cause that such drops have, and heights that
/// were set wrong, which are no cause; where a column names the heights, the fit knows.
std::vector<Question> drops_by_hand() {
  return {{{"drops", {"height_origin"}, 20.0, 0}, {Mark::named, Mark::inside}},
          {{"drops", {"settings"}, 0.0, 0}, {Mark::nothing, Mark::unexplained}},
          {{"drops", {"settings"}, 0.0, 1}, {Mark::nothing}}};
}

/// The same, read to a step of a ruler or to frames of a video: no cause is named for the steps,
/// nor a wrong one beside them.
std::vector<Question> drops_read_to_a_step() {
  std::vector<Question> all;
  for (const Readout readout : {Readout::five_millimetres, Readout::frame}) {
    for (const char* design : {"drops", "balls"}) {
      all.push_back({{design, {}, 0.0, 2}, {Mark::nothing, Mark::unexplained, Mark::outside}});
      all.back().order.readout = readout;
    }
  }
  // With a column that names the heights, whose drops share what rounding makes.
  all.push_back({{"drops", {"flight_drag"}, 20.0, 3}, {Mark::named, Mark::inside}});
  all.back().order.readout = Readout::millimetre;
  return all;
}

/// A dry law beside adhesion is near none of the catalogue: it may go unexplained, but two errors
/// of the instrument are not named for it.
TEST(OtherLawBesideAdhesion, HasNoOtherCauseNamed) {
  CaseOrder order{"li", {"plastic_yield"}, 20.0, 0};
  order.other_law = true;
  const Answered answer = ask(order, RECOIL_BINARY, {});
  ASSERT_EQ(answer.status, 0) << answer.complaint;
  EXPECT_NE(mark_of(answer), Mark::wrong);
}

/// A few points are misread: they are set aside, the others are not, and no cause is named.
TEST(OddPoints, AreFoundAndNoOthers) {
  for (const char* design : {"wall", "drops"}) {
    const Answered answer = ask({design, {"odd_points"}, 0.0, 0}, RECOIL_BINARY, {});
    ASSERT_EQ(answer.status, 0) << answer.complaint;
    EXPECT_TRUE(answer.named.empty()) << design;
    EXPECT_GT(answer.odd, 0) << design;
    EXPECT_EQ(answer.odd_found, answer.odd) << design;
    EXPECT_LE(answer.accused, 1) << design;
    EXPECT_EQ(answer.odd + answer.right, 60) << design;
  }
}

/// Two causes that the first answer cannot tell apart are told apart by what it advises.
TEST(Loop, WhatIsAdvisedTellsCausesApart) {
  CaseOrder order{"wall", {"hysteretic_loss"}, 20.0, 0};
  order.rounds = 3;
  const Answered answer = ask(order, RECOIL_BINARY, {});
  ASSERT_EQ(answer.status, 0) << answer.complaint;
  EXPECT_EQ(mark_of(answer), Mark::named) << answer.rounds;
  EXPECT_GT(answer.rounds, 0);
}

/// Errors that the table does not state are no cause.
TEST(CarelessBar, ErrorsThatNobodyStatedAreToldAndNoCauseIs) {
  // Drawn so that structure is seen at all: velocities off by 3 % are, near capture, hardly more
  // than losses that are good to 3 %.
  for (const auto& [kind, index] : {std::pair("velocities", 2), std::pair("deviations", 0)}) {
    const auto draw = static_cast<std::uint64_t>(index);
    const Answered answer = ask({"wall", {kind}, 0.0, draw}, RECOIL_BINARY, {});
    ASSERT_EQ(answer.status, 0) << answer.complaint;
    EXPECT_EQ(answer.verdict, "unexplained") << kind;
    EXPECT_TRUE(answer.errors_told) << kind;
  }
}

INSTANTIATE_TEST_SUITE_P(ClearCause, Bar, testing::ValuesIn(clear_causes()), test_name);
INSTANTIATE_TEST_SUITE_P(KnownConditions, Bar, testing::ValuesIn(known_conditions()), test_name);
INSTANTIATE_TEST_SUITE_P(CloseCause, Bar, testing::ValuesIn(close_causes()), test_name);
INSTANTIATE_TEST_SUITE_P(NothingHidden, Bar, testing::ValuesIn(nothing_hidden()), test_name);
INSTANTIATE_TEST_SUITE_P(BentLaw, Bar, testing::ValuesIn(bent_laws()), test_name);
INSTANTIATE_TEST_SUITE_P(OtherLaw, Bar, testing::ValuesIn(other_laws()), test_name);
INSTANTIATE_TEST_SUITE_P(WithinLawErrors, Bar, testing::ValuesIn(within_law_errors()), test_name);
INSTANTIATE_TEST_SUITE_P(BentBase, Bar, testing::ValuesIn(bent_base()), test_name);
INSTANTIATE_TEST_SUITE_P(Impossible, Bar, testing::ValuesIn(impossible_sizes()), test_name);
INSTANTIATE_TEST_SUITE_P(Outside, Bar, testing::ValuesIn(outside_the_catalogue()), test_name);
INSTANTIATE_TEST_SUITE_P(DropsByHand, Bar, testing::ValuesIn(drops_by_hand()), test_name);
INSTANTIATE_TEST_SUITE_P(ReadToAStep, Bar, testing::ValuesIn(drops_read_to_a_step()), test_name);
INSTANTIATE_TEST_SUITE_P(OneDiameter, Bar, testing::ValuesIn(one_diameter()), test_name);

}  // namespace
