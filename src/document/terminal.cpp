#include "document/terminal.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace recoil {
namespace {

constexpr std::size_t margin = 4;
constexpr std::size_t gap = 2;           // between columns
constexpr std::size_t widest_name = 36;  // in a list of names and values
constexpr std::size_t narrowest_name = 19;
constexpr std::size_t narrowest_words = 24;  // width of a column of text
constexpr std::size_t longest_uncut = 50;    // a word up to this length is not cut
constexpr std::size_t widest_heading = 30;   // of a row, in a table that is printed in groups

bool starts_code_point(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

std::size_t code_points(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, starts_code_point));
}

/// The index of the byte after `count` code points.
std::size_t cut_position(std::string_view text, std::size_t count) {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (starts_code_point(text[i]) && seen++ == count) return i;
  }
  return text.size();
}

std::size_t longest_word(std::string_view text) {
  std::size_t longest = 0;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    longest = std::max(longest, code_points(text.substr(at, end - at)));
    at = end + 1;
  }
  return longest;
}

std::string padded_to(const std::string& text, std::size_t width, bool right) {
  const std::size_t own = code_points(text);
  const std::string blanks(width > own ? width - own : 0, ' ');
  return right ? blanks + text : text + blanks;
}

/// The texts of a table and the widths of its columns.
struct Layout {
  std::vector<std::string> headings;
  std::vector<std::vector<std::string>> rows;
  std::vector<bool> left;  ///< the column is aligned left and wrapped
  std::vector<std::size_t> width;

  std::size_t total() const {
    return std::accumulate(width.begin(), width.end(), std::size_t{0}) + gap * (width.size() - 1);
  }
};

/// The text of a cell, with "-" for an empty one.
std::string cell_text(const Cell& cell) {
  const std::string text = plain_text(words_of_cell(cell));
  return text == "–" ? "-" : text;
}

std::string heading_of(const TableColumn& column) {
  const std::string heading = plain_text(column.heading);
  return column.unit.empty() ? heading : fmt::format("{} [{}]", heading, column.unit);
}

Layout layout_of(const Table& table) {
  Layout layout;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    layout.headings.push_back(heading_of(table.columns[c]));
    layout.left.push_back(c == 0 || table.columns[c].words);
    layout.width.push_back(code_points(layout.headings.back()));
  }
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (std::size_t c = 0; c < row.size(); ++c) {
      std::string text = cell_text(row[c]);
      layout.width[c] = std::max(layout.width[c], code_points(text));
      cells.push_back(std::move(text));
    }
    layout.rows.push_back(std::move(cells));
  }
  return layout;
}

/// Wraps headings, then columns of text, until the table is no wider than `room`.
void narrow(Layout& layout, std::size_t room) {
  if (layout.total() <= room) return;
  std::vector<std::size_t> least(layout.width.size(), narrowest_words);
  for (std::size_t c = 0; c < layout.width.size(); ++c) {
    std::size_t cells = longest_word(layout.headings[c]);
    for (const auto& row : layout.rows) {
      cells = std::max(cells, code_points(row[c]));
      least[c] = std::max(least[c], std::min(longest_word(row[c]), longest_uncut));
    }
    layout.width[c] = cells;
  }
  while (layout.total() > room) {
    std::size_t widest = layout.width.size();
    for (std::size_t c = 0; c < layout.width.size(); ++c) {
      const bool shrinks = layout.left[c] && layout.width[c] > least[c];
      if (shrinks && (widest == layout.width.size() || layout.width[c] > layout.width[widest])) {
        widest = c;
      }
    }
    if (widest == layout.width.size()) return;
    --layout.width[widest];  // one at a time, so that the columns of text become about equally wide
  }
}

/// Groups of columns. Each begins with the first column and fits into `room`.
std::vector<std::vector<std::size_t>> groups_of(const Layout& layout, std::size_t room) {
  std::vector<std::vector<std::size_t>> groups = {{0}};
  std::size_t used = layout.width[0];
  for (std::size_t c = 1; c < layout.width.size(); ++c) {
    if (used + gap + layout.width[c] > room && groups.back().size() > 1) {
      groups.push_back({0});
      used = layout.width[0];
    }
    groups.back().push_back(c);
    used += gap + layout.width[c];
  }
  return groups;
}

