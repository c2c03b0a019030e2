#pragma once

#include <string>
#include <string_view>

#include "experiment/workbook.hpp"

namespace recoil {

/// Reads a sheet of a workbook of Excel 97 to 2003 (.xls): records of BIFF8 ([MS-XLS]) in the
/// stream "Workbook" of a compound file ([MS-CFB]). Values are as `read_sheet` states them.
/// @throws InputError as `read_sheet`
Sheet read_excel97(std::string_view bytes, const std::string& file, const std::string& name,
                   char decimal);

}  // namespace recoil
