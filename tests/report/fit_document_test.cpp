#include "report/fit_document.hpp"

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
#include "report/corrections_document.hpp"
#include "report/fit_tables.hpp"
#include "report/materials_tables.hpp"

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

std::vector<std::string> section_ids(const Document& document) {
  std::vector<std::string> ids;
  for (const Section& section : document.sections) {
    if (!empty(section)) ids.push_back(section.id);
  }
  return ids;
}

const Figure* figure_named(const Document& document, const std::string& id) {
  for (const Section& section : document.sections) {
    for (const Figure* figure : figures_of(section)) {
      if (figure->id == id) return figure;
    }
  }
  return nullptr;
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
  EXPECT_THAT(figure_ids(page),
              ElementsAre("restitution-1", "restitution-2", "restitution-3", "restitution-4",
                          "residual-velocity-1", "residual-diameter-1", "intervals-1",
                          "intervals-2", "bootstrap-1", "bootstrap-2", "corner-1", "two-point-1",
                          "adhesion-force-1", "force-history-1"));
  const std::string html = html_page(page);
  expect_self_contained(html);
  EXPECT_LT(html.find("<figure"), html.find("<table")) << "pictures come first";
}

TEST(FitDocument, HoldsEveryFigureOfAJointFit) {
  const Document page = fit_document(sample::two_datasets());
  expect_self_contained(html_page(page));
  const std::vector<std::string> ids = figure_ids(page);
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
  for (const char* id :
       {"restitution-8", "residual-velocity-2", "residual-diameter-2", "intervals-4", "bootstrap-4",
        "corner-1", "two-point-2", "adhesion-force-1", "force-history-2"}) {
    EXPECT_THAT(ids, Contains(id));
  }
}

TEST(FitDocument, GivesWideFiguresTheWidthOfThePage) {
  const Document page = fit_document(sample::four_diameters());
  int wide = 0;
  for (const Section& section : page.sections) {
    for (const Figure* figure : figures_of(section)) {
      if (figure->picture.width <= 600) continue;  // two beside each other
      EXPECT_TRUE(figure->large) << figure->id;
      ++wide;
    }
  }
  EXPECT_GE(wide, 1);
}

TEST(FitDocument, SaysWhereThePointsComeFromBeforeAnythingElse) {
  const auto labels = [](const Analysis& analysis) {
    std::vector<std::string> found;
    for (const Block& block : fit_document(analysis).foreword) {
      if (const auto* banner = std::get_if<Banner>(&block.content())) {
        found.push_back(banner->label);
        EXPECT_FALSE(banner->text.empty());
      } else {
        found.emplace_back("words");
      }
    }
    return found;
  };
  EXPECT_THAT(labels(sample::four_diameters()), ElementsAre("reconstruction", "words"));
  EXPECT_THAT(labels(sample::two_datasets()), ElementsAre("reconstruction", "measured", "words"));
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
  const std::string html = html_report(analysis);
  expect_self_contained(html);
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)"));
}

TEST(FitDocument, HasWarningsContradictionsInputsAndGlossary) {
  const Document page = fit_document(sample::two_datasets());
  const std::vector<std::string> ids = section_ids(page);
  for (const char* id : {"warnings", "contradictions", "inputs", "glossary", "parameters",
                         "goodness", "starts", "points", "bootstrap"}) {
    EXPECT_THAT(ids, Contains(id));
  }
  EXPECT_THAT(ids, Not(Contains("corrections")));
  EXPECT_THAT(ids, Not(Contains("diagnosis")));
}

TEST(FitDocument, TakesTheDiagnosisIn) {
  const Document page = fit_document(sample::four_diameters(), {Paragraph{"Nothing."}});
  const Section* section = section_of(page, "diagnosis");
  ASSERT_NE(section, nullptr);
  EXPECT_EQ(section->blocks.size(), 1U);
}

TEST(FitDocument, WithoutABootstrapStillDrawsThePoints) {
  Analysis analysis = sample::four_diameters();
  analysis.uncertainty = UncertaintyResult{};
  const Document page = fit_document(analysis);
  expect_self_contained(html_page(page));
  EXPECT_THAT(figure_ids(page),
              ElementsAre("restitution-1", "restitution-2", "restitution-3", "restitution-4",
                          "residual-velocity-1", "residual-diameter-1", "adhesion-force-1",
                          "force-history-1"));
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
  expect_self_contained(html_report(analysis));
}

