#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "document/html.hpp"
#include "document/terminal.hpp"
#include "example_analysis.hpp"
#include "page_checks.hpp"
#include "report/fit_report.hpp"

namespace recoil {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> figure_ids(const Document& document) {
  std::vector<std::string> ids;
  for (const Section& section : document.sections) {
    for (const Figure* figure : figures_of(section)) ids.push_back(figure->id);
  }
  return ids;
}

/// The row of `table` that begins with these words.
const std::vector<Cell>& row_of(const Table& table, const std::string& name) {
  static const std::vector<Cell> none(10);
  for (const auto& row : table.rows) {
    if (plain_text(words_of_cell(row.front())) == name) return row;
  }
  ADD_FAILURE() << "no row " << name;
  return none;
}

Number number_in(const Cell& cell) {
  const auto* found = std::get_if<Number>(&cell);
  if (found == nullptr) ADD_FAILURE() << plain_text(words_of_cell(cell)) << " is no quantity";
  return found == nullptr ? Number{} : *found;
}

std::string words(const Cell& cell) { return plain_text(words_of_cell(cell)); }

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) {
    const auto characters = std::count_if(line.begin(), line.end(), [](char c) {
      return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
    });
    longest = std::max(longest, static_cast<std::size_t>(characters));
  }
  return longest;
}

TEST(FitDocument, HasTheNameOfItsDataOrOfItsFit) {
  const Analysis one = sample::four_diameters();
  EXPECT_EQ(plain_text(fit_document(one).heading), one.datasets.front().title);
  const Analysis joint = sample::two_datasets();
  EXPECT_EQ(plain_text(fit_document(joint).heading), joint.spec.id);
}

TEST(FitDocument, HoldsEveryFigureOfOneDataset) {
  const Document page = fit_document(sample::four_diameters());
  EXPECT_THAT(figure_ids(page), ElementsAre("overview", "restitution-1", "restitution-2",
                                            "restitution-3", "restitution-4", "residuals-1"));
  const std::string html = html_page(page);
  expect_self_contained(html);
  EXPECT_LT(html.find("<figure"), html.find("<table")) << "pictures come first";
}

TEST(FitDocument, HoldsEveryFigureOfAJointFit) {
  const Document page = fit_document(sample::two_datasets());
  expect_self_contained(html_page(page));
  const std::vector<std::string> ids = figure_ids(page);
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
  for (const char* id : {"overview", "restitution-8", "residuals-2"}) {
    EXPECT_THAT(ids, Contains(id));
  }
}

TEST(FitDocument, SaysTheOriginOfThePointsWithTheAnswer) {
  const auto labels = [](const Analysis& analysis) {
    std::vector<std::string> found;
    const Document page = fit_document(analysis);
    for (const Block& block : page.sections.front().blocks) {
      if (const auto* banner = std::get_if<Banner>(&block.content())) {
        found.push_back(banner->label);
        EXPECT_FALSE(banner->text.empty());
      }
    }
    return found;
  };
  EXPECT_THAT(labels(sample::four_diameters()), ElementsAre("reconstruction"));
  EXPECT_THAT(labels(sample::two_datasets()), ElementsAre("reconstruction", "measured"));
}

TEST(FitDocument, EscapesWhatAFileSays) {
  Analysis analysis = sample::four_diameters();
  const std::string hostile = "<script>alert(1)</script>\"'&`touch x`";
  analysis.datasets[0].title = hostile;
  analysis.datasets[0].id = hostile;
  analysis.datasets[0].series[0] = hostile;
  analysis.datasets[0].sources = {hostile};
  analysis.datasets[0].system.particle.name = hostile;
  analysis.spec.id = hostile;
  analysis.fitted.model.contacts[0].contradictions = {hostile};
  const std::string html = fit_html(analysis);
  expect_self_contained(html);
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)"));
}

TEST(FitDocument, WithoutABootstrapStillDrawsThePoints) {
  Analysis analysis = sample::four_diameters();
  analysis.uncertainty = UncertaintyResult{};
  const Document page = fit_document(analysis);
  expect_self_contained(html_page(page));
  EXPECT_THAT(figure_ids(page), ElementsAre("overview", "restitution-1", "restitution-2",
                                            "restitution-3", "restitution-4", "residuals-1"));
}

