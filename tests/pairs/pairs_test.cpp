// Every pair of features of a fit, in fits that have one form of each: what must always hold.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <set>

#include "analysis/analysis.hpp"
#include "core/error.hpp"
#include "coverage/coverage_truth.hpp"
#include "covering_array.hpp"
#include "diagnosis/diagnose.hpp"
#include "document/html.hpp"
#include "estimate/law_average.hpp"
#include "estimate/model_verdict.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "estimate/shared_errors.hpp"
#include "estimate/two_point.hpp"
#include "made_points.hpp"
#include "report/diagnosis_report.hpp"
#include "report/fit_report.hpp"
#include "report/index_page.hpp"
#include "report/result_json.hpp"
#include "report/words_verdict.hpp"
#include "support/command.hpp"
#include "support/temporary_folder.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {
namespace {

using pairs::Choice;
using pairs::Pair;
using support::TemporaryFolder;

// Of sixty, the one whose table has least often several slow features in one fit.
constexpr unsigned seed_of_the_table = 34;

/// The pairs that no fit of the table has.
std::vector<Pair> missing_pairs() {
  std::vector<Pair> missing = pairs::refused_pairs();
  const std::vector<Pair>& left_out = pairs::pairs_left_out();
  missing.insert(missing.end(), left_out.begin(), left_out.end());
  return missing;
}

const std::vector<Choice>& table() {
  static const std::vector<Choice> choices =
      pairs::covering_array(pairs::features(), missing_pairs(), seed_of_the_table);
  return choices;
}

Analysis analysed(const std::filesystem::path& folder, int threads) {
  AnalysisOptions options;
  options.threads = threads;
  return analyse(load_inputs(folder / "fit.toml"), options);
}

TEST(TableOfPairs, HoldsEveryPairButThoseThatAreNamed) {
  const std::vector<Pair> missing = missing_pairs();
  for (const Pair& pair : pairs::all_pairs(pairs::features())) {
    const bool is_missing = std::find(missing.begin(), missing.end(), pair) != missing.end();
    const bool occurs = std::any_of(table().begin(), table().end(),
                                    [&](const Choice& choice) { return pairs::has(choice, pair); });
    EXPECT_NE(occurs, is_missing) << pair.first.feature << " " << pair.first.form << ", "
                                  << pair.second.feature << " " << pair.second.form;
  }
  EXPECT_GE(table().size(), 40U);
}

TEST(TableOfPairs, RefusedPairsAreRefusedInOneLine) {
  for (const Pair& pair : pairs::refused_pairs()) {
    Choice choice = pairs::plain_choice();
    choice[pair.first.feature] = pair.first.form;
    choice[pair.second.feature] = pair.second.form;
    SCOPED_TRACE(pairs::words_of(choice));
    const TemporaryFolder folder;
    pairs::write_fit(choice, folder.path());
    try {
      analysed(folder.path(), 1);
      ADD_FAILURE() << "not refused";
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
}

/// One fit of the table.
struct Made {
  Choice choice;
  std::filesystem::path folder;
  std::optional<Analysis> analysis;
  std::string failure;  ///< without an answer
};

class Pairs : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new TemporaryFolder;
    made_ = new std::vector<Made>;
    for (const Choice& choice : table()) {
      Made made{choice, place_->path() / std::to_string(made_->size()), {}, {}};
      pairs::write_fit(choice, made.folder);
      try {
        made.analysis = analysed(made.folder, 1);
        support::write_text(made.folder / "fit.json", fit_json(*made.analysis));
      } catch (const ComputationError& error) {
        made.failure = error.what();
      }
      made_->push_back(std::move(made));
    }
  }
  static void TearDownTestSuite() {
    delete made_;
    delete place_;
  }

  static const std::vector<Made>& all() { return *made_; }
  static std::vector<const Made*> answered() {
    std::vector<const Made*> usable;
    for (const Made& made : all()) {
      if (made.analysis) usable.push_back(&made);
    }
    return usable;
  }
  static const TemporaryFolder& place() { return *place_; }

 private:
  inline static TemporaryFolder* place_ = nullptr;
  inline static std::vector<Made>* made_ = nullptr;
};

TEST_F(Pairs, EndWithAnAnswerOrAReason) {
  for (const Made& made : all()) {
    SCOPED_TRACE(pairs::words_of(made.choice));
    EXPECT_TRUE(made.analysis || made.failure.find("no usable answer: ") != std::string::npos)
        << made.failure;
  }
  EXPECT_GE(answered().size(), table().size() * 9 / 10);
}

/// The curve of a two-point calibration goes through its two points; through the slow one alone if
/// adhesion loses more energy at the fast one than was measured.
/// @return false if the calibration has no curve
bool lies_on_curve(const ImpactModel& model, const Observations& data, const TwoPointResult& two) {
  std::vector<std::size_t> met = {two.low_point};
  if (two.status == TwoPointStatus::converged) met.push_back(two.high_point);
  if (met.size() == 1 && two.status != TwoPointStatus::no_hertz_damping) return false;
  for (const std::size_t i : met) {
    const Observation& point = data.points[i];
    const Prediction at = predict(model, two.theta, {point.conditions()}, false).front();
    EXPECT_TRUE(at.usable());
    EXPECT_NEAR(at.restitution(), point.restitution, 1e-5) << "at " << point.velocity << " m/s";
  }
  return true;
}

TEST_F(Pairs, TwoPointsLieOnTheirCurve) {
  int compared = 0;
  for (const Made* made : answered()) {
    SCOPED_TRACE(pairs::words_of(made->choice));
    for (const TwoPointComparison& comparison : made->analysis->uncertainty.two_point) {
      const FitResult& fitted = made->analysis->fitted;
      if (lies_on_curve(fitted.model, fitted.data, comparison.result)) ++compared;
    }
  }
  EXPECT_GE(compared, 15);
}

// A whole fit with these laws takes minutes.
TEST(TwoPoints, LieOnTheirCurveUnderTheSlowLaws) {
  int compared = 0;
  for (const char* law : {"dmt", "maugis"}) {
    for (const char* mechanism : {"none", "gas_film", "plastic_yield", "velocity_offset"}) {
      for (const char* sizes : {"one", "several", "mixed", "two spheres"}) {
        Choice choice = pairs::plain_choice();
        choice["law"] = law;
        choice["mechanism"] = mechanism;
        choice["sizes"] = sizes;
        const Pair flat = pairs::pair_of({"mechanism", "gas_film"}, {"sizes", "two spheres"});
        if (pairs::has(choice, flat)) continue;
        SCOPED_TRACE(pairs::words_of(choice));
        const TemporaryFolder folder;
        pairs::write_fit(choice, folder.path());
        const FitInputs inputs = load_inputs(folder / "fit.toml");
        const ImpactModel model = make_model(inputs.spec, inputs.datasets);
        const Observations data = gather(inputs.datasets, inputs.spec);
        const TwoPointResult two = two_point(model, data, 0, model.contacts[0].reference_diameter);
        // The calibration is of the model without mechanisms, which may not reach the points.
        const bool met = lies_on_curve(model, data, two);
        EXPECT_TRUE(met || choice["mechanism"] != "none");
        if (met) ++compared;
      }
    }
  }
  EXPECT_GE(compared, 15);
}

/// Does an interval end within the bounds of its parameter, and about as far above the estimate as
/// below? Halves of 1 to 2.4 make it 1.7 times as wide as a symmetric one.
bool is_comparable(const Interval& interval, double estimate, const ParameterSlot& slot) {
  const double margin = 1e-6 * (slot.upper - slot.lower);
  if (*interval.lower <= slot.lower + margin || *interval.upper >= slot.upper - margin)
    return false;
  const double above = *interval.upper - estimate;
  const double below = estimate - *interval.lower;
  return above < 2.4 * below && below < 2.4 * above;
}

/// The largest ratio of two widths of one parameter. Percentiles of 19 replicates are their
/// extremes, whose distance is 3.7 +- 0.7 standard deviations (1.5 times too short or long);
/// Student's t with five degrees of freedom widens Wald and profile 1.3 times; residuals of ten
/// points and three parameters are 1.2 times too small; and skewness makes a factor of 1.7. Whole
/// series or points are five to twelve units, whose spread is known to a further factor of two.
double largest_ratio(const std::string& scheme) {
  return scheme == "case" || scheme == "cluster" ? 8.0 : 4.0;
}

// Of parameters that are known to better than a quarter, beside none that rests on a bound: other
// intervals end at bounds or are skewed.
TEST_F(Pairs, IntervalsOfAllKindsHaveSimilarWidths) {
  int compared = 0;
  for (const Made* made : answered()) {
    const FitResult& fitted = made->analysis->fitted;
    if (std::ranges::find(fitted.at_bound, true) != fitted.at_bound.end()) continue;
    for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
      const ParameterSlot& slot = fitted.model.slots[j];
      const IntervalSet& intervals = made->analysis->uncertainty.intervals[j];
      if (!slot.free) continue;
      // Whole series are drawn: a replicate may lack the one that has this parameter.
      if (slot.parameter->per_series && made->choice.at("scheme") == "cluster") continue;
      if (!(fitted.std_error[j] < 0.25 * std::abs(fitted.theta[j]))) continue;
      std::vector<double> widths;
      for (const IntervalKind kind :
           {IntervalKind::wald, IntervalKind::profile, IntervalKind::percentile}) {
        const Interval& interval = intervals[kind];
        if (!interval.available() || !is_comparable(interval, fitted.theta[j], slot)) {
          continue;
        }
        widths.push_back(*interval.upper - *interval.lower);
      }
      if (widths.size() < 2) continue;
      const auto [least, most] = std::minmax_element(widths.begin(), widths.end());
      EXPECT_LT(*most, *least * largest_ratio(made->choice.at("scheme")))
          << slot.label() << " of " << made->folder << ": " << pairs::words_of(made->choice) << ": "
          << testing::PrintToString(widths);
      ++compared;
    }
  }
  EXPECT_GE(compared, 15);
}