TEST(FitDocument, AnUnusableFitHasNoPageButItsFailureIsPrinted) {
  Analysis analysis = sample::four_diameters();
  analysis.fitted = FitResult{};
  analysis.fitted.model = sample::four_diameters().fitted.model;
  analysis.fitted.failure = "no start rebounds at point 3";
  analysis.uncertainty = UncertaintyResult{};
  EXPECT_THROW(html_report(analysis), ComputationError);
  const std::vector<Section> sections = fit_sections(analysis);
  const auto failure = std::find_if(sections.begin(), sections.end(),
                                    [](const Section& section) { return section.id == "failure"; });
  ASSERT_NE(failure, sections.end());
  EXPECT_EQ(std::get<Paragraph>(failure->blocks.at(0).content()).text,
            Sentence("no start rebounds at point 3"));
}

TEST(FitDocument, IsTheSameTwice) {
  EXPECT_EQ(html_report(sample::four_diameters()), html_report(sample::four_diameters()));
}

TEST(FitDocument, PrintsTheBlocksThatReadersOfLmfitExpectWithin100Columns) {
  for (const Analysis& analysis : {sample::four_diameters(), sample::two_datasets()}) {
    std::vector<std::string> titles;
    for (const Section& section : fit_sections(analysis)) {
      if (!empty(section)) titles.push_back(plain_text(section.title));
    }
    EXPECT_THAT(titles,
                testing::IsSupersetOf({"Provenance", "Model", "Fit Statistics", "Variables",
                                       "Correlations", "Capture Velocity", "Two Points Against All",
                                       "Bootstrap", "Identifiability", "Starts"}))
        << analysis.spec.id;
    const std::string text = text_report(analysis);
    EXPECT_LE(longest_line(text), terminal_columns) << text;
    EXPECT_FALSE(std::regex_search(text, std::regex("\\b(nan|inf)\\b"))) << text;
  }
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
  EXPECT_LE(longest_line(text_report(analysis)), terminal_columns) << text_report(analysis);
}

TEST(FitDocument, SaysWhereAPointPassesALimitOfTheModel) {
  Analysis analysis = sample::two_datasets();
  analysis.validity = {{ValidityQuantity::contact_radius, 0.52, 0.3, 1, 4.9e-6, 100.0},
                       {ValidityQuantity::tabor, 13.4, 5.0, 1, 4.9e-6, 100.0}};
  const std::string text = text_report(analysis);
  EXPECT_THAT(text, testing::HasSubstr(
                        "[[Limits of the Model]]\n"
                        "    - On example-silicon the contact grows to 0.52 of the sphere's radius "
                        "(100 m/s, 4.9 um); Hertz'\n      theory is good to about 0.3.\n"));
  EXPECT_EQ(text.find("Tabor"), std::string::npos);  // within its limit: only in fit.json
  const Document page = fit_document(analysis);
  EXPECT_NE(section_of(page, "validity"), nullptr);
  analysis.validity.erase(analysis.validity.begin());
  EXPECT_EQ(text_report(analysis).find("Limits of the Model"), std::string::npos);
}

TEST(FitTables, TheContactNamesEveryF0ByTheStiffnessItFollowsFrom) {
  Analysis analysis = sample::four_diameters();
  const auto f0_from = [&] { return words(row_of(contact_table(analysis, 0), "f0 [N/m]")[2]); };
  EXPECT_EQ(f0_from(), "derived; eq. 12 gives 8.908");
  // By hand, (9 W^2 K r / (2 pi))^(1/3) with W = 0.336 J/m2, r = 2.45 um and either K.
  ImpactSystem& system = analysis.datasets[0].system;
  system.adhesion_energy = 0.336;
  system.stiffness_K = 0.2 * 1.789e9;
  analysis.fitted.model.contacts[0] = derive_contact(system, 4.9e-6);
  EXPECT_EQ(f0_from(), "derived; eq. 12 gives 5.214 with this K, 8.916 with that of eq. 6");
}

