#include "cli/cluster_scripts.hpp"

#include <fmt/format.h>

#include <charconv>

#include "export/filled.hpp"

namespace recoil {
namespace {

const char* const shard_script = R"(#!/bin/sh
# One of @SHARDS@ shards: sh shard.sh NUMBER, from 1. It leaves one file in the folder, whole or not at
# all; to run it twice, or where it was killed, costs nothing but its time.
number=$1
folder=@FOLDER@
cd @WHERE@ || exit 1
# Input that was refused (exit status 2) would be refused again.
[ -e "$folder/refused-$number" ] && exit 2
@RECOIL@ @WORDS@ \
  --shard "$number/@SHARDS@" --out "$folder" --threads "${SLURM_CPUS_PER_TASK:-@CPUS@}" &
child=$!
# A time limit or an eviction: recoil keeps what is finished and ends. Some systems send SIGTERM to
# every process and some to this one alone; beside a SIGTERM, SIGUSR1 counts as the same request.
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
# Starts the job: sh run.sh. It submits the shards that are missing, and itself to run after them,
# whatever became of them; once none is missing it merges them. Started again it goes on.
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
missing=--array=1-@SHARDS@
if ls "$folder"/part-*.jsonl >/dev/null 2>&1; then
  missing=$("$recoil" merge "$folder" --missing) || exit
fi
if [ -z "$missing" ]; then
  exec "$recoil" merge "$folder" --threads "${SLURM_CPUS_PER_TASK:-@CPUS@}" >"$folder/result.txt"
fi
if [ "$round" -gt "$rounds" ]; then
  echo "after $rounds rounds these are missing: $missing" >&2
  exit 3
fi
echo "round $round: $missing"
job=$(sbatch --parsable "$missing" "$folder/array.sbatch") || exit
# afterany: a merge that waits for success (afterok) waits for ever once a shard has failed
sbatch --dependency="afterany:${job%%;*}" "$folder/run.sh" $((round + 1))
)";

const char* const merge_script = R"(#!/bin/sh
# Puts the parts together; what is missing is told, and run again by starting the job again.
cd @WHERE@ || exit 1
@RECOIL@ merge @FOLDER@ >@FOLDER@/result.txt
)";

const char* const parallel_run = R"(#!/bin/sh
# Starts the job: sh run.sh. Shards that are there are not run again. For several machines give
# parallel their names (--sshlogin, --sshloginfile); they share this folder.
folder=@FOLDER@
seq @SHARDS@ | parallel --jobs @JOBS@ --retries 5 --joblog "$folder/parallel.log" \
  "sh '$folder/shard.sh' {} >>'$folder/log-{}.txt' 2>&1"
exec sh "$folder/merge.sh"
)";

std::string clock_time(long seconds) {
  return fmt::format("{:02}:{:02}:{:02}", seconds / 3600, seconds / 60 % 60, seconds % 60);
}

}  // namespace

std::optional<long> seconds_named(std::string_view text) {
  const auto number = [](std::string_view digits) -> std::optional<long> {
    long value = 0;
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, value);
    if (digits.empty() || digits.size() > 4 || read.ec != std::errc{} || read.ptr != end ||
        value < 0) {
      return std::nullopt;
    }
    return value;
  };
  if (text.size() < 7 || text[text.size() - 3] != ':' || text[text.size() - 6] != ':') {
    return std::nullopt;
  }
  const auto hours = number(text.substr(0, text.size() - 6));
  const auto minutes = number(text.substr(text.size() - 5, 2));
  const auto seconds = number(text.substr(text.size() - 2));
  if (!hours || !minutes || !seconds || *minutes > 59 || *seconds > 59) return std::nullopt;
  return 3600 * *hours + 60 * *minutes + *seconds;
}

std::string shell_word(std::string_view word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=,:+%@").find(c) != std::string_view::npos;
  };
  bool safe = !word.empty();
  std::string quoted = "'";
  for (const char c : word) {
    safe = safe && plain(c);
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return safe ? std::string(word) : quoted + "'";
}

std::vector<ClusterFile> cluster_scripts(const ClusterJob& job) {
  std::string words;
  for (const std::string& word : job.words) words += (words.empty() ? "" : " ") + shell_word(word);
  const std::string shards = fmt::format("{}", job.shards);
  const std::string cpus = fmt::format("{}", job.cpus);
  const std::string plain_folder = job.folder.string();
  const std::string folder = shell_word(plain_folder);
  const std::string where = shell_word(job.where.string());
  const std::string recoil = shell_word(job.recoil.string());
  std::vector<ClusterFile> files = {{"shard.sh", filled(shard_script, {{"SHARDS", shards},
                                                                       {"FOLDER", folder},
                                                                       {"WHERE", where},
                                                                       {"RECOIL", recoil},
                                                                       {"WORDS", words},
                                                                       {"CPUS", cpus}})}};
  if (job.system == ClusterSystem::slurm) {
    files.push_back({"array.sbatch", filled(slurm_array, {{"SHARDS", shards},
                                                          {"CPUS", cpus},
                                                          {"TIME", clock_time(job.seconds)},
                                                          {"AT", "@"},
                                                          {"PLAIN_FOLDER", plain_folder},
                                                          {"FOLDER", folder}})});
    files.push_back({"run.sh", filled(slurm_run, {{"SHARDS", shards},
                                                  {"CPUS", cpus},
                                                  {"TIME", clock_time(job.seconds)},
                                                  {"PLAIN_FOLDER", plain_folder},
                                                  {"FOLDER", folder},
                                                  {"RECOIL", recoil}})});
    return files;
  }
  files.push_back({"merge.sh", filled(merge_script,
                                      {{"WHERE", where}, {"RECOIL", recoil}, {"FOLDER", folder}})});
  files.push_back(
      {"run.sh",
       filled(parallel_run, {{"SHARDS", shards},
                             {"FOLDER", folder},
                             {"JOBS", fmt::format("$((($(nproc) + {0} - 1) / {0}))", job.cpus)}})});
  return files;
}

}  // namespace recoil