/// The scatter of simulated residuals that the weights of a fit whiten.
class WhiteScatter {
 public:
  explicit WhiteScatter(const FitResult& fitted) : fitted_(fitted) {
    const auto& points = fitted.data.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      // Near capture the residual of a simulated point is not normal.
      const bool plain = !points[i].censored && !(fitted.weights.points[i].scatter > 0.0) &&
                         fitted.prediction[i] > 0.5;
      if (plain) used_.push_back(i);
    }
    sources_.emplace(fitted.data.subset(used_), fitted.weights.subset(used_));
    sums_.assign(used_.size(), 0.0);
    squares_.assign(used_.size(), 0.0);
  }

  std::size_t points() const { return used_.size(); }

  /// Adds the simulated e of every point about these e^2.
  template <class Restitution>
  void add(const Restitution& restitution, std::span<const double> squares) {
    std::vector<double> residuals;
    for (const std::size_t i : used_) {
      Observation point = fitted_.data.points[i];
      point.restitution = restitution(i);
      residuals.push_back(weighted_residual(point, fitted_.weights.points[i], squares[i]).value);
    }
    sources_->whiten(residuals);
    for (std::size_t k = 0; k < residuals.size(); ++k) {
      sums_[k] += residuals[k];
      squares_[k] += residuals[k] * residuals[k];
    }
    ++count_;
  }

  /// Mean variance of the whitened residuals [1].
  double mean_variance() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < used_.size(); ++k) {
      sum += (squares_[k] - sums_[k] * sums_[k] / count_) / (count_ - 1.0);
    }
    return sum / static_cast<double>(used_.size());
  }

  /// Five standard deviations of the mean of so many squares of unit normals, and 2 % for what the
  /// weights neglect to second order.
  double tolerance() const {
    return 5.0 * std::sqrt(2.0 / (count_ * static_cast<double>(used_.size()))) + 0.02;
  }

 private:
  const FitResult& fitted_;
  std::vector<std::size_t> used_;
  std::optional<SharedErrors> sources_;
  std::vector<double> sums_, squares_;
  double count_ = 0.0;
};

