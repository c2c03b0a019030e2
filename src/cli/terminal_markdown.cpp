#include "cli/terminal_markdown.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace recoil {
namespace {

using Cells = std::vector<std::string>;

constexpr std::size_t least_column = 8;
constexpr std::size_t longest_undivided = 40;
constexpr std::string_view column_gap = "  ";

bool starts_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

/// Columns that a UTF-8 text takes: its code points.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; }));
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
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

/// Where a word that is too long for a line is divided: after the last comma or point that fits.
std::size_t division(std::string_view word, std::size_t width) {
  const std::size_t after = word.substr(0, width).find_last_of(",./");
  return after == std::string_view::npos || after < width / 2 ? width : after + 1;
}

/// Words of `text` in lines of at most `width` columns; a longer word is divided.
std::vector<std::string> filled(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  std::string line;
  while (true) {
    text = trimmed(text);
    if (text.empty()) break;
    const bool too_long = width_of(text.substr(0, text.find(' '))) > width && width > 1;
    const std::string_view word =
        text.substr(0, too_long && line.empty() ? division(text, width) : text.find(' '));
    if (!line.empty() && width_of(line) + 1 + width_of(word) > width) {
      lines.push_back(std::move(line));
      line.clear();
      continue;
    }
    text.remove_prefix(word.size());
    line += (line.empty() ? "" : " ") + std::string(word);
  }
  if (!line.empty()) lines.push_back(std::move(line));
  return lines;
}

std::size_t longest_word(std::string_view text) {
  std::size_t longest = 0;
  for (const std::string& word : filled(text, 1)) longest = std::max(longest, width_of(word));
  return longest;
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

/// Natural widths where they fit; otherwise the widest columns give way, but not below a column of
/// some words or their longest word.
std::vector<std::size_t> column_widths(const std::vector<Cells>& rows, std::size_t width) {
  std::vector<std::size_t> natural, least;
  for (const Cells& row : rows) {
    natural.resize(std::max(natural.size(), row.size()), 0);
    least.resize(natural.size(), least_column);
    for (std::size_t i = 0; i < row.size(); ++i) {
      natural[i] = std::max(natural[i], width_of(row[i]));
      least[i] = std::clamp(longest_word(row[i]), least[i], longest_undivided);
    }
  }
  const auto total = [&] {
    return std::accumulate(natural.begin(), natural.end(), std::size_t{0}) +
           column_gap.size() * natural.size();
  };
  while (total() > width + column_gap.size()) {
    std::size_t widest = natural.size();
    for (std::size_t i = 0; i < natural.size(); ++i) {
      if (natural[i] <= least[i]) continue;
      if (widest == natural.size() || natural[i] > natural[widest]) widest = i;
    }
    if (widest == natural.size()) break;  // nothing gives way any more
    --natural[widest];
  }
  return natural;
}

std::string without_trailing_blanks(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

std::string table_text(const std::vector<Cells>& rows, std::size_t width) {
  const std::vector<std::size_t> widths = column_widths(rows, width);
  const bool wraps = std::any_of(rows.begin(), rows.end(), [&](const Cells& row) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (width_of(row[i]) > widths[i]) return true;
    }
    return false;
  });
  std::string out;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::vector<std::vector<std::string>> columns;
    std::size_t height = 1;
    for (std::size_t i = 0; i < rows[r].size(); ++i) {
      columns.push_back(filled(rows[r][i], widths[i]));
      height = std::max(height, columns.back().size());
    }
    for (std::size_t k = 0; k < height; ++k) {
      std::string line;
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::string cell = k < columns[i].size() ? columns[i][k] : std::string();
        line += cell + std::string(widths[i] - std::min(widths[i], width_of(cell)), ' ');
        line += column_gap;
      }
      out += without_trailing_blanks(line) + "\n";
    }
    if (r == 0) {
      std::string rule;
      for (const std::size_t column : widths) rule += std::string(column, '-') + "  ";
      out += without_trailing_blanks(rule) + "\n";
    } else if (wraps && r + 1 < rows.size()) {
      out += "\n";
    }
  }
  return out;
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
  Renderer(std::string_view markdown, std::size_t width)
      : lines_(lines_of(markdown)), width_(width) {}

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
    out_ += table_text(rows, width_);
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
    std::string text = joined_lines();
    std::string indent = mark;
    for (const std::string& line : filled(plain(text), width_ - bullet)) {
      out_ += indent + line + "\n";
      indent.assign(bullet, ' ');
    }
    in_list_ = true;
  }

  void paragraph() {
    begin_block();
    const std::size_t before = at_;
    for (const std::string& line : filled(plain(joined_lines()), width_)) out_ += line + "\n";
    if (at_ == before) ++at_;
  }

  std::vector<std::string> lines_;
  std::size_t width_;
  std::size_t at_ = 0;
  bool in_list_ = false;
  std::string out_;
};

}  // namespace

std::string terminal_text(std::string_view markdown, std::size_t width) {
  return Renderer(markdown, width).text();
}

}  // namespace recoil
