#include "support/started.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <fstream>
#include <string>
#include <thread>

namespace support {

Started::Started(std::vector<std::string> arguments, const std::filesystem::path& folder) {
  arguments.insert(arguments.begin(), RECOIL_BINARY);
  std::vector<char*> argv;
  for (std::string& word : arguments) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::string out = outputs_ / "out";
  const std::string err = outputs_ / "err";
  child_ = fork();
  if (child_ != 0) return;
  dup2(open("/dev/null", O_RDONLY), 0);
  dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
  dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
  std::signal(SIGINT, SIG_DFL);  // a test run in the background would hand down "ignore"
  if (chdir(folder.c_str()) != 0) _exit(127);
  execv(argv[0], argv.data());
  _exit(127);
}

Started::~Started() {
  if (!runs()) return;
  send(SIGKILL);
  end();
}

void Started::send(int signal) const {
  if (!ended_) kill(child_, signal);
}

bool Started::runs() {
  if (!ended_) ended_ = waitpid(child_, &status_, WNOHANG) == child_;
  return !ended_;
}

bool Started::wait_until(const std::function<bool()>& happened) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (!happened()) {
    if (!runs() || std::chrono::steady_clock::now() > limit) return happened();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

bool Started::wait_until_worked(std::chrono::milliseconds time) {
  clockid_t clock = 0;
  if (clock_getcpuclockid(child_, &clock) != 0) return false;
  return wait_until([&] {
    timespec worked{};
    return clock_gettime(clock, &worked) == 0 &&
           std::chrono::seconds(worked.tv_sec) + std::chrono::nanoseconds(worked.tv_nsec) >= time;
  });
}

bool Started::wait_until_it_catches(int signal) {
  const std::string file = "/proc/" + std::to_string(child_) + "/status";
  return wait_until([&] {
    std::ifstream status(file);
    for (std::string line; std::getline(status, line);) {
      if (!line.starts_with("SigCgt:")) continue;
      return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1U) != 0;
    }
    return false;
  });
}

int Started::signal() const { return WIFSIGNALED(status_) ? WTERMSIG(status_) : 0; }

Outcome Started::end() {
  if (!ended_) waitpid(child_, &status_, 0);
  ended_ = true;
  return {WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_), outputs_.read("out"),
          outputs_.read("err")};
}

}  // namespace support