constexpr std::uint64_t simulated_sets = 200;

/// Fits whose standard deviations hold as stated or estimated, for normal errors.
bool states_its_scatter(const Made& made) {
  return made.analysis->fitted.noise_scale == 1.0 && made.choice.at("residuals") == "normal";
}

TEST_F(Pairs, TheBootstrapDrawsTheScatterThatTheFitStates) {
  int compared = 0;
  for (const Made* made : answered()) {
    if (!states_its_scatter(*made)) continue;
    const FitResult& fitted = made->analysis->fitted;
    const ResamplingPlan plan = plan_resampling(fitted, Scheme::parametric);
    WhiteScatter scatter(fitted);
    if (scatter.points() < 4) continue;
    Observations sample = fitted.data;
    for (std::uint64_t index = 0; index < simulated_sets; ++index) {
      resample(plan, 5, index, sample);
      scatter.add([&](std::size_t i) { return sample.points[i].restitution; },
                  fitted.prediction_squared);
    }
    EXPECT_NEAR(scatter.mean_variance(), 1.0, scatter.tolerance())
        << made->folder << ": " << pairs::words_of(made->choice);
    ++compared;
  }
  EXPECT_GE(compared, 8);
}

TEST_F(Pairs, CoverageSimulatesTheScatterThatTheFitStates) {
  int compared = 0;
  for (const Made* made : answered()) {
    if (!states_its_scatter(*made)) continue;
    // Other constants move points to where the weights of the fit do not hold.
    const FitResult& with_constants = made->analysis->fitted;
    const FitResult fitted = fit(with_exact_materials(with_constants.model), with_constants.data);
    if (!fitted.usable || fitted.noise_scale != 1.0) continue;
    WhiteScatter scatter(fitted);
    if (scatter.points() < 4) continue;
    const CoverageTruth truth = coverage_truth(fitted, made->analysis->datasets, 5);
    for (std::uint64_t index = 0; index < simulated_sets / 4; ++index) {
      const std::vector<double> theta = truth.at ? truth.at(index).theta : truth.theta;
      const std::vector<ImpactPoint> points = truth.simulate(index).front().points;
      std::vector<double> squares;
      for (const Prediction& at : predict(fitted.model, theta, fitted.data.conditions(), false)) {
        squares.push_back(at.restitution_squared);
      }
      scatter.add([&](std::size_t i) { return points[i].restitution; }, squares);
    }
    EXPECT_NEAR(scatter.mean_variance(), 1.0, scatter.tolerance())
        << made->folder << ": " << pairs::words_of(made->choice);
    ++compared;
  }
  EXPECT_GE(compared, 6);
}