TEST(FitTables, GiveEstimateErrorIntervalAndStartOfAParameter) {
  const Table table = parameters_table(sample::four_diameters());
  ASSERT_EQ(table.rows.size(), 3U);
  const auto& C_H = row_of(table, "C_H");
  EXPECT_EQ(number_in(C_H[1]).value, 0.00312);
  EXPECT_EQ(number_in(C_H[1]).error, 0.00021);
  EXPECT_NEAR(number_in(C_H[2]).value, 6.73, 0.005);
  EXPECT_EQ(words(C_H[3]), "s/m");
  const auto interval = std::get<NumberRange>(C_H[4]);
  EXPECT_NEAR(interval.lower, 0.0027315, 1e-9);
  EXPECT_NEAR(interval.upper, 0.003561, 1e-9);
  EXPECT_EQ(words(C_H[5]), "profile");
  EXPECT_EQ(number_in(C_H[6]).value, 0.003);
  const auto& f0 = row_of(table, "f0");
  EXPECT_EQ(words(f0[5]), "fixed");
  EXPECT_EQ(number_in(f0[1]).error, 0.0);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(f0[4]));
}

TEST(FitTables, SetEveryFreeParameterBesideTheOneOfExactMaterials) {
  Analysis analysis = sample::four_diameters();
  ConditionalFit exact{analysis.fitted, analysis.uncertainty.intervals};
  exact.fitted.theta = {0.0033, 0.0505, 8.9};
  exact.intervals[1] = {};
  analysis.uncertainty.conditional = exact;
  const Table table = conditional_table(analysis);
  ASSERT_EQ(table.rows.size(), 2U);  // f0 is fixed
  const auto& C_H = row_of(table, "C_H [s/m]");
  EXPECT_EQ(number_in(C_H[1]).value, 0.00312);
  EXPECT_EQ(number_in(C_H[3]).value, 0.0033);
  EXPECT_THAT(words(C_H[4]), HasSubstr("0.003561]"));
  const auto& C_A = row_of(table, "C_A [s/m]");
  EXPECT_EQ(number_in(C_A[3]).value, 0.0505);
  EXPECT_THAT(words(C_A[2]), HasSubstr("["));
  EXPECT_EQ(words(C_A[4]), "–");
}

TEST(FitTables, SayWhatIsMissing) {
  Analysis analysis = sample::two_datasets();
  EXPECT_THAT(parameter_remarks(analysis).entries, IsEmpty());
  analysis.fitted.at_bound[0] = true;
  analysis.fitted.std_error[0] = 0.0;
  EXPECT_EQ(parameter_remarks(analysis).entries.size(), 1U);
  EXPECT_EQ(number_in(row_of(parameters_table(analysis), "C_H")[1]).error, 0.0);
  EXPECT_TRUE(std::holds_alternative<Sentence>(row_of(statistics_table(analysis), "p-value")[1]))
      << "no standard deviations are stated";
  EXPECT_EQ(missing_intervals(analysis).entries.size(), 4U) << "studentized of each";
}

TEST(FitTables, GiveTheStatisticsOfTheFit) {
  Analysis analysis = sample::four_diameters();
  const Table table = statistics_table(analysis);
  EXPECT_EQ(number_in(row_of(table, "data points")[1]).value, 32.0);
  EXPECT_EQ(number_in(row_of(table, "variables")[1]).value, 2.0);
  EXPECT_EQ(number_in(row_of(table, "chi-square")[1]).value, analysis.fitted.chi2);
  EXPECT_EQ(number_in(row_of(table, "degrees of freedom")[1]).value, 30.0);
  EXPECT_EQ(number_in(row_of(table, "p-value")[1]).value, 0.37);
  EXPECT_EQ(number_in(row_of(table, "rms of e")[1]).value, 0.0293);
  analysis.fitted.dof -= 3;
  EXPECT_EQ(words(row_of(statistics_table(analysis), "degrees of freedom")[1]),
            "27; captured points that the model captures too, 3, cannot scatter and do not count");
}

TEST(FitTables, GiveCorrelationsTheLargestFirst) {
  const Table table = correlations_table(sample::four_diameters());
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(words(table.rows[0][0]), "C_H");
  EXPECT_EQ(words(table.rows[0][1]), "C_A");
  EXPECT_NEAR(number_in(table.rows[0][2]).value, -0.43, 1e-12);
}

TEST(FitTables, SetTwoPointsBesideAll) {
  const Analysis analysis = sample::four_diameters();
  const Table table = two_point_table(analysis, analysis.uncertainty.two_point.front());
  const auto& C_H = row_of(table, "C_H [s/m]");
  EXPECT_EQ(number_in(C_H[1]).value, 0.0046);
  EXPECT_EQ(number_in(C_H[2]).value, 0.00312);
  EXPECT_EQ(number_in(row_of(table, "rms of e, all points")[1]).value, 0.047);
  EXPECT_EQ(number_in(row_of(table, "rms of e, held-out diameters")[2]).value, 0.034);
}

