#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "document/document.hpp"
#include "validation/studies/study_stamp.hpp"

namespace recoil {

/// What every study's command is given: where its result goes and where it goes on from.
struct StudyRun {
  std::string command;  ///< the words that say what is studied, without places and threads
  std::string out;      ///< the JSON; empty: none, the page alone is printed
  std::string keep;     ///< a folder for what is finished; empty: nowhere
  int threads = 0;
  std::string shard;  ///< "3/40": only this share of what is studied is made, and kept

  StudyStamp stamp() const;
  bool owns(std::size_t piece) const;  ///< is it this process's to make?
};

/// The options of `StudyRun` but the command.
void add_run_options(CLI::App& command, StudyRun& run);

/// --shard, for a study whose pieces are kept one by one.
void add_shard_option(CLI::App& command, StudyRun& run);

/// For a shard writes into `run.keep` a part that says that its pieces are there.
/// @return whether it was one, and nothing is to be published
bool wrote_part(const StudyRun& run);

/// Writes `json` where the run wants it, with its page and picture beside it; without such a place
/// prints the page.
void publish(const StudyRun& run, const std::string& json, const Document& page);

/// Each adds one command. `words` is the command line without places and threads.
void add_coverage_grid(CLI::App& program, const std::string& words);
void add_coverage_designs(CLI::App& program, const std::string& words);
void add_coverage_noise(CLI::App& program, const std::string& words);
void add_coverage_summary(CLI::App& program);
void add_hidden_effects(CLI::App& program, const std::string& words);
void add_pairing(CLI::App& program, const std::string& words);
void add_pairing_events(CLI::App& program);
void add_ranks(CLI::App& program, const std::string& words);
void add_reconstruct(CLI::App& program);

/// recoil_study merge: a study whose shards are there.
void add_study_merge(CLI::App& program);

/// recoil_study list, make, render: the committed studies.
void add_list(CLI::App& program);
void add_make(CLI::App& program);
void add_render(CLI::App& program);

/// One command line of recoil_study. @return the exit status
int run_study_program(const std::vector<std::string>& words);

}  // namespace recoil
