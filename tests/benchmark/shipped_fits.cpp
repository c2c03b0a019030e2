#include "shipped_fits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/error.hpp"

namespace recoil::bench {
namespace {

namespace fs = std::filesystem;

long files_of(const fs::path& folder, const char* extension) {
  return std::count_if(
      fs::directory_iterator(folder), fs::directory_iterator(),
      [&](const fs::directory_entry& entry) { return entry.path().extension() == extension; });
}

}  // namespace

Json measure_shipped_fits(const fs::path& recoil, const fs::path& root, const fs::path& pages) {
  fs::remove_all(pages);
  const std::string command =
      fmt::format("cd '{}' && '{}' report --out '{}' >'{}' 2>&1", root.string(), recoil.string(),
                  pages.string(), (pages.string() + ".log"));
  int status = 0;
  const double seconds = seconds_of([&] { status = std::system(command.c_str()); });
  if (status != 0) throw ComputationError("failed: " + command);
  const long fits = files_of(root / "fits", ".toml");
  const long written = files_of(pages, ".html");
  if (written != fits + 1) {  // and an index
    throw ComputationError(
        fmt::format("{} fits, but {} pages in {}", fits, written, pages.string()));
  }
  fmt::print("  {} fits {:>10.1f} s\n", fits, seconds);
  return {{"fits", fits}, {"pages", written}, {"seconds", seconds}};
}

}  // namespace recoil::bench