TEST_F(Pairs, JsonFitsItsSchema) {
  const std::string script =
      "import json, jsonschema, sys\n"
      "check = jsonschema.Draft202012Validator(json.load(open(sys.argv[1])))\n"
      "for file in sys.argv[2:]:\n"
      "    for error in check.iter_errors(json.load(open(file))):\n"
      "        print(file, list(error.absolute_path), error.message[:200])\n";
  std::vector<std::string> words = {"python3", "-c", script,
                                    RECOIL_SOURCE_DIR "/schemas/fit.schema.json"};
  for (const Made* made : answered()) words.push_back((made->folder / "fit.json").string());
  const support::Outcome run = support::run_command(words, place().path());
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "");
}

TEST_F(Pairs, PagesHaveNoMissingNumber) {
  const std::regex missing("\\b(nan|inf)\\b", std::regex::icase);
  for (const Made* made : answered()) {
    SCOPED_TRACE(pairs::words_of(made->choice));
    std::smatch found;
    for (const std::string& page :
         {fit_html(*made->analysis), fit_text(*made->analysis, Importance::detail)}) {
      const std::string words =
          std::regex_replace(page, std::regex("<script[^>]*javascript[^]*?</script>"), "");
      EXPECT_FALSE(std::regex_search(words, found, missing))
          << std::string(found.prefix()).substr(std::max<std::ptrdiff_t>(0, found.position() - 80));
    }
  }
}

/// Powers of ten as a page shows them.
std::string with_powers(const std::string& words) {
  const std::string power = std::regex_replace(words, std::regex("e-0?([0-9])"), " × 10−$1");
  return std::regex_replace(power, std::regex("([^0-9.])1 × 10"),
                            "$01"
                            "10");
}

/// The words of a page, without markup, with single spaces.
std::string words_of_page(const std::string& html) {
  std::string words =
      std::regex_replace(html, std::regex("<(script|style)[^>]*>[^]*?</(script|style)>"), "");
  words = std::regex_replace(words, std::regex("<[^>]*>"), "");
  for (const auto& [entity, letter] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}}) {
    words = std::regex_replace(words, std::regex(entity), letter);
  }
  return std::regex_replace(words, std::regex("\\s+"), " ");
}

