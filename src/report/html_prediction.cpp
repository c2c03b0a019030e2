#include <fmt/format.h>

#include <algorithm>

#include "report/format.hpp"
#include "report/html_page.hpp"
#include "report/prediction.hpp"

namespace recoil {
namespace {

constexpr std::size_t rows_shown = 14;

std::string cell(const BandedValue& at, double factor, int decimals) {
  if (!at.value) return "–";
  std::string text = fmt::format("{:.{}f}", factor * *at.value, decimals);
  if (at.lower && at.upper) {
    text += fmt::format(" <small>[{:.{}f}, {:.{}f}]</small>", factor * *at.lower, decimals,
                        factor * *at.upper, decimals);
  }
  return text;
}

std::string table_of(const PolydispersePrediction& mixture) {
  HtmlTable table;
  table.caption = fmt::format("Mean restitution by convention, and captures, with {} bands",
                              percent(mixture.level));
  table.head = {"<i>V</i> [m/s]",  "captured as 0", "captured left out",
                "unseen left out", "captured [%]",  "captured or unseen [%]"};
  const std::size_t stride = std::max<std::size_t>(1, mixture.velocity.size() / rows_shown);
  for (std::size_t k = 0; k < mixture.velocity.size(); k += stride) {
    table.rows.push_back({digits(mixture.velocity[k], 3), cell(mixture.average[0][k], 1.0, 3),
                          cell(mixture.average[1][k], 1.0, 3), cell(mixture.average[2][k], 1.0, 3),
                          cell(mixture.captured[k], 100.0, 0), cell(mixture.unseen[k], 100.0, 0)});
  }
  HtmlTable miss;
  miss.caption = "Distance of the points from each curve";
  miss.head = {"", "rms of <i>e</i>", "points with a prediction"};
  const auto add = [&](const std::string& name, const CurveMiss& at) {
    miss.rows.push_back(
        {escape_html(name), at.rmse ? digits(*at.rmse, 2) : "–", fmt::format("{}", at.points)});
  };
  add("d10 alone", mixture.miss_single);
  for (std::size_t c = 0; c < all_conventions.size(); ++c) {
    add(words_of(all_conventions[c]), mixture.miss[c]);
  }
  return table_html(miss) + table_html(table);
}

}  // namespace

std::string mixture_section(const Analysis& analysis) {
  std::string out;
  for (const PolydispersePrediction& mixture : analysis.mixtures) {
    std::vector<std::string> sentences;
    for (const std::string& words : mixture_words(analysis, mixture)) {
      sentences.push_back(as_sentence(words));
    }
    out += fmt::format("<p>{}</p>\n", prose_html(fmt::format("{}", fmt::join(sentences, " "))));
    out += figures_html(mixture_figures(analysis, mixture)) + table_of(mixture);
  }
  return out;
}

std::string capture_comparison_section(const Analysis& analysis) {
  const std::vector<Figure> figures = capture_comparison_figures(analysis);
  if (figures.empty()) return "";
  return "<p>" +
         prose_html(
             "What the older models make of the same system. They know nothing of these points but "
             "one restitution; their energies follow from the elastic constants and surface "
             "energies that the dataset states or that are estimated for it.") +
         "</p>\n" + figures_html(figures);
}

}  // namespace recoil
