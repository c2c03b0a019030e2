#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "core/error.hpp"
#include "example_analysis.hpp"
#include "report/corrections.hpp"
#include "report/html_page.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::size_t megabyte = 1000000;

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++count;
  return count;
}

/// Values of the attribute, in single or double quotes.
std::vector<std::string> attribute(const std::string& html, const std::string& name) {
  std::vector<std::string> values;
  const std::regex pattern("[\\s]" + name + "\\s*=\\s*(?:\"([^\"]*)\"|'([^']*)')");
  for (std::sregex_iterator it(html.begin(), html.end(), pattern), end; it != end; ++it) {
    values.push_back((*it)[1].matched ? (*it)[1].str() : (*it)[2].str());
  }
  return values;
}

void expect_self_contained(const std::string& html) {
  EXPECT_LT(html.size(), megabyte);
  std::set<std::string> ids;
  for (const std::string& id : attribute(html, "id")) {
    EXPECT_TRUE(ids.insert(id).second) << "id " << id << " twice";
  }
  EXPECT_TRUE(attribute(html, "src").empty());
  for (const char* name : {"href", "xlink:href"}) {
    for (const std::string& target : attribute(html, name)) {
      EXPECT_THAT(target, testing::AnyOf(testing::StartsWith("#"), testing::StartsWith("data:"),
                                         testing::MatchesRegex("[a-z0-9-]+(/[a-z0-9-]+)?\\.html")));
      const bool anchor = target.starts_with("#");
      EXPECT_TRUE(!anchor || ids.contains(target.substr(1))) << target;
    }
  }
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  EXPECT_THAT(html, Not(HasSubstr("url(")));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_EQ(occurrences(html, "<div"), occurrences(html, "</div>"));
  EXPECT_EQ(occurrences(html, "<figure "), occurrences(html, "</figure>"));
  EXPECT_THAT(html, HasSubstr("name=\"viewport\""));
  EXPECT_THAT(html, HasSubstr("@media print"));
}

TEST(HtmlReport, HoldsEveryPlotOfOneDataset) {
  const std::string html = html_report(example::four_diameters());
  expect_self_contained(html);
  // 4 diameters, 2 residual plots, 2 x intervals, 2 distributions, corner, f0, force history, two
  // points, pairs of points.
  EXPECT_EQ(occurrences(html, "<svg "), 15U);
  for (const char* figure :
       {"restitution-1", "restitution-4", "residual-velocity-1", "residual-diameter-1",
        "intervals-1", "intervals-2", "bootstrap-1", "bootstrap-2", "corner-1", "two-point-1",
        "pairs-1", "adhesion-force-1", "force-history-1"}) {
    EXPECT_THAT(html, HasSubstr(std::string("id=\"figure-") + figure + "\""));
  }
  EXPECT_LT(html.find("<figure"), html.find("<table")) << "plots come first";
}

TEST(HtmlReport, HoldsEveryPlotOfAJointFit) {
  const std::string html = html_report(example::two_datasets());
  expect_self_contained(html);
  // 8 panels, 2 x 2 residual plots, 4 x intervals, 4 distributions, corner, 2 x two points, 2 x
  // pairs of points, f0, 2 force histories.
  EXPECT_EQ(occurrences(html, "<svg "), 28U);
}

TEST(HtmlReport, SaysWhereThePointsComeFromBeforeAnythingElse) {
  const std::string html = html_report(example::four_diameters());
  const auto banner = html.find("<aside class=\"provenance reconstruction\"");
  ASSERT_NE(banner, std::string::npos);
  EXPECT_LT(banner, html.find("<p class=\"summary\">"));
  EXPECT_THAT(html, HasSubstr(prose_html(provenance_sentence(Provenance::reconstruction))));
  const std::string joint = html_report(example::two_datasets());
  EXPECT_THAT(joint, HasSubstr("<aside class=\"provenance reconstruction\""));
  EXPECT_THAT(joint, HasSubstr("<aside class=\"provenance measured\""));
}

TEST(HtmlReport, EscapesWhatAFileSays) {
  Analysis analysis = example::four_diameters();
  const std::string hostile = "<script>alert(1)</script>\"'&`touch x`";
  analysis.datasets[0].title = hostile;
  analysis.datasets[0].id = hostile;
  analysis.datasets[0].series[0] = hostile;
  analysis.datasets[0].sources = {hostile};
  analysis.datasets[0].system.particle.name = hostile;
  analysis.spec.id = hostile;
  analysis.datasets[0].warnings = {hostile};
  const std::string html = html_report(analysis);
  expect_self_contained(html);
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)"));
  const std::string index = html_index({{"a.html", json_report(analysis), thumbnail(analysis)}});
  expect_self_contained(index);
}

