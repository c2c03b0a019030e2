// The script that explores e(V) in a page, in headless Chromium, against the program run as a
// command and against its residuals.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "example_analysis.hpp"
#include "mechanism/mechanism.hpp"
#include "report/fit_report.hpp"
#include "support/command.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

using Json = nlohmann::json;

class Explorer : public testing::Test {
 protected:
  static void SetUpTestSuite() { page_ = fit_html(sample::four_diameters()); }

  /// The values of JavaScript expressions in `page`, one after the other; the test fails where the
  /// browser does.
  std::vector<Json> evaluate(const std::string& page, const std::vector<std::string>& expressions) {
    folder_.write("page.html", page);
    folder_.write("expressions.json", Json(expressions).dump());
    const support::Outcome outcome =
        support::run_command({"python3", RECOIL_SOURCE_DIR "/tests/report/evaluate_in_chromium.py",
                              "page.html", "expressions.json"},
                             folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    if (outcome.status != 0) return std::vector<Json>(expressions.size());
    return Json::parse(outcome.out).get<std::vector<Json>>();
  }

  static inline std::string page_;
  support::TemporaryFolder folder_;
};

/// A law with values under which it is tried, and a velocity [m/s] around its capture velocity.
struct Tried {
  const char* law;
  const char* phase;
  double C_H, C_A;
};

/// Chosen so that the four laws capture at velocities of the same order at 4.9 um.
const std::array<Tried, 5> tried = {{{"ring", "rebound", 3e-3, 5e-2},
                                     {"ring", "both", 1e-2, 3e-2},
                                     {"jkr", "rebound", 5e-3, 8e-2},
                                     {"dmt", "rebound", 8e-3, 2e-1},
                                     {"maugis", "rebound", 5e-3, 8e-2}}};

class ExploredLaws : public Explorer {
 protected:
  Json simulated(const Tried& one, double velocity, double diameter_um) {
    folder_.write("fit.toml",
                  fmt::format("dataset = \"{}/datasets/wall1990-molybdenum\"\n[model]\nadhesion = "
                              "\"{}\"\nadhesion_damping_phase = \"{}\"\n[parameters]\nC_H = {{ "
                              "initial = {} }}\nC_A = {{ initial = {} }}\n",
                              RECOIL_SOURCE_DIR, one.law, one.phase, one.C_H, one.C_A));
    const support::Outcome outcome =
        support::run_recoil({"simulate", "fit.toml", "--velocity", fmt::format("{}", velocity),
                             "--diameter", fmt::format("{}", diameter_um), "--json"},
                            folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.status == 0 ? Json::parse(outcome.out) : Json();
  }

  /// The values that the page gets, from the JSON of the program.
  static Json values_of(const Tried& settings, const Json& one) {
    const bool ring = std::string(settings.law) == "ring";
    const double diameter = one["diameter_um"].get<double>() * 1e-6;
    return {{"law", settings.law},
            {"phase", settings.phase},
            {"C_H", settings.C_H},
            {"C_A", settings.C_A},
            {"adhesion", ring ? one["contact"]["f0_N_per_m"] : one["parameters"]["W"]["value"]},
            {"stiffness", one["contact"]["stiffness_K_Pa"]},
            {"density", one["contact"]["density_kg_per_m3"]},
            {"reference_diameter", diameter},
            {"separation", 4e-10}};
  }
};

TEST_F(ExploredLaws, GiveWhatTheProgramSimulates) {
  constexpr double diameter = 4.9;
  std::vector<std::string> captures;
  for (const Tried& one : tried) {
    captures.push_back(fmt::format("recoil.captureVelocity({}e-6, {})", diameter,
                                   values_of(one, simulated(one, 1.0, diameter)).dump()));
  }
  const std::vector<Json> edges = evaluate(page_, captures);
  std::vector<std::vector<double>> expected;
  std::vector<std::string> questions;
  for (std::size_t law = 0; law < tried.size(); ++law) {
    ASSERT_TRUE(edges[law].is_number()) << tried[law].law;
    const double edge = edges[law].get<double>();
    std::vector<std::pair<double, double>> asked;  // (V [m/s], d [um])
    for (const double of_edge :
         {0.1, 0.5, 0.9, 0.999, 0.99999, 1.00001, 1.0001, 1.001, 1.01, 1.1, 1.5, 3.0, 10.0, 60.0}) {
      asked.emplace_back(edge * of_edge, diameter);
    }
    for (const double velocity : {0.3, 1.0, 2.5, 4.0, 20.0}) asked.emplace_back(velocity, 2.58);
    asked.emplace_back(0.2, 20.0);
    ASSERT_EQ(asked.size(), 20U);
    Json impacts = Json::array();
    expected.emplace_back();
    for (const auto& [velocity, size] : asked) {
      const Json answer = simulated(tried[law], velocity, size);
      expected.back().push_back(answer["restitution"].get<double>());
      impacts.push_back({velocity, size * 1e-6, values_of(tried[law], answer)});
    }
    questions.push_back(impacts.dump() + ".map(q => recoil.restitution(q[0], q[1], q[2]))");
  }
  const std::vector<Json> found = evaluate(page_, questions);
  for (std::size_t law = 0; law < tried.size(); ++law) {
    ASSERT_EQ(found[law].size(), expected[law].size());
    int captured = 0;
    int slow = 0;
    for (std::size_t i = 0; i < expected[law].size(); ++i) {
      const double e = expected[law][i];
      EXPECT_NEAR(found[law][i].get<double>(), e, 1e-6)
          << tried[law].law << " " << tried[law].phase << ": impact " << i;
      captured += e == 0.0 ? 1 : 0;
      slow += e > 0.0 && e < 0.1 ? 1 : 0;
    }
    EXPECT_GE(captured, 5) << "captured ones are among them: " << tried[law].law;
    EXPECT_GE(slow, 2) << "and slow ones near capture: " << tried[law].law;
  }
}

constexpr const char* panels =
    "[...document.querySelectorAll('script.explore')].map(s => JSON.parse(s.textContent))";

/// Points of every kind that the fit weighs, under weights of a plausible size.
Analysis with_every_kind_of_point(bool student) {
  Analysis a = sample::four_diameters();
  if (student) a.fitted.data.noise.student = student_noise(4.0);
  std::vector<Observation>& points = a.fitted.data.points;
  std::vector<PointConditions> conditions;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Observation& p = points[i];
    PointWeights& w = a.fitted.weights.points[i];
    p.events = 12;
    if (i % 3 == 1) w.input_sd = 0.02;
    if (i % 8 < 2) {  // the slow ones
      w.scatter = 0.15;
      w.shift = 0.01;
      w.mean_sd = 0.04;
      p.captured = 3;
      p.counted = i % 3 != 0;
      if (i % 16 == 0) {
        p.censored = true;
        p.captured = p.events;
        p.restitution = 0.0;
      } else {
        locate_peak(p, w);
      }
    } else if (i % 16 == 10) {
      p.censored = true;
      p.captured = p.events;
      p.restitution = 0.0;
      w.sd = 0.6;
    }
    conditions.push_back(p.conditions());
  }
  const std::vector<Prediction> predicted =
      predict(a.fitted.model, a.fitted.theta, conditions, false);
  for (std::size_t i = 0; i < points.size(); ++i) {
    a.fitted.residuals[i] =
        weighted_residual(points[i], a.fitted.weights.points[i], predicted[i].restitution_squared,
                          a.fitted.data.noise.student)
            .value;
  }
  return a;
}

TEST_F(Explorer, WeighsEveryKindOfPointAsTheFit) {
  for (const bool student : {false, true}) {
    const Analysis analysis = with_every_kind_of_point(student);
    const std::vector<Json> found =
        evaluate(fit_html(analysis),
                 {std::string(panels) + ".map(p => [p.chi2, recoil.misfit(p, p.diameter, p)])"});
    ASSERT_EQ(found.front().size(), 4U);
    double all = 0.0;
    for (const Json& panel : found.front()) {
      EXPECT_NEAR(panel[1].get<double>() / panel[0].get<double>(), 1.0, 1e-6);
      all += panel[1].get<double>();
    }
    double expected = 0.0;
    for (const double r : analysis.fitted.residuals) expected += r * r;
    EXPECT_NEAR(all / expected, 1.0, 1e-6);
    EXPECT_GT(expected, 1.0);
  }
}

TEST_F(Explorer, MisfitFollowsTheValuesAndTheDiameter) {
  const Analysis analysis = with_every_kind_of_point(false);
  std::vector<double> theta = analysis.fitted.theta;
  theta[0] = 0.01;
  theta[1] = 0.1;
  theta[2] *= 1.5;
  double expected = 0.0;
  for (std::size_t i = 0; i < 8; ++i) {  // those of the first panel, in spheres twice as large
    const Observation& p = analysis.fitted.data.points[i];
    const Prediction m =
        predict(analysis.fitted.model, theta, 0, 2.0 * p.diameter, p.velocity, false);
    expected += std::pow(
        weighted_residual(p, analysis.fitted.weights.points[i], m.restitution_squared).value, 2);
  }
  const Json found = evaluate(fit_html(analysis),
                              {fmt::format("(p => recoil.misfit(p, 2 * p.diameter, {{...p, C_H: "
                                           "0.01, C_A: 0.1, adhesion: {}}}))({}[0])",
                                           theta[2], panels)})
                         .front();
  ASSERT_TRUE(found.is_number());
  EXPECT_NEAR(found.get<double>() / expected, 1.0, 1e-6);
}

// Opens the first controls, sets number `k` of them (-1: none) and returns the visible result.
std::string seen_after(int k, const std::string& value, const std::string& more = "") {
  return fmt::format(
      "new Promise(resolve => {{ const box = document.querySelector('details.explore'); box.open = "
      "true; const input = box.querySelectorAll('input[type=number]')[{}]; if (input) {{ "
      "input.value = '{}'; input.dispatchEvent(new Event('input')); }} {} setTimeout(() => "
      "resolve([box.querySelector('.explored-result').textContent, "
      "box.closest('figure').querySelector('path.explored').getAttribute('d'), "
      "[...box.querySelectorAll('input[type=number]')].map(i => Number(i.value))]), 300); }})",
      k, value, more);
}

double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  EXPECT_NE(at, std::string::npos) << words << " is not in: " << text;
  return at == std::string::npos ? NAN : std::stod(text.substr(at + words.size()));
}

