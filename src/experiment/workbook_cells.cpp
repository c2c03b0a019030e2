#include "experiment/workbook_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "core/error.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

constexpr std::size_t largest_table = 128UL << 20;  // a sheet as cells and as text [bytes]
constexpr std::size_t cell_overhead = 100;          // of a cell in memory, besides its text
constexpr std::size_t sheet_rows = 1'048'576;       // of Excel

/// The sheet that lists all bounces in an export of phyphox, which also has sheets about the phone,
/// in some versions as the first ones: "(In)elastic collision" and "Acoustic stopwatch". The end of
/// `all` if there is none.
auto phyphox_sheet(const std::vector<ListedSheet>& all) {
  for (const char* const name : {"All", "Energy", "Multiple"}) {
    const auto found = std::ranges::find(all, name, &ListedSheet::name);
    if (found != all.end()) return found;
  }
  return std::ranges::find_if(
      all, [](const ListedSheet& one) { return !one.name.starts_with("Metadata "); });
}

}  // namespace

void WorkbookErrors::fail(const std::string& problem, const std::string& why,
                          const std::string& suggestion) const {
  throw InputError({file_}, problem, why, suggestion);
}
void WorkbookErrors::fail_damaged(const std::string& why) const {
  fail("the workbook is damaged", why, "save it again in its program");
}
void WorkbookErrors::fail_encrypted() const {
  fail("the workbook is encrypted", "it has a password", "save it without one, or as CSV");
}
void WorkbookErrors::fail_too_large() const {
  fail("the workbook is too large", "", "save the sheet as CSV");
}
void WorkbookErrors::fail_other_kind() const {
  fail("this is not a workbook that recoil reads", "it reads .xlsx, .ods and .xls of Excel 97",
       "save the sheet as .xlsx or CSV");
}

void Cells::put_text(std::size_t row, std::size_t column, std::string text) {
  std::ranges::replace(text, '\n', ' ');
  text = trimmed(with_plain_blanks(text));
  replace_all(text, "\"", "\"\"");
  if (!text.empty()) put(row, column, '"' + text + '"');
}

void Cells::put_number(std::size_t row, std::size_t column, const std::string& stored) {
  const auto number = parse_number(stored);
  if (!number) return put_text(row, column, stored);
  put_number(row, column, *number);
}

void Cells::put_number(std::size_t row, std::size_t column, double stored) {
  std::string cell = fmt::format("{}", stored);
  std::ranges::replace(cell, '.', decimal_);
  put(row, column, cell);
}

std::string Cells::table() const {
  std::size_t width = 0;
  for (const Row& row : rows_) width = std::max(width, row.empty() ? 0 : row.rbegin()->first + 1);
  std::string table;
  for (const Row& row : rows_) {
    std::size_t at = 0;
    for (const auto& [column, cell] : row) {
      table.append(column - at, '\t');
      table += cell;
      at = column;
    }
    if (!row.empty()) table.append(width - 1 - at, '\t');
    table += '\n';
    if (table.size() > largest_table) errors_.fail_too_large();
  }
  return table;
}

void Cells::put(std::size_t row, std::size_t column, const std::string& cell) {
  bytes_ += cell.size() + cell_overhead;
  if (row >= sheet_rows || column >= sheet_columns || bytes_ > largest_table) {
    errors_.fail_too_large();
  }
  if (rows_.size() <= row) rows_.resize(row + 1);
  rows_[row][column] = cell;
}

std::size_t chosen_sheet(const std::vector<ListedSheet>& all, const std::string& name,
                         const WorkbookErrors& errors) {
  auto found = all.end();
  if (!name.empty()) {
    found = std::ranges::find(all, name, &ListedSheet::name);
    std::size_t number = 0;
    const char* const end = name.data() + name.size();
    const auto [rest, failed] = std::from_chars(name.data(), end, number);
    const bool counts = failed == std::errc() && rest == end && number > 0 && number <= all.size();
    if (found == all.end() && counts) return number - 1;
  } else if (std::ranges::find(all, "Metadata Device", &ListedSheet::name) != all.end()) {
    found = phyphox_sheet(all);
  }
  if (name.empty() && found == all.end())
    found = std::ranges::find(all, false, &ListedSheet::hidden);
  if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
  if (name.empty()) errors.fail_damaged("it has no sheet");
  std::vector<std::string> names;
  for (const ListedSheet& one : all) names.push_back(one.name);
  errors.fail("no sheet is called " + quote(name), "", did_you_mean(name, names));
}

bool shows_date(const std::string& format) {
  constexpr std::string_view letters = "ymdhsYMDHS";
  for (std::size_t i = 0; i < format.size(); ++i) {
    const char c = format[i];
    if (c == '"' || c == '[') {
      const std::size_t end = std::min(format.find(c == '"' ? '"' : ']', i + 1), format.size());
      const std::string_view inside = std::string_view(format).substr(i + 1, end - i - 1);
      if (c == '[' && !inside.empty() && inside.find_first_not_of("hmsHMS") == inside.npos) {
        return true;
      }
      i = end;
    } else if (c == '\\' || c == '_' || c == '*') {
      ++i;
    } else if (letters.find(c) != letters.npos) {
      return true;
    }
  }
  return false;
}

bool shows_date(std::size_t format) {
  return (format >= 14 && format <= 22) || (format >= 27 && format <= 36) ||
         (format >= 45 && format <= 47) || (format >= 50 && format <= 58);
}

std::chrono::sys_days first_day(bool since_1904) {
  using std::chrono::year;
  return since_1904 ? year(1904) / 1 / 1 : year(1899) / 12 / 30;
}

std::string date_text(double days, std::chrono::sys_days epoch) {
  if (!(days >= 1.0 && days < 3e6)) return fmt::format("time {} d", days);
  const std::chrono::year_month_day date(epoch + std::chrono::days(static_cast<int>(days)));
  return fmt::format("date {:04}-{:02}-{:02}", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
}

}  // namespace recoil