TEST(HtmlReport, HasWarningsContradictionsInputsAndGlossary) {
  const std::string html = html_report(example::two_datasets());
  for (const char* id : {"warnings", "contradictions", "inputs", "glossary", "parameters",
                         "goodness", "starts", "points", "bootstrap"}) {
    EXPECT_THAT(html, HasSubstr(std::string("<section id=\"") + id + "\">"));
  }
  EXPECT_THAT(html, HasSubstr("20260101"));
  EXPECT_THAT(html, HasSubstr(std::string(60, 'a') + "0123"));
}

TEST(HtmlReport, WithoutABootstrapStillDrawsThePoints) {
  Analysis analysis = example::four_diameters();
  analysis.uncertainty = UncertaintyResult{};
  const std::string html = html_report(analysis);
  expect_self_contained(html);
  EXPECT_EQ(occurrences(html, "<svg "), 8U);  // 4 diameters, 2 residual plots, f0, force history
}

TEST(HtmlReport, StaysSmallWithManyPoints) {
  Analysis analysis = example::two_datasets();
  for (int copy = 0; copy < 5; ++copy) {
    const Analysis more = example::two_datasets();
    analysis.fitted.data.points.insert(analysis.fitted.data.points.end(),
                                       more.fitted.data.points.begin(),
                                       more.fitted.data.points.end());
    for (const auto member : {&FitResult::residuals, &FitResult::prediction,
                              &FitResult::prediction_squared, &FitResult::leverage}) {
      auto& list = analysis.fitted.*member;
      const auto& extra = more.fitted.*member;
      list.insert(list.end(), extra.begin(), extra.end());
    }
  }
  for (RestitutionCurve& curve : analysis.uncertainty.curves) {
    RestitutionCurve dense = curve;
    for (auto member :
         {&RestitutionCurve::velocity, &RestitutionCurve::restitution, &RestitutionCurve::lower,
          &RestitutionCurve::upper, &RestitutionCurve::two_point}) {
      std::vector<double> values;
      const auto& old = curve.*member;
      for (std::size_t i = 0; i + 1 < old.size(); ++i) {
        for (int part = 0; part < 20; ++part) {
          values.push_back(old[i] + (old[i + 1] - old[i]) * part / 20.0);
        }
      }
      dense.*member = values;
    }
    curve = dense;
  }
  expect_self_contained(html_report(analysis));
}

TEST(HtmlReport, AnUnusableFitHasNoPage) {
  Analysis analysis = example::four_diameters();
  analysis.fitted.usable = false;
  EXPECT_THROW(html_report(analysis), ComputationError);
}

TEST(HtmlReport, IsTheSameTwice) {
  EXPECT_EQ(html_report(example::four_diameters()), html_report(example::four_diameters()));
}

TEST(HtmlIndex, HasACardPerFitWithNumbersAndProvenance) {
  std::vector<IndexEntry> entries;
  for (int copy = 0; copy < 7; ++copy) {
    Analysis analysis = copy % 2 == 0 ? example::four_diameters() : example::two_datasets();
    analysis.spec.id += "-" + std::to_string(copy);
    entries.push_back({analysis.spec.id + ".html", json_report(analysis), thumbnail(analysis)});
  }
  const std::string html = html_index(entries);
  expect_self_contained(html);
  EXPECT_EQ(occurrences(html, "<article class=\"card\">"), 7U);
  EXPECT_EQ(occurrences(html, "<svg "), 7U);
  EXPECT_THAT(html, HasSubstr("href=\"example-four-0.html\""));
  EXPECT_THAT(html, HasSubstr("<td>0.00312</td><td>[0.00273, 0.00356]</td><td>0.0046</td>"));
  EXPECT_THAT(html, HasSubstr(prose_html(provenance_sentence(Provenance::reconstruction))));
}

TEST(HtmlIndex, SaysTheVerdictOfTheDiagnosisInWordsAndByAMark) {
  const std::string fit = json_report(example::four_diameters());
  const auto index = [&](const std::string& diagnosis) {
    const std::string html = html_index({{"a.html", fit, "", diagnosis, "a/diagnosis.html"}});
    expect_self_contained(html);
    return html;
  };
  const std::string named =
      index(R"({"verdict": "cause_named", "headline": "What the model misses: a < b"})");
  EXPECT_THAT(named, HasSubstr("class=\"verdict cause_named\""));
  EXPECT_THAT(named, HasSubstr("<a href=\"a/diagnosis.html\">What the model misses: a &lt; b</a>"));
  const std::string rivals = index(R"({"verdict": "not_separable"})");
  EXPECT_THAT(rivals, HasSubstr("<a href=\"a/diagnosis.html\">not separable</a>"));
  const std::string adequate = index(R"({"verdict": "adequate", "headline": "x"})");
  const std::string unknown = index(R"({"verdict": "unexplained", "headline": "x"})");
  const auto mark = [](const std::string& html) {
    const std::size_t begin = html.find("<span class=\"mark\"");
    return html.substr(begin, html.find("</span>", begin) - begin);
  };
  std::set<std::string> marks;
  for (const auto& html : {named, rivals, adequate, unknown}) marks.insert(mark(html));
  EXPECT_EQ(marks.size(), 4U) << "the marks differ, whatever the colours";
  EXPECT_THAT(html_index({{"a.html", fit, ""}}), Not(HasSubstr("class=\"verdict")));
}

