#pragma once

#include <string>
#include <vector>

#include "core/files.hpp"

namespace recoil {

/// Writes the files of a result; where they cannot be written the result is printed, so that the
/// work is not lost, before the error goes on. @throws InputError
void write_or_print(const std::vector<WholeFile>& files, const std::string& result);

}  // namespace recoil
