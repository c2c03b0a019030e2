// The data sets for other methods, and the script that scores answers to them.
#include "validation/studies/hidden_effects_benchmark.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/files.hpp"
#include "core/json.hpp"
#include "validation/studies/child.hpp"
#include "validation/synthetic/case.hpp"

namespace {

namespace fs = std::filesystem;
using namespace recoil::hidden;

Answered answer(const std::vector<std::string>& effects, std::uint64_t index,
                const std::vector<std::string>& named, const std::vector<std::string>& rivals) {
  Answered made;
  made.order = {"wall", effects, effects.empty() ? 0.0 : 20.0, index, 1};
  made.reached = true;
  made.verdict = !named.empty() ? "cause_named" : rivals.empty() ? "adequate" : "not_separable";
  made.named = named;
  made.rivals = rivals;
  if (!effects.empty()) made.ideal.emplace(IdealJudge{{"elastic_waves", 8.0, 0}, {}, 1.0});
  return made;
}

class Benchmark : public testing::Test {
 protected:
  void SetUp() override {
    std::vector<Answered> answers = {
        answer({"plastic_yield"}, 0, {"plastic_yield"}, {}),
        answer({"plastic_yield"}, 1, {}, {"plastic_yield", "elastic_waves"}),
        answer({"plastic_yield"}, 2, {"elastic_waves"}, {}), answer({}, 0, {}, {}),
        answer({}, 1, {}, {"gas_film", "plate_flexure"})};
    answers.push_back(answers.front());  // of which nature has not enough
    answers.back().order.index = 9;
    answers.back().reached = false;
    write_benchmark(answers, folder_.path(), 0);
  }
  fs::path truth() const { return folder_.path() / "truth" / "truth.csv"; }
  std::string scores(const fs::path& answers) const {
    const recoil::ChildOutcome run = recoil::run_child(
        {"/usr/bin/python3", RECOIL_SOURCE_DIR "/tests/validation/score_answers.py",
         truth().string(), answers.string()},
        "", std::chrono::minutes(1));
    return run.out + run.err;
  }
  ScratchFolder folder_;
};

TEST_F(Benchmark, ScoresWhatTheMethodAnswered) {
  const std::string text = scores(folder_.path() / "answers" / "recoil.csv");
  const auto says = [&](const std::string& what, const std::string& share) {
    const std::size_t at = text.find("  " + what + " ");
    ASSERT_NE(at, std::string::npos) << what << "\n" << text;
    EXPECT_NE(text.substr(at, text.find('\n', at) - at).find(" " + share + " "), std::string::npos)
        << text;
  };
  says("visible effect named", "1 of 3");
  says("an ideal judge", "3 of 3");
  says("named or listed", "2 of 3");
  says("something else named", "1 of 3");
  says("nothing hidden: something named or listed", "1 of 2");
}

TEST_F(Benchmark, SaysNothingOfTheTruthBesideTheData) {
  int fits = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path() / "cases")) {
    if (!entry.is_regular_file()) continue;
    fits += entry.path().extension() == ".toml" ? 1 : 0;
    const std::string text = recoil::read_text_file(entry.path());
    EXPECT_EQ(text.find("plastic_yield"), std::string::npos) << entry.path();
  }
  EXPECT_EQ(fits, 5);
}

TEST_F(Benchmark, RefusesACaseThatIsNotThere) {
  const fs::path file = folder_.path() / "mine.csv";
  std::ofstream(file) << "case,named,listed\nnone-such,plastic_yield,\n";
  EXPECT_NE(scores(file).find("none-such"), std::string::npos);
}

}  // namespace
