#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

/// Common to the readers of the kinds of workbook: their errors, their sheets, and the cells of the
/// one that is read.
namespace recoil {

/// The errors about a workbook.
class WorkbookErrors {
 public:
  explicit WorkbookErrors(std::string file) : file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& problem, const std::string& why,
                         const std::string& suggestion) const;
  [[noreturn]] void fail_damaged(const std::string& why) const;
  [[noreturn]] void fail_encrypted() const;
  [[noreturn]] void fail_too_large() const;
  [[noreturn]] void fail_other_kind() const;

 private:
  std::string file_;
};

/// Bounds, so that a small file cannot take all memory.
inline constexpr std::size_t largest_workbook = 32UL << 20;  // [bytes]
inline constexpr std::size_t sheet_columns = 16'384;         // of Excel

/// The cells of a sheet. Rows and columns count from 0.
class Cells {
 public:
  /// @param decimal mark of the numbers in the table
  Cells(const WorkbookErrors& errors, char decimal) : errors_(errors), decimal_(decimal) {}

  void put_text(std::size_t row, std::size_t column, std::string text);
  /// Puts the shortest digits that give the stored number.
  void put_number(std::size_t row, std::size_t column, const std::string& stored);
  void put_number(std::size_t row, std::size_t column, double stored);

  /// The rows, all with the width of the widest, except for empty ones.
  std::string table() const;

 private:
  using Row = std::map<std::size_t, std::string>;  ///< by column

  void put(std::size_t row, std::size_t column, const std::string& cell);

  const WorkbookErrors& errors_;
  char decimal_;
  std::vector<Row> rows_;
  std::size_t bytes_ = 0;
};

/// A sheet of a workbook, and whether it is hidden.
struct ListedSheet {
  std::string name;
  bool hidden = false;
};

/// The index of the sheet of this name, or of this number from 1 on. Without a name: the first that
/// is not hidden, and of an export of phyphox the one that lists all bounces.
/// @throws InputError if there is none
std::size_t chosen_sheet(const std::vector<ListedSheet>& all, const std::string& name,
                         const WorkbookErrors& errors);

/// True if a number format shows a date or a time: it has one of the letters y, m, d, h and s
/// outside quotation marks and brackets. [h] (hours beyond a day) counts.
bool shows_date(const std::string& format);
/// The same of a format without a code, by its number (ECMA-376 part 1, 18.8.30).
bool shows_date(std::size_t format);

/// The first day of a workbook's dates: day 0.
std::chrono::sys_days first_day(bool since_1904);
/// "date 2024-05-01" of a number of days since `epoch`.
std::string date_text(double days, std::chrono::sys_days epoch);

}  // namespace recoil
