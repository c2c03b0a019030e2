#include "cli/terminal_markdown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "data/text.hpp"
#include "document/terminal.hpp"

namespace recoil {
namespace {

using Cells = std::vector<std::string>;

bool starts_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

/// Columns that a UTF-8 text takes: its code points.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; }));
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// A link's target as a reader of a terminal can follow it.
std::string followed(std::string_view label, std::string_view target) {
  const std::size_t ending = target.find(".md");
  const bool page = target.find('/') == std::string_view::npos && ending != std::string_view::npos;
  if (page) {
    const std::string_view topic = target.substr(0, ending);
    return label == topic ? fmt::format("recoil help {}", topic)
                          : fmt::format("{} (recoil help {})", label, topic);
  }
  if (starts_with(target, "#") || label == target) return std::string(label);
  while (starts_with(target, "../")) target.remove_prefix(3);
  return fmt::format("{} ({})", label, target);
}

/// Without the marks of links, pictures and emphasis. Code keeps its backticks.
std::string plain(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '`') {
      const std::size_t end = text.find('`', i + 1);
      if (end == std::string_view::npos) break;
      out += text.substr(i, end - i + 1);
      i = end;
      continue;
    }
    if (text[i] == '\\' && i + 1 < text.size()) {
      out += text[++i];
      continue;
    }
    if (text[i] == '*') continue;
    const bool picture = text[i] == '!' && i + 1 < text.size() && text[i + 1] == '[';
    if (text[i] == '[' || picture) {
      const std::size_t open = i + (picture ? 1 : 0);
      const std::size_t middle = text.find("](", open);
      const std::size_t end = text.find(')', middle);
      if (middle != std::string_view::npos && end != std::string_view::npos) {
        const std::string label = plain(text.substr(open + 1, middle - open - 1));
        out += followed(label, text.substr(middle + 2, end - middle - 2));
        i = end;
        continue;
      }
    }
    out += text[i];
  }
  return out;
}

bool is_table_row(std::string_view line) { return starts_with(line, "|"); }

bool is_rule(const Cells& row) {
  return std::all_of(row.begin(), row.end(), [](const std::string& cell) {
    return !cell.empty() && cell.find_first_not_of("-: ") == std::string::npos;
  });
}

/// The cells of "| a | b |"; a bar within code or after a backslash is none of the borders.
Cells cells_of(std::string_view line) {
  Cells cells;
  std::string cell;
  bool code = false;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '`') code = !code;
    if (line[i] == '\\' && i + 1 < line.size() && line[i + 1] == '|') {
      cell += line[++i];
    } else if (line[i] == '|' && !code) {
      cells.push_back(plain(trimmed(cell)));
      cell.clear();
    } else {
      cell += line[i];
    }
  }
  return cells;
}

Table table_of(const std::vector<Cells>& rows) {
  Table table;
  for (const std::string& heading : rows.front()) {
    table.columns.push_back({.heading = heading, .words = true});
  }
  for (std::size_t r = 1; r < rows.size(); ++r) {
    std::vector<Cell> cells;
    for (const std::string& text : rows[r])
      cells.push_back(text.empty() ? Cell(Sentence(" ")) : Cell(Sentence(text)));
    cells.resize(table.columns.size());
    table.rows.push_back(std::move(cells));
  }
  return table;
}

/// How far "- text", "* text" or "1. text" indents what belongs to it; 0 for other lines.
std::size_t bullet_width(std::string_view line) {
  if (starts_with(line, "- ") || starts_with(line, "* ")) return 2;
  const std::size_t digits = line.find_first_not_of("0123456789");
  if (digits != 0 && digits != std::string_view::npos && starts_with(line.substr(digits), ". ")) {
    return digits + 2;
  }
  return 0;
}

class Renderer {
 public:
  explicit Renderer(std::string_view markdown) : lines_(lines_of(markdown)) {}

  std::string text() {
    while (at_ < lines_.size()) {
      const std::string_view line = lines_[at_];
      if (trimmed(line).empty()) {
        ++at_;
      } else if (starts_with(line, "<!--")) {
        comment();
      } else if (starts_with(line, "#")) {
        heading();
      } else if (starts_with(line, "```")) {
        fenced_code();
      } else if (starts_with(line, "    ")) {
        indented_code();
      } else if (is_table_row(line)) {
        table();
      } else if (const std::size_t bullet = bullet_width(line); bullet > 0) {
        item(bullet);
      } else {
        paragraph();
      }
    }
    return out_;
  }

 private:
  void begin_block() {
    if (!out_.empty()) out_ += "\n";
    in_list_ = false;
  }

  void comment() {
    while (at_ < lines_.size() && lines_[at_].find("-->") == std::string::npos) ++at_;
    ++at_;
  }

  void heading() {
    begin_block();
    const std::string& line = lines_[at_++];
    const std::size_t depth = line.find_first_not_of('#');
    const std::string title = plain(trimmed(std::string_view(line).substr(depth)));
    out_ += title + "\n";
    if (depth <= 2) out_ += std::string(width_of(title), depth == 1 ? '=' : '-') + "\n";
  }

  void fenced_code() {
    begin_block();
    for (++at_; at_ < lines_.size() && !starts_with(lines_[at_], "```"); ++at_) {
      out_ += lines_[at_].empty() ? "\n" : "    " + lines_[at_] + "\n";
    }
    ++at_;
  }

  void indented_code() {
    begin_block();
    for (; at_ < lines_.size() && starts_with(lines_[at_], "    "); ++at_) {
      out_ += lines_[at_] + "\n";
    }
  }

  void table() {
    begin_block();
    std::vector<Cells> rows;
    for (; at_ < lines_.size() && is_table_row(lines_[at_]); ++at_) {
      const Cells row = cells_of(lines_[at_]);
      if (!is_rule(row)) rows.push_back(row);
    }
    if (!rows.empty()) out_ += terminal_text(table_of(rows), 0);
  }

  /// The lines from here that continue a paragraph, joined.
  std::string joined_lines() {
    std::string text;
    for (; at_ < lines_.size(); ++at_) {
      const std::string_view line = trimmed(lines_[at_]);
      const bool ends = line.empty() || starts_with(line, "```") || starts_with(line, "<!--") ||
                        is_table_row(line) || starts_with(line, "#");
      if (ends || (!text.empty() && bullet_width(line) > 0)) break;
      text += (text.empty() ? "" : " ") + std::string(line);
    }
    return text;
  }

  void item(std::size_t bullet) {
    if (!in_list_) begin_block();
    const std::string mark = lines_[at_].substr(0, bullet);
    lines_[at_] = lines_[at_].substr(bullet);
    out_ += mark + wrap(plain(joined_lines()), terminal_columns, bullet) + "\n";
    in_list_ = true;
  }

  void paragraph() {
    begin_block();
    const std::size_t before = at_;
    out_ += wrap(plain(joined_lines()), terminal_columns, 0) + "\n";
    if (at_ == before) ++at_;
  }

  std::vector<std::string> lines_;
  std::size_t at_ = 0;
  bool in_list_ = false;
  std::string out_;
};

}  // namespace

std::string terminal_markdown(std::string_view markdown) { return Renderer(markdown).text(); }

}  // namespace recoil
