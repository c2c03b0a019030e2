#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/shard.hpp"
#include "estimate/scheme.hpp"
#include "uncertainty/posterior_options.hpp"

namespace recoil {

struct UncertaintyOptions {
  int replicates = 1999;
  /// Add batches until every percentile and recommended end has a Monte-Carlo error below
  /// `wanted_error` of its interval's width, from 999 on and up to 19999. `replicates` is not used.
  bool replicates_auto = false;
  double wanted_error = 0.02;
  Scheme scheme = Scheme::automatic;
  double level = 0.95;
  std::uint64_t seed = 20260101;
  int threads = 0;  ///< 0: all cores. No digit depends on it.
  bool profile = true;
  bool curves = true;         ///< restitution curves with bands, and those of the profiles
  bool capture = true;        ///< intervals of the capture velocities
  bool posterior = false;     ///< sample it
  PosteriorOptions sampling;  ///< how; level, seed and threads are those below and above
  bool budget = true;     ///< what the errors come from, and what they were with exact materials
  bool two_point = true;  ///< compare with the paper's calibration; without it the list is empty
  /// Where finished replicates are kept when the user stops the run, and looked for by the next run
  /// of the same fit; empty: nowhere. The file is left behind; whoever has written the results
  /// removes it.
  std::filesystem::path keep;
  std::string keep_key;  ///< what else the replicates depend on: the program that makes them
  Shard shard;           ///< whose replicates `shard_of_bootstrap` runs
  /// Files in which shards have left their replicates, and from which they are taken over.
  std::vector<std::filesystem::path> parts;
};

}  // namespace recoil
