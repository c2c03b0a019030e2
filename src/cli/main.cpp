#include <fcntl.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/numerics.hpp"
#include "core/program.hpp"
#include "core/progress.hpp"
#include "core/quoting.hpp"

namespace recoil {
namespace {

constexpr int wrong_input = 2;
constexpr int no_answer = 3;

/// Opens /dev/null for closed standard streams. Otherwise a result file would get the descriptor of
/// a standard stream, and messages would be written into it. Writing to standard output still
/// fails.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) >= 0 || errno != EBADF) continue;
    if (open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY) != stream) return;
  }
}

int run(const std::vector<std::string>& words) {
  Program program(
      "recoil fits a model of microsphere impact to measured restitution. It states how uncertain "
      "the\n"
      "parameters are and what the model gets wrong. Start with: recoil init DIR, then recoil fit "
      "FIT.",
      "Exit status: 0 success, 2 error in the input or on the command line, 3 no usable result.\n"
      "recoil COMMAND --help shows options and examples. The manual is docs/README.md, in an\n"
      "installation share/doc/recoil/README.md.",
      version());
  add_commands(program);
  try {
    program.run(words);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      throw InputError({}, "the output could not be written", "standard output is full or closed",
                       "");
    }
    return 0;
  } catch (const UsageError& error) {
    print_text(stderr, "recoil: {}\n", error.what());
    return wrong_input;
  } catch (const InputError& error) {
    print_text(stderr, "{}\n", error.what());
    return wrong_input;
  } catch (const Interrupted& stopped) {
    print_text(stderr, "{}\n", stopped.what());
    const int signal = stop_signal();
    std::fflush(nullptr);
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // so that the shell sees the signal
    return 128 + signal;
  } catch (const ComputationError& error) {
    print_text(stderr, "{}\n", error.what());
    return no_answer;
  } catch (const std::filesystem::filesystem_error& error) {  // a path that cannot be used
    const InputError told({error.path1().string()}, error.code().message(), "",
                          "check the path and its permissions");
    print_text(stderr, "{}\n", told.what());
    return wrong_input;
  } catch (const std::bad_alloc&) {
    print_text(stderr, "recoil: not enough memory\n");
    return no_answer;
  } catch (const std::system_error& error) {  // no more threads, for example
    print_text(stderr, "recoil: system error: {}\n", error.what());
    return no_answer;
  } catch (const std::exception& error) {
    print_text(stderr, "recoil: {} (this is a defect of recoil); please report it\n", error.what());
    return no_answer;
  }
}

/// The status of `run`, with a stack of 8 MB even where the limit of the first thread is lower.
int run_with_stack(const std::vector<std::string>& words) {
  constexpr std::size_t enough = 8U << 20U;
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= enough) return run(words);
  pthread_attr_t attributes{};
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, enough);
#ifndef __EMSCRIPTEN__  // a page has one thread
  pthread_setattr_default_np(&attributes);
#endif
  pthread_attr_destroy(&attributes);
  int status = no_answer;
  std::thread([&] { status = run(words); }).join();
  return status;
}

}  // namespace
}  // namespace recoil

int main(int argc, char** argv) {
  recoil::open_standard_streams();
  recoil::gsl_errors_are_values();
  recoil::Progress::show_in_this_process();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that gets too large is an error like a full disk
  return recoil::run_with_stack(std::vector<std::string>(argv + 1, argv + argc));
}