TEST_F(Explorer, ControlsDrawTheCurveOfTheirValues) {
  const Analysis analysis = with_every_kind_of_point(false);
  // Where the picture has the fitted curve: its blue line.
  const std::string drawn_by_the_program =
      "document.querySelector('#restitution-1 path[stroke=\"#0072B2\"]').getAttribute('d')";
  const std::vector<Json> seen =
      evaluate(fit_html(analysis),
               {"document.querySelectorAll('path.explored').length", seen_after(-1, ""),
                drawn_by_the_program, seen_after(1, "0.2"),
                seen_after(-1, "", "box.querySelector('button').click();"), seen_after(3, "-1"),
                "new Promise(r => { document.querySelector('details.explore').open = false; "
                "setTimeout(() => r(document.querySelectorAll('path.explored').length), "
                "300); })"});
  EXPECT_EQ(seen[0], 0) << "no curve is drawn before the controls are opened";
  EXPECT_EQ(seen[6], 0) << "nor after";

  // The same theta, so the same curve, in the same place.
  const auto coordinates = [](std::string path) {
    for (char& c : path) {
      if (c == 'M' || c == 'L') c = ' ';
    }
    std::istringstream numbers(path);
    std::vector<std::pair<double, double>> all;
    for (double x = 0.0, y = 0.0; numbers >> x;) {
      char comma = ' ';
      if (numbers.peek() == ',') numbers >> comma;
      numbers >> y;
      all.emplace_back(x, y);
    }
    return all;
  };
  const auto explored = coordinates(seen[1][1].get<std::string>());
  const auto fitted = coordinates(seen[2].get<std::string>());
  ASSERT_GT(explored.size(), 80U);
  ASSERT_GT(fitted.size(), 30U);
  int compared = 0;
  for (const auto& [x, y] : fitted) {
    for (std::size_t i = 1; i < explored.size(); ++i) {
      const auto& [x0, y0] = explored[i - 1];
      const auto& [x1, y1] = explored[i];
      if (!(x0 <= x && x < x1) || std::abs(y1 - y0) > 3.0) continue;
      EXPECT_NEAR(y, y0 + (y1 - y0) * (x - x0) / (x1 - x0), 0.5) << "at x = " << x << " px";
      ++compared;
    }
  }
  EXPECT_GT(compared, 25);

  // Words: of the fit, of other values, of the fit again; a value that cannot be is not taken.
  const std::string of_fit = seen[1][0].get<std::string>();
  EXPECT_NEAR(number_after(of_fit, "points shown is ") / number_after(of_fit, "under the fit "),
              1.0, 2e-3);
  const double V = number_after(of_fit, "V* = ");
  const auto e2 = [&](double velocity) {
    return predict(analysis.fitted.model, analysis.fitted.theta, 0, 2.58e-6, velocity, false)
        .restitution_squared;
  };
  EXPECT_LT(e2(V * 0.999), 0.0);
  EXPECT_GT(e2(V * 1.001), 0.0);
  EXPECT_GT(number_after(seen[3][0].get<std::string>(), "V* = "), 1.5 * V);
  EXPECT_NE(seen[3][1], seen[1][1]);
  EXPECT_EQ(seen[4], seen[1]);
  EXPECT_EQ(seen[5][1], seen[1][1]);
}

TEST_F(Explorer, IsNotOfferedWhereItCannotComputeTheModel) {
  const auto offered = [](const auto& change) {
    Analysis analysis = sample::four_diameters();
    change(analysis);
    return !restitution_figures(analysis).front().explored.empty();
  };
  EXPECT_TRUE(offered([](Analysis&) {}));
  EXPECT_FALSE(offered([](Analysis& a) { a.fitted.model.chain = chain_of({"plastic_yield"}); }));
  EXPECT_FALSE(offered([](Analysis& a) { a.fitted.model.contacts[0].surface_diameter = 1e-3; }));
  EXPECT_FALSE(offered([](Analysis& a) {  // counts alone
    Observation& point = a.fitted.data.points[0];
    point.censored = true;
    point.events = 2;
    point.captured = 1;
  }));
}

}  // namespace
}  // namespace recoil