TEST(FitDocument, StaysSmallWithManyPoints) {
  Analysis analysis = sample::two_datasets();
  for (int copy = 0; copy < 5; ++copy) {
    const Analysis more = sample::two_datasets();
    auto& points = analysis.fitted.data.points;
    points.insert(points.end(), more.fitted.data.points.begin(), more.fitted.data.points.end());
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
  expect_self_contained(fit_html(analysis));
}

TEST(FitDocument, AnUnusableFitHasNoPageButItsFailureIsPrinted) {
  Analysis analysis = sample::four_diameters();
  analysis.fitted = FitResult{};
  analysis.fitted.model = sample::four_diameters().fitted.model;
  analysis.fitted.failure = "no start rebounds at point 3";
  analysis.uncertainty = UncertaintyResult{};
  EXPECT_THROW(fit_html(analysis), ComputationError);
  EXPECT_THAT(fit_text(analysis, Importance::answer), HasSubstr("no start rebounds at point 3"));
}

TEST(FitDocument, IsTheSameTwice) {
  EXPECT_EQ(fit_html(sample::four_diameters()), fit_html(sample::four_diameters()));
}

TEST(FitDocument, AnswersWithin25Lines) {
  for (const Analysis& analysis : {sample::four_diameters(), sample::two_datasets()}) {
    for (const std::size_t columns : {std::size_t{80}, terminal_columns}) {
      const std::string answer = fit_text(analysis, Importance::answer, columns);
      EXPECT_LE(std::count(answer.begin(), answer.end(), '\n'), 25) << answer;
      EXPECT_LE(longest_line(answer), columns) << answer;
      const std::string all = fit_text(analysis, Importance::detail, columns);
      EXPECT_GT(all.size(), 2 * answer.size());
      EXPECT_LE(longest_line(all), columns) << all;
      EXPECT_FALSE(std::regex_search(all, std::regex("\\b(nan|inf)\\b"))) << all;
    }
  }
}

TEST(FitDocument, FoldsTheDetailsUnderSixHeadings) {
  const Document page = fit_document(sample::two_datasets());
  std::vector<std::string> details;
  for (const Section& section : page.sections) {
    if (section.importance == Importance::detail) details.push_back(section.id);
  }
  EXPECT_THAT(details,
              ElementsAre("sizes", "certainty", "comparison", "warnings", "citation", "inputs"));
}

TEST(FitDocument, StaysNarrowWhateverTheWordsAre) {
  Analysis analysis = sample::four_diameters();
  analysis.datasets[0].title = std::string(300, 'x') + " µµµ " + std::string(300, 'y');
  analysis.datasets[0].id =
      "a-dataset-with-a-name-that-is-far-too-long-to-stand-in-one-line-of-text";
  analysis.spec.file = "/a/path/" + std::string(150, 'p') + "/fit.toml";
  analysis.fitted.model.contacts[0].contradictions = {
      std::string(250, 'w') + " and the reason why " + std::string(40, 'z')};
  analysis.fitted.model.slots[0].dataset = analysis.datasets[0].id;
  analysis.uncertainty.bootstrap.failures.index = {3};
  analysis.uncertainty.bootstrap.failures.message = std::string(500, 'i');
  const std::string text = fit_text(analysis, Importance::detail, terminal_columns);
  EXPECT_LE(longest_line(text), terminal_columns) << text;
}

TEST(FitTables, TheContactSaysWhatIsStatedAndWhatFollows) {
  Analysis analysis = sample::four_diameters();
  const auto cell = [&](const char* row) { return words(row_of(contact_table(analysis), row)[1]); };
  EXPECT_EQ(cell("f0 [N/m] at 4.9 um"), "8.908");
  ImpactSystem& system = analysis.datasets[0].system;
  system.adhesion_energy = 0.336;
  system.stiffness_K = 0.2 * 1.789e9;
  analysis.fitted.model.contacts[0] = derive_contact(system, 4.9e-6);
  EXPECT_EQ(cell("K [GPa]"), "0.3578 (stated; eq. 6 gives 1.789)");
  EXPECT_EQ(cell("W_A [J/m2]"), "0.336 (stated)");
}

TEST(FitTables, GiveEstimateErrorAndIntervalOfAParameter) {
  Analysis analysis = sample::four_diameters();
  const Table table = parameters_table(analysis);
  ASSERT_EQ(table.rows.size(), 3U);
  const auto& C_H = row_of(table, "C_H [s/m]");
  EXPECT_EQ(number_in(C_H[1]).value, 0.00312);
  EXPECT_EQ(number_in(C_H[1]).error, 0.00021);
  EXPECT_THAT(words(C_H[2]), HasSubstr("0.00273, 0.00356]"));  // 0.0027315 to 0.003561
  const auto& f0 = row_of(table, "f0 [N/m]");
  EXPECT_EQ(words(f0[2]), "fixed");
  EXPECT_EQ(number_in(f0[1]).error, 0.0);
  analysis.fitted.at_bound[0] = true;
  EXPECT_THAT(words(row_of(parameters_table(analysis), "C_H [s/m]")[2]),
              HasSubstr(", at its bound"));
}

// 49 um, where the points are of 2.58 to 6.89 um.
TEST(FitTables, GiveF0WithItsSizeIfNoPointHasIt) {
  Analysis analysis = sample::four_diameters();
  const TwoPointComparison& two = analysis.uncertainty.two_point.front();
  EXPECT_EQ(plain_text(two_point_table(analysis, two).columns[3].heading), "f0");
  analysis.fitted.model.contacts[0].reference_diameter = 49e-6;
  EXPECT_EQ(words(row_of(parameters_table(analysis), "f0 at 49 um [N/m]")[2]), "fixed");
  EXPECT_EQ(plain_text(two_point_table(analysis, two).columns[3].heading), "f0 at 49 um");
}

TEST(FitTables, GiveTheCaptureVelocityOfEverySize) {
  Analysis analysis = sample::four_diameters();
  const Table table = capture_table(analysis);
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_EQ(number_in(table.rows[0][1]).value, analysis.uncertainty.capture[0].value);
  // Without adhesion there is no capture velocity. A free f0 counts as adhesion.
  analysis.fitted.model.contacts[0].adhesion_force = 0.0;
  analysis.fitted.model.slots[analysis.fitted.model.slot_adhesion[0]].free = false;
  EXPECT_TRUE(std::holds_alternative<Sentence>(capture_table(analysis).rows[0][1]));
  analysis.fitted.model.slots[analysis.fitted.model.slot_adhesion[0]].free = true;
  EXPECT_GT(number_in(capture_table(analysis).rows[0][1]).value, 0.0);
}

TEST(FitTables, GiveTheStatisticsOfTheFit) {
  Analysis analysis = sample::four_diameters();
  const Table table = statistics_table(analysis);
  EXPECT_EQ(number_in(row_of(table, "data points")[1]).value, 32.0);
  EXPECT_EQ(number_in(row_of(table, "free parameters")[1]).value, 2.0);
  EXPECT_EQ(number_in(row_of(table, "chi-square")[1]).value, analysis.fitted.chi2);
  EXPECT_EQ(number_in(row_of(table, "degrees of freedom")[1]).value, 30.0);
  EXPECT_EQ(number_in(row_of(table, "p-value")[1]).value, 0.37);
  EXPECT_EQ(number_in(row_of(table, "rms of e")[1]).value, 0.0293);
  analysis.fitted.dof -= 3;
  EXPECT_EQ(words(row_of(statistics_table(analysis), "degrees of freedom")[1]),
            "27 (3 captured points are excluded)");
}

TEST(FitTables, SetTwoPointsBesideAll) {
  const Analysis analysis = sample::four_diameters();
  const Table table = two_point_table(analysis, analysis.uncertainty.two_point.front());
  ASSERT_EQ(table.rows.size(), 3U);
  const auto& two = table.rows.front();  // named by its diameter
  EXPECT_EQ(number_in(two[1]).value, 0.0046);
  EXPECT_EQ(number_in(two[4]).value, 0.047);
  const auto& all = row_of(table, "all points, same f0");
  EXPECT_EQ(number_in(all[1]).value, 0.00312);
  EXPECT_EQ(number_in(all[3]).value, number_in(two[3]).value);  // like with like
  EXPECT_EQ(number_in(all[5]).value, 0.034);
  EXPECT_FALSE(std::holds_alternative<Number>(row_of(table, "all points, f0 fitted")[1]));
}

}  // namespace
}  // namespace recoil
