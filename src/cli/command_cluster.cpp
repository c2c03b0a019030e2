#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "analysis/analysis.hpp"
#include "cli/cluster_scripts.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/resumable.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

struct ClusterFlags {
  std::string system;
  std::size_t shards = 0;
  std::string out;
  int cpus = 1;
  std::string time = "01:00:00";
};

const char* const shareable[] = {"fit", "coverage", "diagnose"};

/// The words behind those of `cluster` itself: a command, or the fit file of the command fit.
std::vector<std::string> words_of_job(std::vector<std::string> words) {
  if (words.empty()) {
    throw InputError({}, "there is nothing to run", "a fit file or a command is missing",
                     "see recoil cluster --help");
  }
  if (std::none_of(std::begin(shareable), std::end(shareable),
                   [&](const char* name) { return words.front() == name; })) {
    if (fs::path(words.front()).extension().empty() && !fs::exists(words.front())) {
      throw InputError({}, fmt::format("{} does not run in shards", words.front()),
                       "it is neither a fit file nor one of the commands that do",
                       fmt::format("those are {}", fmt::join(shareable, ", ")));
    }
    words.insert(words.begin(), "fit");
  }
  return words;
}

/// A mistake in the command or its files is told now, once, and not by every shard.
void require_valid(const std::vector<std::string>& words) {
  for (const char* own : {"--shard", "--out", "--threads"}) {
    if (std::any_of(words.begin(), words.end(), [own](const std::string& word) {
          return word == own || word.starts_with(std::string(own) + "=");
        })) {
      throw InputError({}, fmt::format("{} is set by the scripts", own), "",
                       "leave it out; --cpus says how many threads each shard has");
    }
  }
  CLI::App trial("", "recoil");
  add_fit(trial);
  add_coverage(trial);
  add_diagnose(trial);
  // Ends before the command is run. (Its own callback stays: it holds what the options write to.)
  for (CLI::App* command : trial.get_subcommands({})) {
    command->parse_complete_callback([] { throw CLI::Success(); });
  }
  std::vector<std::string> backwards = words;
  backwards.insert(backwards.end(), {"--shard", "1/1", "--out", "."});
  std::reverse(backwards.begin(), backwards.end());
  try {
    try {
      trial.parse(backwards);
    } catch (const CLI::Success&) {
      const std::vector<std::string> unknown = trial.remaining(true);
      if (!unknown.empty()) throw CLI::ExtrasError("recoil", unknown);
    }
  } catch (const CLI::ParseError& error) {
    throw InputError({}, error.what(), "", fmt::format("see recoil {} --help", words.front()));
  }
  for (const std::string& file :
       trial.get_subcommand(words.front())->get_option("FIT")->results()) {
    load_inputs(file);
  }
}

// Slurm's signal before the limit comes up to a minute early, and the shard needs some time, too.
constexpr long shortest_time = 600;  // [s]

std::string complaint_about_time(const std::string& text) {
  const std::optional<long> seconds = seconds_named(text);
  return seconds && *seconds >= shortest_time
             ? ""
             : fmt::format("{} is not hours:minutes:seconds from 00:10:00 on", text);
}

void write_scripts(const ClusterFlags& flags, const std::vector<std::string>& words) {
  require_valid(words);
  require_writable_folder(flags.out);
  ClusterJob job;
  job.system = value_named<ClusterSystem>(flags.system).value_or(ClusterSystem::slurm);
  job.recoil = fs::read_symlink("/proc/self/exe");
  job.where = fs::current_path();
  job.folder = fs::absolute(flags.out).lexically_normal();
  if (!job.folder.has_filename()) job.folder = job.folder.parent_path();
  const std::string name = job.folder.string();
  if (name.find_first_of("\"'\\%\n\t") != std::string::npos) {
    throw InputError({name}, "this folder cannot be named in the scripts",
                     "its path has a quote, a backslash, a percent sign, a tab or a line break",
                     "choose another folder");
  }
  job.words = words;
  job.shards = flags.shards;
  job.cpus = flags.cpus;
  job.seconds = *seconds_named(flags.time);
  const std::vector<ClusterFile> scripts = cluster_scripts(job);
  std::vector<WholeFile> files;
  for (const ClusterFile& file : scripts) files.push_back({job.folder / file.name, file.text});
  write_whole_files(files);
  for (const ClusterFile& file : scripts) {
    const fs::path path = job.folder / file.name;
    if (path.extension() == ".sh") {
      fs::permissions(path, fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                      fs::perm_options::add);
    }
    fmt::print("{}: written\n", (fs::path(flags.out) / file.name).string());
  }
  fmt::print("Read them, edit them, and start the job: sh {}\n",
             shell_word((fs::path(flags.out) / "run.sh").string()));
}

}  // namespace

void add_cluster(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "cluster", "write the scripts that run a command in shards on a cluster, and its merge");
  command->footer(
      "Behind its own words stands a fit file, or a command with its options: fit, coverage\n"
      "or diagnose.\n"
      "The scripts are plain, and yours to edit. All machines see the folder, the program and the\n"
      "data at the same paths.\n\n"
      "  recoil cluster slurm my.toml --replicates 1000000 --shards 100 --out big\n"
      "  recoil cluster parallel coverage my.toml --datasets 10000 --shards 40 --out big");
  const auto flags = std::make_shared<ClusterFlags>();
  command->add_option("SYSTEM", flags->system, "what starts the shards: slurm, parallel")
      ->required()
      ->check(CLI::IsMember(all_names<ClusterSystem>()));
  command->add_option("--shards", flags->shards, "how many")
      ->required()
      ->check(CLI::Range(std::size_t{1}, most_shards));
  command->add_option("--out", flags->out, "folder for scripts, parts and results")
      ->required()
      ->type_name("DIR");
  command->add_option("--cpus", flags->cpus, "threads of each shard")
      ->capture_default_str()
      ->check(CLI::Range(1, 4096));
  command
      ->add_option("--time", flags->time,
                   "limit of each shard, hours:minutes:seconds, 00:10:00 or more")
      ->capture_default_str()
      ->check(CLI::Validator(complaint_about_time, ""));
  command->allow_extras();
  command->callback(
      [flags, command] { write_scripts(*flags, words_of_job(command->remaining())); });
}

}  // namespace recoil
