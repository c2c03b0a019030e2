#include "common.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/files.hpp"
#include "design.hpp"

namespace recoil::bench {
namespace {

namespace fs = std::filesystem;

/// CPU seconds of all children that have ended [s].
double cpu_of_children() {
  rusage usage = {};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// The median CPU time of three runs. @throws ComputationError when the program fails
double cpu_seconds(const fs::path& recoil, const fs::path& folder, const std::string& options) {
  const std::string command =
      fmt::format("'{}' fit '{}' --threads 1 {} >'{}' 2>&1 </dev/null", recoil.string(),
                  (folder / "fit.toml").string(), options, (folder / "fit.log").string());
  std::vector<double> seconds;
  for (int run = 0; run < 3; ++run) {
    const double before = cpu_of_children();
    if (std::system(command.c_str()) != 0) throw ComputationError("failed: " + command);
    seconds.push_back(cpu_of_children() - before);
  }
  return median(seconds);
}

}  // namespace

Json measure_common(const fs::path& recoil, const fs::path& folder, const fs::path& scripts) {
  Json rows = Json::array();
  const auto add = [&](const char* what, double seconds) {
    fmt::print("  {}: {:.2f} s\n", what, seconds);
    std::fflush(stdout);
    rows.push_back({{"what", what}, {"seconds", seconds}});
  };
  write_captures(folder / "rows540", folder / "means27",
                 {0.97, 1.03, 1.1, 1.25, 1.5, 2.0, 3.0, 5.0, 9.0}, 20);
  add("27 points of 20 impacts, captures counted, noise estimated, 1,999 replicates",
      cpu_seconds(recoil, folder / "means27", ""));
  write_captures(folder / "rows60", folder / "means15", {1.02, 1.1, 1.3, 2.0, 4.0}, 4);
  add("60 rows of single impacts, captures among them, noise estimated, 1,999 replicates",
      cpu_seconds(recoil, folder / "rows60", ""));
  add("the same impacts as 15 counted means", cpu_seconds(recoil, folder / "means15", ""));

  const fs::path thousand = folder / "points1000";
  write_peer_case(thousand, 250);
  add("1,000 points, deviations stated, no replicates",
      cpu_seconds(recoil, thousand, "--replicates 0"));
  const std::string script = fmt::format("/usr/bin/python3 '{}' '{}' --first >'{}' 2>&1 </dev/null",
                                         (scripts / "peer_lmfit.py").string(), thousand.string(),
                                         (thousand / "lmfit.log").string());
  if (std::system(script.c_str()) == 0) {
    const Json peer = Json::parse(read_text_file(thousand / "peer_lmfit.json"));
    rows.back()["lmfit_seconds"] = peer["fits"][0]["cpu_seconds"];
  }
  write_peer_case(folder / "points1000-unstated", 250, false);
  add("1,000 points, noise estimated, no replicates",
      cpu_seconds(recoil, folder / "points1000-unstated", "--replicates 0"));
  return rows;
}

}  // namespace recoil::bench
