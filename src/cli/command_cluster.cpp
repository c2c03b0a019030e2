#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "analysis/analysis.hpp"
#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/numbers.hpp"
#include "core/quoting.hpp"
#include "core/resumable.hpp"
#include "document/sentence.hpp"
#include "export/export_job.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

/// A command that runs in shards.
struct ClusterJob {
  std::string system;  ///< starts the shards: "slurm" or "parallel"
  std::size_t shards = 1;
  std::string out;
  int cpus = 1;                    ///< of each shard
  std::string time;                ///< limit of each shard
  fs::path recoil = {};            ///< the program
  fs::path where = {};             ///< the working directory of the command
  fs::path folder = {};            ///< absolute path of parts, scripts and results
  std::vector<std::string> words;  ///< "fit", "my.toml", ...
};

const char* const shard_script = R"(#!/bin/sh
# Runs one of @SHARDS@ shards: sh shard.sh NUMBER, from 1. It writes one complete file into the folder,
# or none. It can be repeated safely.
number=$1
folder=@FOLDER@
cd @WHERE@ || exit 1
# Do not repeat a shard whose input recoil has rejected (exit status 2).
[ -e "$folder/refused-$number" ] && exit 2
@RECOIL@ @WORDS@ \
  --shard "$number/@SHARDS@" --out "$folder" --threads "${SLURM_CPUS_PER_TASK:-@CPUS@}" &
child=$!
# At a time limit or an eviction, recoil keeps finished work and ends. Some systems send SIGTERM to
# every process, some only to this one. recoil counts SIGTERM and SIGUSR1 together as one request.
trap 'kill -USR1 "$child" 2>/dev/null' TERM INT USR1
wait "$child"
status=$?
while kill -0 "$child" 2>/dev/null; do # a signal ended the wait, not the child
  wait "$child"
  status=$?
done
[ "$status" -eq 2 ] && : >"$folder/refused-$number"
exit "$status"
)";

const char* const slurm_array = R"(#!/bin/sh
# The array of shards; run.sh submits it.
#SBATCH --job-name=recoil
#SBATCH --array=1-@SHARDS@
#SBATCH --cpus-per-task=@CPUS@
#SBATCH --time=@TIME@
#SBATCH --signal=B:USR1@AT@90
#SBATCH --output="@PLAIN_FOLDER@/log-%a.txt"
#SBATCH --open-mode=append
exec sh @FOLDER@/shard.sh "$SLURM_ARRAY_TASK_ID"
)";

const char* const slurm_run = R"(#!/bin/sh
# Starts the job: sh run.sh. It submits the missing shards, and itself to run after they have ended,
# with or without success. When no shard is missing, it merges them. Run it again to continue.
#SBATCH --job-name=recoil-merge
#SBATCH --cpus-per-task=@CPUS@
#SBATCH --time=@TIME@
#SBATCH --output="@PLAIN_FOLDER@/log-merge.txt"
#SBATCH --open-mode=append
rounds=5 # of submission
round=${1:-1}
folder=@FOLDER@
recoil=@RECOIL@

if ls "$folder"/refused-* >/dev/null 2>&1; then
  echo "recoil refused its input: see log-*.txt, correct it, and remove refused-*" >&2
  exit 2
fi
# Slurm refuses numbers from MaxArraySize on (1001 unless the cluster says otherwise).
limit=$(scontrol show config 2>/dev/null | sed -n 's/^MaxArraySize *= *//p')
if [ "${limit:-1000000000}" -le @SHARDS@ ]; then
  echo "this cluster takes at most $((limit - 1)) shards, not @SHARDS@: write the scripts again" >&2
  exit 2
fi
missing=--array=1-@SHARDS@
if ls "$folder"/part-*.jsonl >/dev/null 2>&1; then
  missing=$("$recoil" merge "$folder" --missing) || exit
fi
if [ -z "$missing" ]; then
  exec "$recoil" merge "$folder" --threads "${SLURM_CPUS_PER_TASK:-@CPUS@}" >"$folder/result.txt"
fi
if [ "$round" -gt "$rounds" ]; then
  echo "after $rounds rounds these shards are missing: $missing" >&2
  exit 3
fi
echo "round $round: $missing"
job=$(sbatch --parsable "$missing" "$folder/array.sbatch") || exit
# afterany: a merge that waits for success (afterok) waits for ever once a shard has failed
sbatch --dependency="afterany:${job%%;*}" "$folder/run.sh" $((round + 1))
)";

const char* const parallel_run = R"(#!/bin/sh
# Starts the job: sh run.sh. Finished shards are not run again. To use several machines, give parallel
# their names (--sshlogin, --sshloginfile); they must share this folder.
folder=@FOLDER@
seq @SHARDS@ | parallel --jobs @JOBS@ --retries 5 --joblog "$folder/parallel.log" \
  "sh {2}/shard.sh {1} >>{2}/log-{1}.txt 2>&1" :::: - ::: "$folder"
# This lists missing shards; start the job again to run them.
cd @WHERE@ || exit 1
@RECOIL@ merge "$folder" >"$folder/result.txt"
)";

