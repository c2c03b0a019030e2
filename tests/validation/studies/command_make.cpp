// The committed studies as a whole: which are current, shards and their merging, pages.
#include <fmt/format.h>

#include <memory>
#include <sstream>

#include "analysis/analysis.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"
#include "core/resumable.hpp"
#include "validation/studies/commands.hpp"
#include "validation/studies/markdown.hpp"
#include "validation/studies/study_list.hpp"
#include "validation/studies/study_pages.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

std::string words_of(StudyState state) {
  switch (state) {
    case StudyState::missing:
      return "missing";
    case StudyState::stale:
      return "stale";
    case StudyState::current:
      return "current";
  }
  return "";
}

void list() {
  fmt::print(
      "Stale studies were made from other sources, fits or data than those that are here.\n");
  for (const Study& study : all_studies()) {
    fmt::print("  {:8}{:38}{}\n", words_of(state_of(".", study)), study.name, study.result);
  }
}

void make_one(const Study& study) {
  if (state_of(".", study) == StudyState::current) {
    fmt::print("  current {}\n", study.result);
    return;
  }
  std::istringstream split(study.command);
  std::vector<std::string> words;
  for (std::string word; split >> word;) words.push_back(word);
  const std::string key = study_key(".", study.command);
  words.insert(words.end(), {"--out", study.result, "--keep", "build/studies/" + key});
  if (const int status = run_study_program(words); status != 0) {
    throw ComputationError(fmt::format("{} ended with status {}", study.name, status));
  }
  fmt::print("  wrote   {}\n", study.result);
}

struct StudyMerge {
  std::string folder;
  std::string out;
  bool missing = false;
  int threads = 0;
};

/// A shard is one piece: its designs or cases are files of their own in the same folder.
Origin origin_of_study(const std::string& command, std::size_t shards) {
  std::istringstream split(command);
  std::vector<std::string> words;
  for (std::string word; split >> word;) words.push_back(word);
  return origin_here(words, study_key(".", command), 0, shards, "");
}

void merge_study(const StudyMerge& flags) {
  const std::vector<Part> parts = parts_in(flags.folder);
  if (flags.missing) {
    const std::string missing = array_list(missing_shards(parts).numbers);
    if (!missing.empty()) fmt::print("--array={}\n", missing);
    return;
  }
  std::string command;
  for (const std::string& word : parts.front().origin.command) {
    command += (command.empty() ? "" : " ") + word;
  }
  rows_of_parts(flags.folder, origin_of_study(command, parts.front().origin.pieces));
  std::vector<std::string> words = parts.front().origin.command;
  words.insert(words.end(), {"--keep", flags.folder});
  if (!flags.out.empty()) words.insert(words.end(), {"--out", flags.out});
  if (flags.threads > 0) words.insert(words.end(), {"--threads", fmt::format("{}", flags.threads)});
  if (const int status = run_study_program(words); status != 0) {
    throw ComputationError(fmt::format("the study ended with status {}", status));
  }
}

}  // namespace

StudyStamp StudyRun::stamp() const {
  const std::string study = out.empty() ? "" : fs::path(out).stem().string();
  return {study, "recoil_study " + command, study_key(".", command)};
}

void add_run_options(CLI::App& command, StudyRun& run) {
  command.add_option("--out", run.out, "write the result here (JSON), its page beside it");
  command.add_option("--keep", run.keep,
                     "folder for finished work; a stopped study continues from it");
  command.add_option("--threads", run.threads, "threads to use (default: all cores)")
      ->check(CLI::Range(1, 4096));
}

void publish(const StudyRun& run, const std::string& json, const Document& page) {
  if (run.out.empty()) {
    fmt::print("{}", markdown_page(page));
    return;
  }
  write_whole_file(run.out, json, Replacing::data);
  render_study(run.out);
}

void add_list(CLI::App& program) {
  program.add_subcommand("list", "the committed studies, and which are current")->callback(list);
}

void add_make(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("make", "make those that are stale or missing, and all pages");
  const auto names = std::make_shared<std::vector<std::string>>();
  command->add_option("STUDY", *names, "only these");
  command->callback([names] {
    std::vector<const Study*> wanted;
    for (const std::string& name : *names) wanted.push_back(&study_named(name));
    if (wanted.empty()) {
      for (const Study& study : all_studies()) wanted.push_back(&study);
    }
    for (const Study* study : wanted) make_one(*study);
    write_coverage_summary("reports");
  });
}

void add_render(CLI::App& program) {
  CLI::App* command = program.add_subcommand("render", "make page and picture of results again");
  const auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("RESULT", *files, "reports/NAME.json")->required();
  command->callback([files] {
    for (const std::string& file : *files) render_study(file);
  });
}

bool StudyRun::owns(std::size_t piece) const {
  return shard_named(shard).value_or(Shard{}).owns(piece);
}

void add_shard_option(CLI::App& command, StudyRun& run) {
  command
      .add_option("--shard", run.shard,
                  "make only the K-th of N shares and keep it (--keep), for recoil_study merge")
      ->type_name("K/N")
      ->needs(command.get_option("--keep"))
      ->check([](const std::string& text) -> std::string {
        return shard_named(text) ? "" : text + " is not K/N with K from 1 to N";
      });
}

bool wrote_part(const StudyRun& run) {
  if (run.shard.empty()) return false;
  const Shard shard = *shard_named(run.shard);
  const Origin origin = origin_of_study(run.command, shard.of);
  KeptRows kept;
  kept.put(shard.number - 1, true);
  write_part(kept, run.keep, origin, shard);
  fmt::print("{}: written\n", part_path(run.keep, origin, shard).string());
  return true;
}

void add_study_merge(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "merge", "put the shards of a study together, as if one process had made it");
  const auto flags = std::make_shared<StudyMerge>();
  command->add_option("DIR", flags->folder, "the folder that the shards keep (--keep)")->required();
  command->add_option("--out", flags->out, "write the result here (JSON), its page beside it");
  command->add_flag("--missing", flags->missing,
                    "only print which shards are missing, as --array=3,7-9");
  command->add_option("--threads", flags->threads, "threads to use (default: all cores)")
      ->check(CLI::Range(1, 4096));
  command->callback([flags] { merge_study(*flags); });
}

}  // namespace recoil
