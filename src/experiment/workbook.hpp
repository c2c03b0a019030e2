#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace recoil {

/// One sheet of a workbook.
struct Sheet {
  std::string table;  ///< line n is row n of the sheet; separated by tabs, all texts quoted
  std::string name;
  std::vector<std::string> others;  ///< names of the other sheets
};

/// True if the bytes of a file begin like a workbook: .xlsx, .ods, .xls, or one with a password.
bool is_workbook(std::string_view bytes);

/// Reads a sheet of a workbook: Office Open XML (.xlsx, ECMA-376) or OpenDocument (.ods, ISO
/// 26300).
///
/// Numbers are the stored ones, whatever digits their cells show, and formulas have the values that
/// the workbook stores. A boolean is 0 or 1. A date, a duration and a formula without a stored
/// value become texts that say so, because none of them is a number to be measured.
/// @param file its name in messages
/// @param decimal mark of the numbers in the table: '.' or ','
/// @param name of the sheet; empty: the first one that is not hidden
/// @throws InputError if the workbook is damaged, encrypted, of another kind or too large, and if
/// it
///   has no such sheet
Sheet read_sheet(std::string_view bytes, const std::string& file, const std::string& name,
                 char decimal = '.');

}  // namespace recoil
