#pragma once

#include <CLI/CLI.hpp>

#include "cli/analysis.hpp"

namespace recoil {

/// The options that every analysing command shares, as given.
struct AnalysisFlags {
  int replicates = -1;
  std::int64_t seed = -1;
  int threads = 0;
  std::string solver = "fast";

  AnalysisOptions resolved() const;
};

void add_analysis_flags(CLI::App& command, AnalysisFlags& flags);

}  // namespace recoil