std::string clock_time(std::int64_t seconds) {
  return fmt::format("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

std::vector<WholeFile> cluster_scripts(const ClusterJob& job) {
  const std::string plain_folder = job.folder.string();
  const auto script = [&](const char* name, const char* text) {
    return WholeFile{
        job.folder / name,
        filled(text, {{"SHARDS", fmt::format("{}", job.shards)},
                      {"FOLDER", shell_word(plain_folder)},
                      {"PLAIN_FOLDER", plain_folder},
                      {"WHERE", shell_word(job.where.string())},
                      {"RECOIL", shell_word(job.recoil.string())},
                      {"WORDS", joined(job.words, " ", shell_word)},
                      {"CPUS", fmt::format("{}", job.cpus)},
                      {"JOBS", fmt::format("$((($(nproc) + {0} - 1) / {0}))", job.cpus)},
                      {"TIME", clock_time(*parse_clock_time(job.time))},
                      {"AT", "@"}})};
  };
  if (job.system == "slurm") {
    return {script("shard.sh", shard_script), script("array.sbatch", slurm_array),
            script("run.sh", slurm_run)};
  }
  return {script("shard.sh", shard_script), script("run.sh", parallel_run)};
}

const char* const shareable[] = {"fit", "coverage", "diagnose"};

/// The command to run, from the words after the options of `cluster`: a command with its options,
/// or only a fit file for the command fit.
std::vector<std::string> words_of_job(std::vector<std::string> words) {
  if (words.empty()) {
    throw InputError({}, "there is no command to run", "a fit file or a command is missing",
                     "see recoil cluster --help");
  }
  if (std::none_of(std::begin(shareable), std::end(shareable),
                   [&](const char* name) { return words.front() == name; })) {
    if (fs::path(words.front()).extension().empty() && !fs::exists(words.front())) {
      throw InputError({}, fmt::format("{} does not run in shards", words.front()),
                       "it is neither a fit file nor a command that does",
                       fmt::format("commands in shards: {}", fmt::join(shareable, ", ")));
    }
    words.insert(words.begin(), "fit");
  }
  return words;
}

/// Checks the command and its files before the shards start.
void require_valid(const std::vector<std::string>& words) {
  for (const char* own : {"--shard", "--out", "--threads"}) {
    if (std::ranges::any_of(words, [own](const std::string& word) {
          return word == own || word.starts_with(std::string(own) + "=");
        })) {
      throw InputError({}, fmt::format("{} is set by the scripts", own), "",
                       "leave it out; --cpus sets the threads of each shard");
    }
  }
  Program trial("", "", "");
  add_shared_commands(trial);
  std::vector<std::string> all = words;
  all.insert(all.end(), {"--shard", "1/1", "--out", "."});
  try {
    load_inputs(trial.parse(all).text("FIT"));
  } catch (const UsageError& error) {
    throw InputError({}, error.what(), "", "");
  }
}

void write_scripts(ClusterJob job, const std::vector<std::string>& words) {
  require_valid(words);
  require_writable_folder(job.out);
  job.recoil = fs::read_symlink("/proc/self/exe");
  job.where = fs::current_path();
  job.folder = fs::absolute(job.out).lexically_normal();
  if (!job.folder.has_filename()) job.folder = job.folder.parent_path();
  const std::string name = job.folder.string();
  if (name.find_first_of("\"'\\%\n\t") != std::string::npos) {
    throw InputError({name}, "this folder cannot be named in the scripts",
                     "its path has a quote, a backslash, a percent sign, a tab or a line break",
                     "choose another folder");
  }
  job.words = words;
  const std::vector<WholeFile> scripts = cluster_scripts(job);
  write_whole_files(scripts);
  for (const WholeFile& file : scripts) {
    if (file.path.extension() == ".sh") {
      fs::permissions(file.path,
                      fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                      fs::perm_options::add);
    }
    print_text("{}: written\n", (fs::path(job.out) / file.path.filename()).string());
  }
  constexpr std::size_t usual_limit = 1000;  // MaxArraySize - 1 of slurm.conf(5)
  if (job.system == "slurm" && job.shards > usual_limit) {
    print_text("note: Slurm takes at most {} shards where its MaxArraySize is the usual {}\n",
               usual_limit, usual_limit + 1);
  }
  print_text("To start the job: sh {}\n", shell_word((fs::path(job.out) / "run.sh").string()));
}

}  // namespace

void add_cluster(Program& program) {
  program.command_with_other_words(
      "cluster", "write scripts that run a command in shards on a cluster and merge the shards", R"(
Give a fit file, or a command with its options: fit, coverage or diagnose. You can edit the
scripts. All machines must find the folder, the program and the data under the same paths.

  recoil cluster slurm my.toml --replicates 1000000 --shards 100 --out big
  recoil cluster parallel coverage my.toml --datasets 10000 --shards 40 --out big)",
      [](const GivenOptions& given) {
        ClusterJob job;
        job.system = given.text("SYSTEM");
        job.shards = static_cast<std::size_t>(given.whole("--shards"));
        job.out = given.text("--out");
        job.cpus = static_cast<int>(given.whole("--cpus"));
        job.time = given.text("--time");
        write_scripts(job, words_of_job(given.other_words));
      });
}

}  // namespace recoil
