#include "report/index_document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/error.hpp"
#include "example_analysis.hpp"
#include "page_checks.hpp"
#include "report/result_json.hpp"

namespace recoil {
namespace {

using testing::ElementsAre;

IndexEntry entry_of(const Analysis& analysis) {
  return {analysis.spec.id + ".html", summary_of(analysis), thumbnail(analysis)};
}

TEST(Index, HasACardPerFit) {
  std::vector<IndexEntry> entries;
  for (int copy = 0; copy < 7; ++copy) {
    Analysis analysis = copy % 2 == 0 ? sample::four_diameters() : sample::two_datasets();
    analysis.spec.id += "-" + std::to_string(copy);
    entries.push_back(entry_of(analysis));
  }
  const Document index = index_document(entries);
  expect_self_contained(html_index(entries));
  ASSERT_EQ(index.sections.size(), 7U);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const Section& card = index.sections[k];
    EXPECT_EQ(card.id, entries[k].fit.id);
    EXPECT_EQ(card.address, entries[k].page);
    EXPECT_EQ(figures_of(card).size(), 1U);
    EXPECT_EQ(tables_of(card).size(), 1U);
    EXPECT_TRUE(std::holds_alternative<Banner>(card.blocks.front().content()));
  }
  EXPECT_NO_THROW(html_index({}));
}

TEST(Index, ShowsEstimateIntervalAndTwoPoints) {
  const Table table = summary_table(summary_of(sample::four_diameters()));
  const auto& C_H = table.rows.at(0);
  EXPECT_EQ(std::get<Number>(C_H[1]).value, 0.00312);
  EXPECT_NEAR(std::get<NumberRange>(C_H[2]).lower, 0.0027315, 1e-9);
  EXPECT_EQ(std::get<Number>(C_H[3]).value, 0.0046);
  // The second of two datasets has another pair of points.
  const FitSummary joint = summary_of(sample::two_datasets());
  ASSERT_TRUE(joint.parameters.at(0).two_point.has_value());
  EXPECT_EQ(joint.parameters[0].two_point.value()[0], 0.0041);
  EXPECT_EQ(joint.parameters[0].two_point.value()[1], 0.0046);
}

TEST(Index, NamesTheLawWithTheLowestCriterion) {
  FitSummary summary = summary_of(sample::four_diameters());
  const std::size_t rows = summary_table(summary).rows.size();
  for (const auto& [law, chi2] : {std::pair("dmt", 25.0), {"ring", 10.0}, {"jkr", 1010.0}}) {
    ComparedFit fit;
    fit.adhesion = law;
    fit.chi2 = chi2;
    fit.points = 20;
    fit.free_parameters = 2;  // of all: AICc differs as chi2 does
    fit.sd_stated = true;
    summary.laws.push_back(fit);
  }
  const Table table = summary_table(summary);
  ASSERT_EQ(table.rows.size(), rows + 1);
  EXPECT_EQ(plain_text(std::get<Sentence>(table.rows.back()[1])), "ring");
  EXPECT_EQ(plain_text(std::get<Sentence>(table.rows.back()[2])), "dmt +15, jkr +1000");
}

TEST(Index, ReadsFromItsFilesWhatItWouldHaveBeenHanded) {
  for (const Analysis& analysis : {sample::four_diameters(), sample::two_datasets()}) {
    const FitSummary made = summary_of(analysis);
    const FitSummary read = read_summary("a.html", fit_json(analysis));
    EXPECT_EQ(read.id, made.id);
    EXPECT_EQ(read.title, made.title);
    EXPECT_EQ(read.datasets, made.datasets);
    EXPECT_EQ(read.points, made.points);
    EXPECT_EQ(read.provenances, made.provenances);
    EXPECT_EQ(read.dof, made.dof);
    EXPECT_EQ(read.chi2, made.chi2);
    EXPECT_EQ(read.rmse, made.rmse);
    EXPECT_EQ(read.p_value, made.p_value);
    ASSERT_EQ(read.two_point_rmse.has_value(), made.two_point_rmse.has_value());
    EXPECT_EQ(read.two_point_rmse.value()[1], made.two_point_rmse.value()[1]);
    ASSERT_EQ(read.parameters.size(), made.parameters.size());
    for (std::size_t s = 0; s < made.parameters.size(); ++s) {
      const ParameterSummary& one = made.parameters[s];
      const ParameterSummary& other = read.parameters[s];
      EXPECT_EQ(other.label, one.label);
      EXPECT_EQ(other.unit, one.unit);
      EXPECT_EQ(other.value, one.value);
      EXPECT_EQ(other.free, one.free);
      ASSERT_EQ(other.interval.has_value(), one.interval.has_value()) << one.label;
      EXPECT_EQ(other.interval, one.interval);
    }
  }
}

TEST(Index, SaysTheVerdictOfTheDiagnosisInWordsAndByASign) {
  const auto remark = [](const std::string& diagnosis) {
    const Document index = index_document(
        {{"a.html", read_summary("a.html", "{}", diagnosis), "", "a/diagnosis.html"}});
    for (const Block& block : index.sections.at(0).blocks) {
      if (const auto* found = std::get_if<Remark>(&block.content())) return *found;
    }
    return Remark{};
  };
  const Remark named = remark(R"({"verdict": "cause_named", "headline": "It misses: a < b"})");
  EXPECT_EQ(named.look, "cause_named");
  EXPECT_THAT(named.text.runs(),
              ElementsAre(recoil::Run{RunKind::link, "It misses: a < b", "a/diagnosis.html"}));
  const Remark rivals = remark(R"({"verdict": "not_separable"})");
  EXPECT_EQ(plain_text(rivals.text), "not separable");
  const std::set<std::string> signs = {named.sign, rivals.sign,
                                       remark(R"({"verdict": "adequate"})").sign,
                                       remark(R"({"verdict": "unexplained"})").sign};
  EXPECT_EQ(signs.size(), 4U) << "the signs differ, whatever the colours";
  EXPECT_TRUE(remark("").sign.empty());
}

TEST(Index, RefusesWhatIsNotAFit) {
  EXPECT_THROW(read_summary("a.html", "{ not json"), InputError);
  EXPECT_THROW(read_summary("a.html", "[1]"), InputError);
  EXPECT_NO_THROW(read_summary("a.html", "{}"));
  EXPECT_THROW(read_summary("a.html", "{}", "["), InputError);
}

}  // namespace
}  // namespace recoil