std::string row_text(const Layout& layout, const std::vector<std::string>& cells,
                     const std::vector<std::size_t>& columns, std::size_t indent, bool heading) {
  std::vector<std::vector<std::string>> lines;
  std::size_t height = 0;
  for (const std::size_t c : columns) {
    lines.push_back(lines_of(wrap(cells[c], std::max<std::size_t>(layout.width[c], 1), 0)));
    height = std::max(height, lines.back().size());
  }
  std::string out;
  for (std::size_t l = 0; l < height; ++l) {
    std::string line(indent, ' ');
    for (std::size_t k = 0; k < columns.size(); ++k) {
      // Headings are aligned at the bottom, cells at the top.
      const std::size_t first = heading ? height - lines[k].size() : 0;
      const std::string text = l >= first && l - first < lines[k].size() ? lines[k][l - first] : "";
      if (k > 0) line.append(gap, ' ');
      line += padded_to(text, layout.width[columns[k]], !layout.left[columns[k]]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  }
  return out;
}

std::string items_text(const Table& table, std::size_t indent, std::size_t columns) {
  std::size_t width = narrowest_name;
  for (const auto& row : table.rows) {
    const std::size_t own = code_points(plain_text(words_of_cell(row[0])));
    if (own <= widest_name) width = std::max(width, own + 1);
  }
  std::string out;
  for (const auto& row : table.rows) {
    const std::string name = plain_text(words_of_cell(row[0]));
    out += std::string(indent, ' ');
    out += code_points(name) < width
               ? padded_to(name, width, false)
               : wrap(name, columns, indent) + '\n' + std::string(indent + width, ' ');
    out += "= " + wrap(cell_text(row[1]), columns, indent + width + 2) + '\n';
  }
  return out;
}

std::string paragraph_text(const Sentence& words, std::size_t indent, std::size_t columns) {
  return std::string(indent, ' ') + wrap(plain_text(words), columns, indent) + '\n';
}

struct TerminalBlock {
  std::size_t columns;

  std::string operator()(const Paragraph& paragraph) const {
    return paragraph_text(paragraph.text, margin, columns);
  }
  std::string operator()(const List& list) const {
    std::string out;
    for (const Sentence& entry : list.entries) {
      out += fmt::format("    - {}\n", wrap(plain_text(entry), columns, margin + 2));
    }
    return out;
  }
  std::string operator()(const Table& table) const { return terminal_text(table, margin, columns); }
  std::string operator()(const Figures&) const { return ""; }
  std::string operator()(const Banner& banner) const {
    const std::string text = plain_text(banner.text);
    const bool named = text.find(banner.label) != std::string::npos;
    return paragraph_text(named ? text : fmt::format("{}: {}", banner.label, text), margin,
                          columns);
  }
  std::string operator()(const Formula& formula) const {
    return paragraph_text(formula.text, margin, columns);
  }
  std::string operator()(const Remark& remark) const {
    return paragraph_text(Sentence(remark.sign + " ") + remark.text, margin, columns);
  }
};

}  // namespace

std::size_t output_columns() {
  constexpr std::size_t fewest = 60;
  winsize window{};
  std::size_t columns = 0;
  if (const char* const stated = std::getenv("COLUMNS")) {
    columns = std::strtoul(stated, nullptr, 10);
  } else if (isatty(STDOUT_FILENO) == 1 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0) {
    columns = window.ws_col;
  }
  return columns == 0 ? most_columns : std::clamp(columns, fewest, most_columns);
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string wrap(std::string_view text, std::size_t width, std::size_t indent) {
  std::string out;
  std::size_t column = indent;
  const auto break_line = [&] {
    out += '\n';
    out.append(indent, ' ');
    column = indent;
  };
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t start = text.find_first_not_of(" \t\r\n", at);
    if (start == std::string_view::npos) break;
    std::size_t end = text.find_first_of(" \t\r\n", start);
    if (end == std::string_view::npos) end = text.size();
    std::string_view word = text.substr(start, end - start);
    at = end;
    std::size_t length = code_points(word);
    const bool first = out.empty();
    if (!first && column + 1 + length > width) {
      break_line();
    } else if (!first) {
      out += ' ';
      ++column;
    }
    while (column + length > width) {
      const std::size_t cut = cut_position(word, width - column);
      out += word.substr(0, cut);
      word.remove_prefix(cut);
      length -= std::min(length, width - column);
      break_line();
    }
    out += word;
    column += length;
  }
  return out;
}

std::string terminal_text(const Table& table, std::size_t indent, std::size_t columns) {
  const Table shown = without_empty_columns(table);
  if (shown.empty()) return "";
  std::string out = shown.caption.empty() ? "" : paragraph_text(shown.caption, indent, columns);
  if (!shown.has_headings() && shown.columns.size() == 2)
    return out + items_text(shown, indent, columns);
  const std::size_t room = columns - indent;
  Layout layout = layout_of(shown);
  narrow(layout, room);
  if (layout.total() > room) layout.width[0] = std::min(layout.width[0], widest_heading);
  for (std::size_t c = 1; c < layout.width.size(); ++c) {
    layout.width[c] = std::min(layout.width[c], room - layout.width[0] - gap);
  }
  for (const std::vector<std::size_t>& group : groups_of(layout, room)) {
    if (shown.has_headings()) out += row_text(layout, layout.headings, group, indent, true);
    for (const auto& row : layout.rows) out += row_text(layout, row, group, indent, false);
  }
  return out;
}

std::string terminal_text(const Section& section, std::size_t columns) {
  std::string body;
  for (const Block& block : section.blocks) {
    if (!empty(block)) body += std::visit(TerminalBlock{columns}, block.content());
  }
  if (body.empty()) return "";
  if (section.title.empty()) return body;
  const std::string remark = section.remark.empty() ? "" : " " + plain_text(section.remark);
  return wrap(fmt::format("[[{}]]{}", plain_text(section.title), remark), columns, 0) + '\n' + body;
}

std::string terminal_text(const std::vector<Section>& sections, Importance least,
                          std::size_t columns) {
  std::string out;
  for (const Section& section : sections) {
    if (section.importance <= least) out += terminal_text(section, columns);
  }
  return out;
}

}  // namespace recoil