TEST(HtmlIndex, RefusesWhatIsNotAFit) {
  EXPECT_THROW(html_index({{"a.html", "{ not json", ""}}), InputError);
  EXPECT_THROW(html_index({{"a.html", "[1]", ""}}), InputError);
  EXPECT_NO_THROW(html_index({{"a.html", "{}", ""}}));
  EXPECT_THROW(html_index({{"a.html", "{}", "", "[", "d"}}), InputError);
  EXPECT_NO_THROW(html_index({}));
}

TEST(HtmlPage, ProseSetsSymbolsOnlyWhereTheyStandAlone) {
  EXPECT_EQ(prose_html("C_H = 3 +/- 1 um"), "<i>C</i><sub>H</sub> = 3 ± 1 µm");
  EXPECT_EQ(prose_html("fits/f0-study.toml"), "fits/f0-study.toml");
  EXPECT_EQ(prose_html("maximum f0."), "maximum <i>f</i><sub>0</sub>.");
  EXPECT_EQ(parameter_html("C_A[a<b]"), "<i>C</i><sub>A</sub> <small>(a&lt;b)</small>");
}

/// Does some picture of the page called `id` hold `words`?
std::string picture_of(const std::string& html, const std::string& id) {
  const std::size_t begin = html.find("id=\"figure-" + id + "\"");
  return begin == std::string::npos ? ""
                                    : html.substr(begin, html.find("</figure>", begin) - begin);
}

TEST(HtmlReport, ComparesTheIntervalsAndMarksTheRecommendedOne) {
  const std::string picture = picture_of(html_report(example::four_diameters()), "intervals-1");
  EXPECT_THAT(picture, HasSubstr("BCa"));
  EXPECT_THAT(picture, HasSubstr("none")) << "the studentized one is missing";
  EXPECT_THAT(picture, HasSubstr("font-weight=\"bold\"")) << "profile";
  EXPECT_THAT(picture, Not(HasSubstr(">bound<"))) << "zero is far away";
  Analysis near = example::four_diameters();
  near.uncertainty.intervals[0].wald.lower = 0.0;
  EXPECT_THAT(picture_of(html_report(near), "intervals-1"), HasSubstr(">bound<"));
}

TEST(HtmlReport, ShowsReplicatesOfPairsOnlyWhereThereAreAny) {
  Analysis analysis = example::four_diameters();
  analysis.uncertainty.bootstrap.theta.clear();
  EXPECT_EQ(picture_of(html_report(analysis), "corner-1"), "");
  analysis = example::four_diameters();
  for (auto& replicate : analysis.uncertainty.bootstrap.theta) replicate[0] = 0.0;  // at a bound
  EXPECT_NE(picture_of(html_report(analysis), "corner-1"), "");
}

TEST(HtmlReport, SaysWhatEachCorrectionDoes) {
  Analysis analysis = example::four_diameters();
  EXPECT_THAT(html_report(analysis), Not(HasSubstr("id=\"corrections\"")));
  analysis.corrections = {example::corrections(1), example::corrections(4)};
  const std::string html = html_report(analysis);
  expect_self_contained(html);
  EXPECT_THAT(html, HasSubstr("come from simulated events through the tool&#39;s own pairing"));
  EXPECT_THAT(html, HasSubstr("all sizes in one point"));
  EXPECT_THAT(html, HasSubstr("in 4 classes of size"));
  EXPECT_EQ(occurrences(html, "no usable fit"), 2U);
  EXPECT_EQ(occurrences(html, "(at its bound)"), 2U);
  const std::vector<std::string> words = correction_words(analysis.corrections.front());
  ASSERT_EQ(words.size(), 4U);
  EXPECT_EQ(words[0],
            "with velocities taken at the measuring plane, e changes by -0.0100 below 0.7 m/s and "
            "by +0.0000 above; C_A becomes 0.0240 s/m instead of 0.0200 (+0.5 of its standard "
            "errors), the capture velocity 0.280 instead of 0.280 m/s");
  EXPECT_THAT(words[1], HasSubstr("the fit has no usable answer"));
  EXPECT_THAT(words[3], HasSubstr("C_A becomes 0.0000 s/m, its bound, instead of 0.0200"));
}

TEST(HtmlReport, LeavesPairsOutWhereTheyWereNotStudied) {
  Analysis analysis = example::four_diameters();
  analysis.uncertainty.pairs.clear();
  const std::string html = html_report(analysis);
  EXPECT_EQ(picture_of(html, "pairs-1"), "");
  EXPECT_THAT(html, Not(HasSubstr("data sets simulated from the full fit")));
}

}  // namespace
}  // namespace recoil
