#include "document/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>

#include "core/json.hpp"
#include "plot/draw.hpp"

namespace recoil {
namespace {

/// A symbol such as C_H, f0 or V* as an italic letter with an upright subscript. Longer names are
/// not changed.
std::string symbol_html(const std::string& name) {
  const std::string star = name.ends_with('*') ? "*" : "";
  const std::string stem = name.substr(0, name.size() - star.size());
  const std::size_t underscore = stem.find('_');
  const std::size_t digit = stem.find_first_of("0123456789");
  const std::size_t base = std::min(underscore, digit);
  const auto italic = [&](const std::string& letter) {
    return fmt::format("<i>{}</i>", escape_html(letter));
  };
  if (stem.size() == 1) return italic(stem) + star;
  if (base != 1) return escape_html(name);
  std::string below = stem.substr(underscore == 1 ? 2 : 1);
  std::replace(below.begin(), below.end(), '_', ' ');
  return fmt::format("{}<sub>{}</sub>{}", italic(stem.substr(0, 1)), escape_html(below), star);
}

/// A unit with µ and superscripts: µm for um, m² for m2.
std::string unit_html(const std::string& name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool starts = i == 0 || name[i - 1] == '/' || name[i - 1] == ' ';
    if (name[i] == 'u' && starts && i + 1 < name.size()) {
      out += "µ";
    } else if (name[i] == '^') {
      continue;
    } else if (name[i] == '2' && i > 0) {
      out += "²";
    } else if (name[i] == '3' && i > 0) {
      out += "³";
    } else {
      out += escape_html(std::string_view(name).substr(i, 1));
    }
  }
  return out;
}

bool belongs_to_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
}

/// A number such as 5e-15 at the start of a text.
struct PowerOfTen {
  std::string_view mantissa;
  int exponent = 0;
  std::size_t length = 0;  ///< number of its characters; 0: the text does not start with one
};

PowerOfTen power_of_ten(std::string_view text) {
  const std::size_t e = text.find_first_not_of("0123456789.");
  if (e == 0 || e == std::string_view::npos || text[e] != 'e') return {};
  const bool sign = e + 1 < text.size() && (text[e + 1] == '-' || text[e + 1] == '+');
  const std::size_t from = e + (sign ? 2 : 1);
  const std::size_t end = std::min(text.find_first_not_of("0123456789", from), text.size());
  constexpr std::size_t most_digits = 3;
  if (end == from || end > from + most_digits) return {};
  if (end < text.size() && text[end] != '.' && belongs_to_word(text[end])) return {};
  const int power = std::stoi(std::string(text.substr(from, end - from)));
  return {text.substr(0, e), text[e + 1] == '-' ? -power : power, end};
}

/// Plain text as HTML. 5e-15 becomes a power of ten; after a number, um becomes µm, J/m2 becomes
/// J/m², and +/- becomes ±.
std::string text_html(std::string_view text) {
  using Replacement = std::pair<std::string_view, std::string_view>;
  static constexpr std::array<Replacement, 5> behind_numbers = {
      {{"um", "µm"}, {"J/m2", "J/m²"}, {"kg/m3", "kg/m³"}, {"m/s2", "m/s²"}, {"+/-", "±"}}};
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    const bool minus = i > 0 && text[i - 1] == '-' && (i == 1 || !belongs_to_word(text[i - 2]));
    const bool word_begins = i == 0 || minus || !belongs_to_word(text[i - 1]);
    if (word_begins) {
      if (const PowerOfTen found = power_of_ten(rest); found.length > 0) {
        out += fmt::format("{}10<sup>{}{}</sup>",
                           found.mantissa == "1" ? "" : fmt::format("{} × ", found.mantissa),
                           found.exponent < 0 ? "−" : "", std::abs(found.exponent));
        i += found.length;
        continue;
      }
    }
    if (i > 0 && text[i - 1] == ')' && rest.front() == 'e') {  // (1.2 +/- 0.3)e-5
      if (const PowerOfTen found = power_of_ten("1" + std::string(rest)); found.length > 0) {
        out += fmt::format(" × 10<sup>{}{}</sup>", found.exponent < 0 ? "−" : "",
                           std::abs(found.exponent));
        i += found.length - 1;
        continue;
      }
    }
    const bool behind_number =
        i > 1 && text[i - 1] == ' ' && std::isdigit(static_cast<unsigned char>(text[i - 2])) != 0;
    const auto* const sign = std::ranges::find_if(behind_numbers, [&](const Replacement& one) {
      const std::size_t end = one.first.size();
      return rest.starts_with(one.first) &&
             (end == rest.size() || rest[end] == '.' || !belongs_to_word(rest[end]));
    });
    if (behind_number && sign != behind_numbers.end()) {
      out += sign->second;
      i += sign->first.size();
    } else {
      out += escape_html(rest.substr(0, 1));
      ++i;
    }
  }
  return out;
}

