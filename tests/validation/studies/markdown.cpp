#include "validation/studies/markdown.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace recoil {
namespace {

/// `text` with the characters replaced that mean something to Markdown wherever they stand; an
/// underscore inside a word means nothing.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (std::string_view("\\`*|<>[]").find(c) != std::string_view::npos) out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string run_markdown(const Run& run) {
  switch (run.kind) {
    case RunKind::text:
    case RunKind::symbol:
    case RunKind::unit:
      return escaped(run.text);
    case RunKind::plus_minus:
      return "±";
    case RunKind::exponent:
      return "^" + escaped(run.text);
    case RunKind::qualifier:
      return fmt::format(" ({})", escaped(run.text));
    case RunKind::strong:
      return fmt::format("**{}**", escaped(run.text));
    case RunKind::code:
      return fmt::format("`{}`", run.text);
    case RunKind::link:
      return fmt::format("[{}]({})", escaped(run.text), run.address);
  }
  return "";
}

std::string row_markdown(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

std::string table_markdown(const Table& full) {
  const Table table = without_empty_columns(full);
  std::vector<std::string> headings;
  std::vector<std::string> rule;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const TableColumn& column = table.columns[c];
    const std::string heading = markdown_of(column.heading);
    headings.push_back(column.unit.empty() ? heading
                                           : fmt::format("{} \\[{}\\]", heading, column.unit));
    rule.emplace_back(c == 0 || column.words ? "---" : "---:");
  }
  std::string out = table.caption.empty() ? "" : markdown_of(table.caption) + "\n\n";
  out += row_markdown(headings) + fmt::format("|{}|\n", fmt::join(rule, "|"));
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (const Cell& cell : row) cells.push_back(markdown_of(words_of_cell(cell)));
    out += row_markdown(cells);
  }
  return out + '\n';
}

struct MarkdownBlock {
  std::string operator()(const Paragraph& paragraph) const {
    return markdown_of(paragraph.text) + "\n\n";
  }
  std::string operator()(const List& list) const {
    std::string out;
    for (const Sentence& entry : list.entries) out += fmt::format("- {}\n", markdown_of(entry));
    return out + '\n';
  }
  std::string operator()(const Table& table) const { return table_markdown(table); }
  /// A file of Markdown shows pictures that stand beside it as ID.svg.
  std::string operator()(const Figures& figures) const {
    std::string out;
    for (const Figure& figure : figures.figures) {
      out += fmt::format("![{}]({}.svg)\n\n", markdown_of(figure.caption), figure.id);
    }
    return out;
  }
  std::string operator()(const Banner& banner) const {
    return fmt::format("> **{}**: {}\n\n", escaped(banner.label), markdown_of(banner.text));
  }
  std::string operator()(const Formula& formula) const { return formula.text + "\n\n"; }
  std::string operator()(const Remark& remark) const {
    return fmt::format("{} {}\n\n", remark.sign, markdown_of(remark.text));
  }
  std::string operator()(const Section& section) const {
    const std::string title =
        section.title.empty() ? "" : fmt::format("### {}\n\n", markdown_of(section.title));
    return title + markdown_of(section.blocks);
  }
};

}  // namespace

std::string markdown_of(const Sentence& sentence) {
  std::string out;
  for (const Run& run : sentence.runs()) out += run_markdown(run);
  return out;
}

std::string markdown_of(const std::vector<Block>& blocks) {
  std::string out;
  for (const Block& block : blocks) {
    if (!empty(block)) out += std::visit(MarkdownBlock{}, block.content());
  }
  return out;
}

std::string markdown_page(const Document& document) {
  std::string out = fmt::format("# {}\n\n", markdown_of(document.heading));
  if (!document.subtitle.empty()) out += markdown_of(document.subtitle) + "\n\n";
  out += markdown_of(document.foreword);
  for (const Section& section : document.sections) {
    if (empty(section)) continue;
    out += fmt::format("## {}\n\n", markdown_of(section.title));
    if (!section.remark.empty()) out += markdown_of(section.remark) + "\n\n";
    out += markdown_of(section.blocks);
  }
  while (out.ends_with("\n\n")) out.pop_back();
  return out;
}

}  // namespace recoil