/// Choices for fits without slow laws: of every form of data, some with mechanisms that the fit
/// does not know, some with a point that is far off.
struct Question {
  Choice choice;
  bool wrong_law = false, outlier = false;
};
std::vector<Question> questions(int count) {
  std::mt19937 random(51);
  std::vector<Question> all;
  while (static_cast<int>(all.size()) < count) {
    Question question;
    for (const pairs::Feature& feature : pairs::features()) {
      question.choice[feature.name] = feature.forms[random() % feature.forms.size()];
    }
    question.choice["scheme"] = "parametric";
    const bool slow = random() % 8 == 0;
    if (question.choice["law"] == "jkr" && !slow) question.choice["law"] = "ring";
    const std::set<std::string> slow_mechanisms = {"survivor_bias", "adhesion_hysteresis"};
    if (slow_mechanisms.contains(question.choice["mechanism"]) && !slow) {
      question.choice["mechanism"] = "none";
    }
    if (question.choice["sizes"] == "mixed") question.choice["sizes"] = "several";
    question.wrong_law = random() % 3 == 0;
    question.outlier = random() % 4 == 0;
    const std::vector<Pair> missing = missing_pairs();
    if (std::ranges::any_of(missing,
                            [&](const Pair& pair) { return pairs::has(question.choice, pair); })) {
      continue;
    }
    all.push_back(std::move(question));
  }
  return all;
}

/// The text of a fit file without its mechanisms.
std::string without_mechanisms(const std::string& fit) {
  return std::regex_replace(fit, std::regex("mechanisms = [^\n]*\n"), "");
}

/// A table of points whose first e is off by 0.15.
std::string with_outlier(const std::string& table) {
  const std::size_t row = table.find('\n') + 1;
  std::size_t cell = row;
  for (int k = 0; k < 3; ++k) cell = table.find(',', cell) + 1;
  const std::size_t end = table.find(',', cell);
  if (cell == end) return table;
  const double e = std::stod(table.substr(cell, end - cell));
  return table.substr(0, cell) + fmt::format("{:.6f}", e > 0.5 ? e - 0.15 : e + 0.15) +
         table.substr(end);
}

// Whether the model fits is said once, in the same words, wherever a user looks.
TEST(OneVerdict, StandsInEveryPlace) {
  const std::regex another(
      "model (barely )?(fits|does not fit|describes)|points (contradict|reject)|"
      "explains? the scatter|data reject");
  std::set<ModelVerdict> met;
  int compared = 0, diagnosed = 0;
  for (const Question& question : questions(110)) {
    SCOPED_TRACE(pairs::words_of(question.choice));
    const TemporaryFolder folder;
    pairs::write_fit(question.choice, folder.path());
    std::string fit = folder.read("fit.toml");
    if (question.wrong_law) fit = without_mechanisms(fit);
    fit = std::regex_replace(fit, std::regex("replicates = 19"), "replicates = 0");
    folder.write("fit.toml", fit);
    if (question.outlier) {
      folder.write("data/points.csv", with_outlier(folder.read("data/points.csv")));
    }
    std::optional<Analysis> analysis;
    try {
      analysis = analysed(folder.path(), 1);
    } catch (const ComputationError&) {
      continue;
    }
    const std::string verdict = plain_text(verdict_sentence(analysis->fitted));
    const auto says_it_once = [&](const std::string& place, std::string text) {
      text = with_powers(text);
      const std::size_t at = text.find(with_powers(verdict));
      ASSERT_NE(at, std::string::npos) << place << ": " << verdict << "\n" << text.substr(0, 900);
      text.erase(at, with_powers(verdict).size());
      // Of other data: a point that lies far off is left out.
      text = std::regex_replace(text, std::regex("Without it the model fits"), "");
      std::smatch found;
      EXPECT_FALSE(std::regex_search(text, found, another))
          << place << ": " << found.str() << " beside " << verdict;
    };
    const std::string json = fit_json(*analysis);
    EXPECT_EQ(nlohmann::json::parse(json)["model_verdict"]["text"], verdict);
    says_it_once("terminal", words_of_page(fit_text(*analysis, Importance::answer)));
    says_it_once("page", words_of_page(fit_html(*analysis)));
    says_it_once("card", words_of_page(html_page(index_document({{"fit.html", json}}))));
    met.insert(judge_model(analysis->fitted).verdict);
    ++compared;
    const bool few = question.choice.at("law") == "none" && diagnosed < 20;
    if (!few) continue;
    DiagnosisOptions options;
    options.simulated = 19;
    options.answer_alone = true;
    options.threads = 1;
    const Diagnosis d = diagnose(analysis->spec, analysis->datasets, analysis->fitted, options);
    EXPECT_EQ(nlohmann::json::parse(diagnosis_json(d))["model_verdict"]["text"], verdict);
    says_it_once("diagnosis", words_of_page(diagnosis_text(d, Importance::answer)));
    ++diagnosed;
  }
  EXPECT_GE(compared, 100);
  EXPECT_GE(diagnosed, 10);
  EXPECT_EQ(met.size(), 5U) << "verdicts that occur";
}

