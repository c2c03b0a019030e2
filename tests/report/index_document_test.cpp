#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/error.hpp"
#include "document/html.hpp"
#include "example_analysis.hpp"
#include "page_checks.hpp"
#include "plot/draw.hpp"
#include "report/index_page.hpp"
#include "report/result_json.hpp"
#include "support/document_parts.hpp"

namespace recoil {
namespace {

using testing::ElementsAre;

IndexEntry entry_of(const Analysis& analysis) {
  IndexEntry entry{analysis.spec.id + ".html", fit_json(analysis)};
  entry.picture = plot::draw_svg(thumbnail(analysis));
  return entry;
}

/// The cells of the row whose heading begins with `name`.
std::vector<Cell> index_row(const Table& table, const std::string& name) {
  for (const auto& row : table.rows) {
    if (plain_text(words_of_cell(row.front())).starts_with(name)) return row;
  }
  ADD_FAILURE() << "no row " << name;
  return std::vector<Cell>(3);
}

TEST(Index, HasACardPerFit) {
  std::vector<IndexEntry> entries;
  std::vector<std::string> ids;
  for (int copy = 0; copy < 7; ++copy) {
    Analysis analysis = copy % 2 == 0 ? sample::four_diameters() : sample::two_datasets();
    analysis.spec.id += "-" + std::to_string(copy);
    ids.push_back(analysis.spec.id);
    entries.push_back(entry_of(analysis));
  }
  const Document index = index_document(entries);
  expect_self_contained(html_page(index_document(entries)));
  ASSERT_EQ(index.sections.size(), 7U);
  for (std::size_t k = 0; k < entries.size(); ++k) {
    const Section& card = index.sections[k];
    EXPECT_EQ(card.id, ids[k]);
    EXPECT_EQ(card.address, entries[k].page);
    EXPECT_EQ(figures_of(card).size(), 1U);
    EXPECT_EQ(support::tables_of(card).size(), 1U);
  }
  ASSERT_EQ(index.foreword.size(), 4U) << "an introduction, banners for two provenances, all fits";
  const Table& fits = std::get<Table>(index.foreword.back().content());
  ASSERT_EQ(fits.rows.size(), 7U);
  EXPECT_EQ(plain_text(words_of_cell(fits.rows[6].front())), ids[6]);
  EXPECT_NO_THROW(html_page(index_document({})));
}

TEST(Index, LinksOtherPagesByTheirTitles) {
  Document other;
  other.title = "Spheres & \"plates\"";
  other.foot = "recoil 1.0";
  EXPECT_EQ(title_of_page(html_page(other)), other.title);
  other.foot = "somebody else";
  EXPECT_EQ(title_of_page(html_page(other)), "");
  EXPECT_EQ(title_of_page("<footer>recoil "), "");
  const std::string html = html_page(index_document({}, {link("Spheres & plates", "b.html")}));
  EXPECT_NE(html.find("<a href=\"b.html\">Spheres &amp; plates</a>"), std::string::npos);
}

TEST(Index, ShowsCaptureVelocitiesAndFreeParameters) {
  const Analysis analysis = sample::four_diameters();
  const Document index = index_document({{"a.html", fit_json(analysis)}});
  const Table& table = *support::tables_of(index.sections.at(0)).at(0);
  const auto C_H = index_row(table, "C_H");
  EXPECT_EQ(std::get<Number>(C_H[1]).value, 0.00312);
  EXPECT_NEAR(std::get<NumberRange>(C_H[2]).lower, 0.0027315, 1e-9);
  const auto capture = index_row(table, "V* at 2.58 um");
  EXPECT_EQ(std::get<Number>(capture[1]).value, analysis.uncertainty.capture.front().value);
  EXPECT_EQ(table.rows.size(), 4U + 2U) << "sizes, free parameters";
}

TEST(Index, SaysTheVerdictOnTheModelInWordsAndByASign) {
  const auto remark = [](const std::string& verdict, const std::string& diagnosis = "") {
    const std::string fit =
        R"({"model_verdict": {"verdict": ")" + verdict + R"(", "text": "It fits."}})";
    const Document index = index_document({{"a.html", fit, diagnosis, "a/diagnosis.html"}});
    for (const Block& block : index.sections.at(0).blocks) {
      if (const auto* found = std::get_if<Remark>(&block.content())) return *found;
    }
    return Remark{};
  };
  const Remark alone = remark("fits");
  EXPECT_EQ(plain_text(alone.text), "It fits.");
  const Remark named = remark("does_not_fit", R"({"headline": "It misses: a < b"})");
  EXPECT_EQ(named.look, "does_not_fit");
  EXPECT_THAT(named.text.runs(),
              ElementsAre(recoil::Run{RunKind::link, "It misses: a < b", "a/diagnosis.html"}));
  const std::set<std::string> signs = {alone.sign, named.sign, remark("fits_within_law_error").sign,
                                       remark("untested").sign};
  EXPECT_EQ(signs.size(), 4U) << "the verdicts have different signs";
}

TEST(Index, RefusesWhatIsNotAFit) {
  EXPECT_THROW(index_document({{"a.html", "{ not json"}}), InputError);
  EXPECT_THROW(index_document({{"a.html", "[1]"}}), InputError);
  EXPECT_NO_THROW(index_document({{"a.html", "{}"}}));
  EXPECT_THROW(index_document({{"a.html", "{}", "["}}), InputError);
}

}  // namespace
}  // namespace recoil
