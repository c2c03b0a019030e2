#include "validation/studies/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>
#include <thread>

#include "core/error.hpp"
#include "core/interrupt.hpp"

extern char** environ;

namespace recoil {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
/// An open file in memory; it exists as long as it is open.
using MemoryFile = std::unique_ptr<std::FILE, CloseFile>;

MemoryFile memory_file() {
  const int descriptor = memfd_create("recoil", MFD_CLOEXEC);
  MemoryFile file(descriptor < 0 ? nullptr : fdopen(descriptor, "w+"));
  if (!file) {
    throw ComputationError(fmt::format("no temporary file in memory: {}", std::strerror(errno)));
  }
  return file;
}

std::string contents(std::FILE* file) {
  std::rewind(file);
  std::string text;
  char buffer[65536];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) {
    text.append(buffer, n);
  }
  return text;
}

/// The environment of this process with the locale C.UTF-8.
std::vector<std::string> plain_environment() {
  std::vector<std::string> variables;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view variable(*entry);
    if (variable.starts_with("LC_") || variable.starts_with("LANG") ||
        variable.starts_with("GNU")) {
      continue;
    }
    variables.emplace_back(variable);
  }
  variables.emplace_back("LC_ALL=C.UTF-8");
  return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Starts a program. @return 0, or the errno of the failure
int start(pid_t& child, std::vector<std::string> words, std::FILE* in, std::FILE* out,
          std::FILE* err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(in), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(out), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(err), STDERR_FILENO);
  std::vector<std::string> variables = plain_environment();
  const int failed = posix_spawnp(&child, words.front().c_str(), &actions, nullptr,
                                  pointers_to(words).data(), pointers_to(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  return failed;
}

}  // namespace

ChildOutcome run_child(const std::vector<std::string>& words, const std::string& input,
                       std::chrono::milliseconds limit) {
  using Clock = std::chrono::steady_clock;
  constexpr auto longest_nap = std::chrono::milliseconds(20);
  const MemoryFile in = memory_file();
  const MemoryFile out = memory_file();
  const MemoryFile err = memory_file();
  if (std::fwrite(input.data(), 1, input.size(), in.get()) != input.size() ||
      std::fflush(in.get()) != 0) {
    throw ComputationError("there is not enough memory for the input of " + words.front());
  }
  std::rewind(in.get());
  ChildOutcome outcome;
  pid_t child = 0;
  outcome.failed = start(child, words, in.get(), out.get(), err.get());
  if (outcome.failed != 0) return outcome;
  const Clock::time_point end = Clock::now() + limit;
  int status = 0;
  bool stop = false;
  for (auto nap = std::chrono::milliseconds(1);; nap = std::min(2 * nap, longest_nap)) {
    const pid_t ended = waitpid(child, &status, stop ? 0 : WNOHANG);
    if (ended == child || (ended < 0 && errno != EINTR)) break;
    outcome.timed_out = Clock::now() > end;
    stop = outcome.timed_out || called_off();
    if (stop) {
      kill(child, SIGKILL);
    } else {
      std::this_thread::sleep_for(nap);
    }
  }
  if (stop && !outcome.timed_out) throw CalledOff();
  if (WIFEXITED(status)) outcome.status = WEXITSTATUS(status);
  outcome.out = contents(out.get());
  outcome.err = contents(err.get());
  return outcome;
}

}  // namespace recoil