/// A point of the fitted curve, as fit.json has it; with exact laws if the fit is averaged.
struct CurvePoint {
  double diameter_um, velocity, restitution;
};

CurvePoint point_of_curve(const Made& made) {
  const auto fit = nlohmann::json::parse(support::text_of(made.folder / "fit.json"));
  std::vector<CurvePoint> points;
  for (const auto& at : fit["curve"]) {
    if (at["diameter_um"] != fit["curve"][0]["diameter_um"]) continue;
    points.push_back({at["diameter_um"], at["incident_velocity"], at["restitution"]});
  }
  CurvePoint point = points.at(points.size() * 2 / 3);
  const FitResult& averaged = made.analysis->fitted;
  const FitResult& exact = with_laws_exact(averaged);
  if (&exact != &averaged) {
    point.restitution = std::sqrt(
        predict(exact.model, exact.theta, {{0, point.diameter_um * 1e-6, point.velocity}}, false)
            .front()
            .restitution_squared);
  }
  return point;
}

support::Outcome ask(const Made& made, const std::vector<std::string>& words,
                     const std::vector<std::string>& more) {
  std::vector<std::string> all = words;
  all.insert(all.end(), {"fit.toml", "--parameters", "fit.json"});
  all.insert(all.end(), more.begin(), more.end());
  return support::run_recoil(all, made.folder);
}

/// Is a parameter without an effect on any point refused, since the fit has no value of it?
bool is_undetermined(const Made& made, const support::Outcome& run) {
  if (made.analysis->fitted.flat.empty()) return false;
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("has no value: no point depends on it"), std::string::npos) << run.err;
  return true;
}

// A sphere that `simulate` is asked for belongs to no series.
TEST_F(Pairs, SimulateAnswersAsTheCurve) {
  for (const Made* made : answered()) {
    if (made->choice.at("mechanism") == "series_offset") continue;
    SCOPED_TRACE(made->folder.string() + ": " + pairs::words_of(made->choice));
    const CurvePoint at = point_of_curve(*made);
    const support::Outcome run = ask(*made, {"simulate"},
                                     {"--velocity", fmt::format("{}", at.velocity), "--diameter",
                                      fmt::format("{}", at.diameter_um), "--json"});
    if (is_undetermined(*made, run)) continue;
    ASSERT_EQ(run.status, 0) << run.err;
    const double e = nlohmann::json::parse(run.out)["restitution"];
    EXPECT_NEAR(e, at.restitution, 1e-6);
  }
}

// A table has single spheres without errors of the measurement.
TEST_F(Pairs, AnExportedTableAnswersAsTheCurve) {
  const std::set<std::string> of_measurement = {"velocity_offset", "survivor_bias",
                                                "series_offset"};
  for (const Made* made : answered()) {
    if (of_measurement.contains(made->choice.at("mechanism"))) continue;
    if (made->choice.at("sizes") == "mixed") continue;
    SCOPED_TRACE(made->folder.string() + ": " + pairs::words_of(made->choice));
    const CurvePoint at = point_of_curve(*made);
    const support::Outcome run =
        ask(*made, {"export"},
            {"--velocity", fmt::format("{},{}", at.velocity, 2.0 * at.velocity), "--diameter",
             fmt::format("{}", at.diameter_um), "--to", "table", "--out", "table"});
    if (is_undetermined(*made, run)) continue;
    ASSERT_EQ(run.status, 0) << run.err;
    const std::string csv = support::text_of(made->folder / "table/restitution.csv");
    double diameter_um = 0.0, velocity = 0.0, e = 0.0;
    ASSERT_EQ(std::sscanf(csv.c_str() + csv.find('\n'), "%lf,%lf,%lf", &diameter_um, &velocity, &e),
              3);
    EXPECT_NEAR(velocity, at.velocity, 1e-7 * velocity);
    EXPECT_NEAR(e, at.restitution, 1e-6);
  }
}

TEST_F(Pairs, DigitsDoNotDependOnTheThreads) {
  const std::vector<const Made*> fits = answered();
  for (std::size_t k = 0; k < fits.size(); k += 8) {
    EXPECT_EQ(fit_json(analysed(fits[k]->folder, 3)),
              support::text_of(fits[k]->folder / "fit.json"))
        << pairs::words_of(fits[k]->choice);
  }
}

}  // namespace
}  // namespace recoil
