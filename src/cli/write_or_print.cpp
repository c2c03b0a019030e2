#include "cli/write_or_print.hpp"

#include <fmt/format.h>

namespace recoil {

void write_or_print(const std::vector<WholeFile>& files, const std::string& result) {
  try {
    write_whole_files(files);
  } catch (const InputError&) {
    fmt::print("{}", result);
    throw;
  }
}

}  // namespace recoil