TEST(FitTables, ShowEveryPointWithItsResidual) {
  const Analysis analysis = sample::two_datasets();
  const Table table = points_table(analysis);
  ASSERT_EQ(table.rows.size(), analysis.fitted.data.points.size());
  EXPECT_EQ(words(table.rows[0][0]), "example-molybdenum");
  EXPECT_EQ(words(table.rows[0][4]), "captured");
  EXPECT_EQ(number_in(table.rows[1][4]).value, analysis.fitted.data.points[1].restitution);
}

TEST(FitTables, WithoutAdhesionThereIsNoCaptureVelocity) {
  Analysis analysis = sample::four_diameters();
  ASSERT_FALSE(analysis.uncertainty.capture.empty());
  EXPECT_GT(number_in(capture_table(analysis).rows[0][2]).value, 0.0);
  analysis.fitted.model.contacts[0].adhesion_force = 0.0;
  analysis.fitted.model.slots[analysis.fitted.model.slot_adhesion[0]].free = false;
  const Table none = capture_table(analysis);
  ASSERT_EQ(none.rows.size(), 4U);
  for (const auto& row : none.rows) EXPECT_EQ(row.size(), 3U) << "no interval";
  EXPECT_TRUE(std::holds_alternative<Sentence>(none.rows[0][2]));
  // A fitted f0 is an adhesion.
  analysis.fitted.model.slots[analysis.fitted.model.slot_adhesion[0]].free = true;
  EXPECT_GT(number_in(capture_table(analysis).rows[0][2]).value, 0.0);
}

TEST(FitFigures, CompareTheIntervalsAndMarkTheRecommendedOne) {
  const auto picture = [](const Analysis& analysis) {
    const Document page = fit_document(analysis);
    const Figure* figure = figure_named(page, "intervals-1");
    if (figure == nullptr) return std::string();
    std::vector<Figure> drawn = {*figure};
    draw(drawn);
    return drawn.front().svg;
  };
  const std::string svg = picture(sample::four_diameters());
  EXPECT_THAT(svg, HasSubstr("BCa"));
  EXPECT_THAT(svg, HasSubstr("none")) << "the studentized one is missing";
  EXPECT_THAT(svg, HasSubstr("font-weight=\"bold\"")) << "profile";
  EXPECT_THAT(svg, Not(HasSubstr(">bound<"))) << "zero is far away";
  Analysis near = sample::four_diameters();
  near.uncertainty.intervals[0][IntervalKind::wald].lower = 0.0;
  EXPECT_THAT(picture(near), HasSubstr(">bound<"));
}

TEST(FitFigures, ShowReplicatesOfPairsOnlyWhereThereAreAny) {
  Analysis analysis = sample::four_diameters();
  analysis.uncertainty.bootstrap.theta.clear();
  EXPECT_EQ(figure_named(fit_document(analysis), "corner-1"), nullptr);
  analysis = sample::four_diameters();
  for (auto& replicate : analysis.uncertainty.bootstrap.theta) replicate[0] = 0.0;  // at a bound
  EXPECT_NE(figure_named(fit_document(analysis), "corner-1"), nullptr);
}

TEST(FitDocument, SaysWhatEachCorrectionDoes) {
  Analysis analysis = sample::four_diameters();
  analysis.corrections = {sample::corrections(1), sample::corrections(4)};
  const Document page = fit_document(analysis);
  expect_self_contained(html_page(page));
  const Section* section = section_of(page, "corrections");
  ASSERT_NE(section, nullptr);
  const std::vector<const Table*> tables = tables_of(*section);
  ASSERT_EQ(tables.size(), 2U);
  EXPECT_EQ(figures_of(*section).size(), 4U);
  const auto& first = tables[0]->rows;
  ASSERT_EQ(first.size(), 6U) << "the truth, and five ways";
  EXPECT_EQ(number_in(first[0][6]).value, analysis.corrections[0].capture_velocity);
  const std::vector<Sentence> changes = correction_words(analysis.corrections.front());
  ASSERT_EQ(changes.size(), 4U);
  EXPECT_EQ(plain_text(changes[0]),
            "with velocities taken at the measuring plane, e changes by -0.0100 below 0.7 m/s and "
            "by +0.0000 above; C_A becomes 0.0240 s/m instead of 0.0200 (+0.5 of its standard "
            "errors), the capture velocity 0.280 instead of 0.280 m/s");
}

}  // namespace
}  // namespace recoil
