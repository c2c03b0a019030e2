#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"

namespace recoil {

/// What starts the shards.
enum class ClusterSystem { slurm, parallel };
template <>
struct NamesOf<ClusterSystem> {
  static constexpr std::array<std::string_view, 2> names = {"slurm", "parallel"};
};

/// One command in shards.
struct ClusterJob {
  ClusterSystem system = ClusterSystem::slurm;
  std::filesystem::path recoil;    ///< the program, as every machine finds it
  std::filesystem::path where;     ///< the folder in which the command is given
  std::filesystem::path folder;    ///< of parts, scripts and results, absolute
  std::vector<std::string> words;  ///< "fit", "my.toml", ...
  std::size_t shards = 1;
  int cpus = 1;         ///< of each shard
  long seconds = 3600;  ///< limit of each shard [s]
};

/// A file of the job's folder.
struct ClusterFile {
  std::string name;
  std::string text;
};

/// The scripts of a job, to be read and edited; the one that starts everything is the last.
std::vector<ClusterFile> cluster_scripts(const ClusterJob& job);

/// "01:30:00" [s]; none for anything else.
std::optional<long> seconds_named(std::string_view text);

/// `word` as one word of a POSIX shell.
std::string shell_word(std::string_view word);

}  // namespace recoil