std::string run_html(const Run& run) {
  switch (run.kind) {
    case RunKind::text:
      return text_html(run.text);
    case RunKind::symbol:
      return symbol_html(run.text);
    case RunKind::unit:
      return unit_html(run.text);
    case RunKind::plus_minus:
      return "±";
    case RunKind::exponent:
      return fmt::format("<sup>{}</sup>", escape_html(run.text));
    case RunKind::qualifier:
      return fmt::format(" <small>({})</small>", escape_html(run.text));
    case RunKind::strong:
      return fmt::format("<strong>{}</strong>", text_html(run.text));
    case RunKind::code:
      return fmt::format("<code>{}</code>", escape_html(run.text));
    case RunKind::link:
      return fmt::format("<a href=\"{}\">{}</a>", escape_html(run.address), escape_html(run.text));
  }
  return "";
}

std::string heading_html(const TableColumn& column) {
  return column.unit.empty()
             ? html_of(column.heading)
             : fmt::format("{} [{}]", html_of(column.heading), unit_html(column.unit));
}

/// True if a cell of the column is long enough to be wrapped.
bool has_long_cells(const Table& table, std::size_t column) {
  constexpr std::size_t few = 32;
  return std::ranges::any_of(table.rows, [&](const auto& row) {
    return plain_text(words_of_cell(row[column])).size() > few;
  });
}

/// On a narrow screen each row of a wide table becomes a list, in which every cell has a label: the
/// heading of its column.
std::string table_html(const Table& full, bool labels) {
  constexpr std::size_t widest = 3;  // columns that a narrow screen shows side by side
  const Table table = without_empty_columns(full);
  const bool stacks = labels && table.has_headings() && table.columns.size() > widest;
  const std::string look_of_table =
      fmt::format("{}{}", table.compact ? "compact" : "", stacks ? " stack" : "");
  std::string out =
      fmt::format("<div class=\"wide\"><table{}>\n",
                  look_of_table.empty() ? "" : fmt::format(" class=\"{}\"", look_of_table));
  if (!table.caption.empty()) out += fmt::format("<caption>{}</caption>\n", html_of(table.caption));
  const auto look = [&](std::size_t c) {
    if (!table.columns[c].words) return "";
    return has_long_cells(table, c) ? " class=\"words prose\"" : " class=\"words\"";
  };
  const auto label = [&](std::size_t c, const std::string& cell) {
    const std::string heading = heading_html(table.columns[c]);
    return stacks && !cell.empty() && !heading.empty()
               ? fmt::format("<span class=\"label\">{}</span>", heading)
               : "";
  };
  if (table.has_headings()) {
    out += "<thead><tr>";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      out += fmt::format("<th scope=\"col\"{}>{}</th>", look(c), heading_html(table.columns[c]));
    }
    out += "</tr></thead>\n";
  }
  out += "<tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string cell = html_of(words_of_cell(row[c]));
      out += c == 0 ? fmt::format("<th scope=\"row\">{}</th>", cell)
                    : fmt::format("<td{}>{}{}</td>", look(c), label(c, cell), cell);
    }
    out += "</tr>\n";
  }
  return out + "</tbody>\n</table></div>\n";
}

