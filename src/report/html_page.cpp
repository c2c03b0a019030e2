#include "report/html_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "document/html_style.hpp"

namespace recoil {
namespace {

bool word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '/' ||
         c == '.';
}

/// Replaces `word` where it stands alone: not inside an identifier, a path or a number.
void replace_word(std::string& text, std::string_view word, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos;) {
    const std::size_t end = at + word.size();
    const bool free_before = at == 0 || !word_character(text[at - 1]);
    const bool joined_after =
        end < text.size() && word_character(text[end]) &&
        !(text[end] == '.' && (end + 1 == text.size() || text[end + 1] == ' '));
    if (free_before && !joined_after) {
      text.replace(at, word.size(), by);
      at += by.size();
    } else {
      at = end;
    }
  }
}

}  // namespace

std::string prose_html(std::string_view text) {
  static const std::pair<std::string_view, std::string_view> symbols[] = {
      {"C_H", "<i>C</i><sub>H</sub>"},
      {"C_A", "<i>C</i><sub>A</sub>"},
      {"W_A", "<i>W</i><sub>A</sub>"},
      {"V_a", "<i>V</i><sub>a</sub>"},
      {"f0", "<i>f</i><sub>0</sub>"},
      {"a_eq", "<i>a</i><sub>eq</sub>"},
      {"um", "µm"},
      {"J/m2", "J/m²"},
      {"kg/m3", "kg/m³"}};
  std::string out = escape_html(text);
  for (const auto& [word, symbol] : symbols) replace_word(out, word, symbol);
  for (std::size_t at = 0; (at = out.find("+/-", at)) != std::string::npos;) {
    out.replace(at, 3, "±");
  }
  return out;
}

std::string parameter_html(const std::string& label) {
  const auto bracket = label.find('[');
  std::string out = prose_html(label.substr(0, bracket));
  if (bracket != std::string::npos) {
    std::string dataset = label.substr(bracket + 1);
    if (!dataset.empty() && dataset.back() == ']') dataset.pop_back();
    out += fmt::format(" <small>({})</small>", escape_html(dataset));
  }
  return out;
}

std::string table_html(const HtmlTable& table) {
  std::string out = fmt::format("<div class=\"wide\" tabindex=\"0\"><table{}>\n",
                                table.compact ? " class=\"compact\"" : "");
  const auto prose = [&](std::size_t column) {
    const bool is = std::find(table.words.begin(), table.words.end(), column) != table.words.end();
    return is ? " class=\"words\"" : "";
  };
  if (!table.caption.empty()) {
    out += fmt::format("<caption>{}</caption>\n", prose_html(table.caption));
  }
  if (!table.head.empty()) {
    out += "<thead><tr>";
    for (std::size_t i = 0; i < table.head.size(); ++i) {
      out += fmt::format("<th scope=\"col\"{}>{}</th>", prose(i), table.head[i]);
    }
    out += "</tr></thead>\n";
  }
  out += "<tbody>\n";
  for (const std::vector<std::string>& row : table.rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      out += i == 0 ? fmt::format("<th scope=\"row\">{}</th>", row[i])
                    : fmt::format("<td{}>{}</td>", prose(i), row[i]);
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table></div>\n";
}

std::string figures_html(std::vector<Figure> figures) {
  draw(figures);
  std::string out = fmt::format("<div class=\"figures{}\">\n",
                                figures.size() == 1 && !figures.front().large ? " single" : "");
  for (const Figure& figure : figures) {
    out += fmt::format(
        "<figure id=\"figure-{}\"{}><div class=\"picture\"{}>{}</div>\n<figcaption>{}</figcaption>"
        "</figure>\n",
        escape_html(figure.id), figure.large ? " class=\"large\"" : "",
        figure.large ? " tabindex=\"0\"" : "", figure.svg, prose_html(plain_text(figure.caption)));
  }
  return out + "</div>\n";
}

std::string provenance_html(const std::vector<std::pair<std::string, std::string>>& provenances) {
  std::string out;
  for (const auto& [label, sentence] : provenances) {
    out += fmt::format(
        "<aside class=\"provenance {0}\" aria-label=\"Provenance\"><strong>{0}</strong> "
        "<span>{1}</span></aside>\n",
        escape_html(label), prose_html(sentence));
  }
  return out;
}

std::string section_html(const std::string& id, const std::string& heading,
                         const std::string& body) {
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", escape_html(id),
                     prose_html(heading), body);
}

std::string page_html(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n"
      "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n{}"
      "<footer>recoil {}</footer>\n</body>\n</html>\n",
      escape_html(title), style_sheet(), body, escape_html(version()));
}

}  // namespace recoil
