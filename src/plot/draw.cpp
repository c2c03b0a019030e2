#include "plot/draw.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "plot/gnuplot_script.hpp"
#include "plot/inline_svg.hpp"

extern char** environ;

namespace recoil::plot {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
/// An open file in memory: it is gone with the process, however that ends, and no disk that is full
/// cuts a picture short.
using NamelessFile = std::unique_ptr<std::FILE, CloseFile>;

NamelessFile nameless_file() {
  const int descriptor = memfd_create("gnuplot", MFD_CLOEXEC);
  NamelessFile file(descriptor < 0 ? nullptr : fdopen(descriptor, "w+"));
  if (!file) {
    throw ComputationError(fmt::format("no temporary file for gnuplot: {}", std::strerror(errno)));
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

/// The environment with numbers in the C locale and names in UTF-8, whatever the user's is.
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

class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  void connect(std::FILE* file, int descriptor) {
    posix_spawn_file_actions_adddup2(&actions_, fileno(file), descriptor);
  }
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_;
};

/// gnuplot's complaint on one line, without its prompt and pointer lines.
std::string complaint(const std::string& errors) {
  std::string line;
  for (const char c : errors) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (blank && (line.empty() || line.back() == ' ')) continue;
    line += blank ? ' ' : c;
  }
  constexpr std::size_t longest = 400;
  if (line.size() > longest) line.replace(0, line.size() - longest, "... ");
  return line;
}

}  // namespace

std::string run_gnuplot(const std::string& script, const std::string& program) {
  const NamelessFile in = nameless_file();
  const NamelessFile out = nameless_file();
  const NamelessFile err = nameless_file();
  if (std::fwrite(script.data(), 1, script.size(), in.get()) != script.size() ||
      std::fflush(in.get()) != 0) {
    throw ComputationError("the script for gnuplot cannot be kept in memory");
  }
  std::rewind(in.get());

  FileActions actions;
  actions.connect(in.get(), STDIN_FILENO);
  actions.connect(out.get(), STDOUT_FILENO);
  actions.connect(err.get(), STDERR_FILENO);
  std::string name = program;
  std::string no_user_settings = "-d";
  char* const arguments[] = {name.data(), no_user_settings.data(), nullptr};
  std::vector<std::string> variables = plain_environment();
  std::vector<char*> environment;
  for (std::string& variable : variables) environment.push_back(variable.data());
  environment.push_back(nullptr);

  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, program.c_str(), actions.get(), nullptr, arguments, environment.data());
  if (failed != 0) {
    throw ComputationError(
        fmt::format("gnuplot cannot be started: {} ({}); install the package gnuplot-nox",
                    std::strerror(failed), program));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw ComputationError("gnuplot was lost before it ended");
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw ComputationError(
        fmt::format("gnuplot failed on a plot: {}", complaint(contents(err.get()))));
  }
  return contents(out.get());
}

std::vector<std::string> draw_svg(const std::vector<const Picture*>& pictures,
                                  const std::string& program) {
  std::vector<std::string> drawn;
  if (pictures.empty()) return drawn;
  const std::string output = run_gnuplot(gnuplot_script(pictures), program);
  constexpr std::string_view prolog = "<?xml";
  for (std::size_t at = output.find(prolog); at != std::string::npos;) {
    const std::size_t next = output.find(prolog, at + prolog.size());
    if (drawn.size() < pictures.size()) {
      drawn.push_back(
          inline_svg(std::string_view(output).substr(at, next - at), *pictures[drawn.size()]));
    }
    at = next;
  }
  if (drawn.size() != pictures.size()) {
    throw ComputationError(
        fmt::format("gnuplot drew {} of {} pictures", drawn.size(), pictures.size()));
  }
  return drawn;
}

std::string draw_svg(const Picture& picture, const std::string& program) {
  return draw_svg(std::vector<const Picture*>{&picture}, program).front();
}

}  // namespace recoil::plot