/// A script element that holds JSON. "<" is escaped, so that the JSON cannot end the element.
std::string data_html(std::string_view look, const std::string& json) {
  std::string safe;
  for (const char c : json) safe += c == '<' ? "\\u003c" : std::string(1, c);
  return fmt::format("<script type=\"application/json\" class=\"{}\">{}</script>\n", look, safe);
}

/// The data of a figure for the scripts of the page: its CSV and the JSON of its controls.
std::string data_of_figure(const Figure& figure) {
  const std::string csv = figure.csv.empty() ? plot::csv_of(figure.picture) : figure.csv;
  return (csv.empty() ? "" : data_html("csv", json_line(csv))) +
         (figure.explored.empty() ? "" : data_html("explore", figure.explored));
}

std::string figure_html(const Figure& figure) {
  const std::string svg = figure.svg.empty() ? plot::draw_svg(figure.picture) : figure.svg;
  if (figure.caption.empty()) {
    return fmt::format("<div class=\"picture\">{}</div>\n{}", svg, data_of_figure(figure));
  }
  return fmt::format(
      "<figure id=\"figure-{}\"><div class=\"picture\">{}</div>\n<figcaption>{}</figcaption>\n{}"
      "</figure>\n",
      escape_html(figure.id), svg, html_of(figure.caption), data_of_figure(figure));
}

std::string figures_html(const std::vector<Figure>& figures) {
  if (figures.size() == 1 && figures.front().caption.empty()) return figure_html(figures.front());
  std::string out =
      fmt::format("<div class=\"figures{}\">\n", figures.size() == 1 ? " single" : "");
  for (const Figure& figure : figures) out += figure_html(figure);
  return out + "</div>\n";
}

struct HtmlBlock {
  bool labels = true;

  std::string operator()(const Paragraph& paragraph) const {
    return fmt::format("<p{}>{}</p>\n", paragraph.lead ? " class=\"summary\"" : "",
                       html_of(paragraph.text));
  }
  std::string operator()(const List& list) const {
    std::string out = "<ul>\n";
    for (const Sentence& entry : list.entries) out += fmt::format("<li>{}</li>\n", html_of(entry));
    return out + "</ul>\n";
  }
  std::string operator()(const Table& table) const { return table_html(table, labels); }
  std::string operator()(const Figures& figures) const { return figures_html(figures.figures); }
  std::string operator()(const Banner& banner) const {
    const std::string label = escape_html(banner.label);
    return fmt::format(
        "<aside class=\"banner {0}\" aria-label=\"{0}\"><strong>{0}</strong> "
        "<span>{1}</span></aside>\n",
        label, html_of(banner.text));
  }
  std::string operator()(const Formula& formula) const {
    return fmt::format(
        "<p class=\"formula\" tabindex=\"0\"><math display=\"block\" "
        "alttext=\"{}\">{}</math></p>\n",
        escape_html(formula.text), formula.mathml);
  }
  std::string operator()(const Remark& remark) const {
    return fmt::format(
        "<p class=\"verdict {}\"><span class=\"mark\" aria-hidden=\"true\">{}</span> {}</p>\n",
        escape_html(remark.look), escape_html(remark.sign), html_of(remark.text));
  }
};

std::string titled(const Section& section) {
  const std::string title = html_of(section.title);
  return section.address.empty()
             ? title
             : fmt::format("<a href=\"{}\">{}</a>", escape_html(section.address), title);
}

std::string remark_html(const Section& section) {
  return section.remark.empty()
             ? ""
             : fmt::format("<p class=\"subtitle\">{}</p>\n", html_of(section.remark));
}

std::string section_html(const Section& section) {
  const std::string id = escape_html(section.id);
  const std::string body = remark_html(section) + html_of(section.blocks);
  if (section.importance == Importance::detail) {
    return fmt::format(
        "<details class=\"section\" id=\"{}\">\n<summary><h2>{}</h2></summary>\n{}</details>\n", id,
        titled(section), body);
  }
  const std::string heading =
      section.title.empty() ? "" : fmt::format("<h2>{}</h2>\n", titled(section));
  return fmt::format("<section id=\"{}\">\n{}{}</section>\n", id, heading, body);
}

std::string card_html(const Section& section) {
  return fmt::format("<article class=\"card\" id=\"{}\">\n<h2>{}</h2>\n{}{}</article>\n",
                     escape_html(section.id), titled(section), remark_html(section),
                     html_of(section.blocks));
}

bool has_details(const Document& document) {
  return std::ranges::any_of(document.sections, [](const Section& section) {
    return section.importance == Importance::detail;
  });
}

/// Links to the sections; empty for pages of cards and for pages with folded sections.
std::string contents_html(const Document& document) {
  if (document.cards || has_details(document)) return "";
  std::string out;
  for (const Section& section : document.sections) {
    if (empty(section) || section.id.empty()) continue;
    out += fmt::format("<a href=\"#{}\">{}</a> ", escape_html(section.id), html_of(section.title));
  }
  return out.empty() ? "" : fmt::format("<nav aria-label=\"Contents\">{}</nav>\n", out);
}

}  // namespace

std::string escape_html(std::string_view text) { return plot::escape_xml(text); }

std::string html_of(const Sentence& sentence) {
  std::string out;
  for (const Run& run : sentence.runs()) out += run_html(run);
  return out;
}

std::string html_of(const Blocks& blocks, bool labels) {
  std::string out;
  for (const Block& block : blocks) {
    if (!empty(block)) out += std::visit(HtmlBlock{labels}, block.content());
  }
  return out;
}

std::string html_of(const std::vector<Section>& sections) {
  std::string out;
  for (const Section& section : sections) {
    if (empty(section)) continue;
    if (!section.title.empty()) out += fmt::format("<h3>{}</h3>\n", titled(section));
    out += html_of(section.blocks, false);
  }
  return out;
}

std::string html_page(const Document& document) {
  std::string head = fmt::format("<header>\n<h1>{}</h1>\n", html_of(document.heading));
  if (!document.subtitle.empty()) {
    head += fmt::format("<p class=\"subtitle\">{}</p>\n", html_of(document.subtitle));
  }
  head += html_of(document.foreword);
  head += contents_html(document);
  std::string answer, details;
  for (const Section& section : document.sections) {
    if (empty(section)) continue;
    std::string& part = section.importance == Importance::answer ? answer : details;
    part += document.cards ? card_html(section) : section_html(section);
  }
  if (!details.empty()) answer = "<div class=\"answer\">\n" + answer + "</div>\n";
  const std::string body = answer + details;
  // Only pages with pictures need scripts.
  const bool pictures = body.find("<svg ") != std::string::npos;
  const std::string scripts =
      pictures ? fmt::format("<script type=\"text/javascript\">\n{}{}</script>\n", save_script(),
                             document.script)
               : "";
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      // Forbids all network access, whatever the data contain.
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
      "base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n"
      "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body{}>\n<a class=\"skip\" "
      "href=\"#main\">Skip to the result</a>\n{}</header>\n"
      "<main id=\"main\"{}>\n{}</main>\n<footer>{}</footer>\n{}</body>\n</html>\n",
      escape_html(document.title), style_sheet(),
      document.name.empty() ? "" : fmt::format(" data-name=\"{}\"", escape_html(document.name)),
      head, document.cards ? " class=\"cards\"" : "", body, escape_html(document.foot), scripts);
}

}  // namespace recoil
