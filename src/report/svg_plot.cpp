#include "report/svg_plot.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/error.hpp"
#include "document/html.hpp"
#include "report/svg_tidy.hpp"

extern char** environ;

namespace recoil {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
/// An open file without a name: it is gone with the process, however that ends.
using NamelessFile = std::unique_ptr<std::FILE, CloseFile>;

NamelessFile nameless_file() {
  NamelessFile file(std::tmpfile());
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
  if (line.size() > longest) line = "... " + line.substr(line.size() - longest);
  return line;
}

std::string run_gnuplot(const std::string& script, const std::string& program) {
  const NamelessFile in = nameless_file();
  const NamelessFile out = nameless_file();
  const NamelessFile err = nameless_file();
  if (std::fwrite(script.data(), 1, script.size(), in.get()) != script.size() ||
      std::fflush(in.get()) != 0) {
    throw ComputationError("the script for gnuplot cannot be written (is the disk full?)");
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

}  // namespace

std::string draw_svg(const PlotScript& script, const std::string& program) {
  std::string plain_name = script.name;  // gnuplot takes letters, digits and '_' only
  std::replace(plain_name.begin(), plain_name.end(), '-', '_');
  const std::string head = fmt::format(
      "set terminal svg size {},{} dynamic enhanced font 'DejaVu Sans,13' name '{}' "
      "background '#ffffff'\nset encoding utf8\n",
      script.width, script.height, plain_name);
  std::string svg = run_gnuplot(head + script.commands + "\n", program);

  const std::size_t begin = svg.find("<g id=\"gnuplot_canvas\">");
  if (begin == std::string::npos) throw ComputationError("gnuplot drew nothing");
  svg.erase(0, begin);
  while (!svg.empty() && std::isspace(static_cast<unsigned char>(svg.back())) != 0) svg.pop_back();

  tidy_svg(svg, script.name);
  const std::string label = escape_html(script.title);
  return fmt::format(
      "<svg id=\"{0}\" viewBox=\"0 0 {1} {2}\" width=\"100%\" role=\"img\" aria-label=\"{3}\" "
      "font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, sans-serif\" "
      "xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n"
      "<title>{3}</title>\n{4}\n",
      script.name, script.width, script.height, label, svg);
}

std::string gnuplot_text(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += ' ';
    } else if (c == '\'') {
      out += "''";
    } else {
      if (std::strchr("\\{}^_@&~", c) != nullptr) out += '\\';
      out += c;
    }
  }
  return out + "'";
}

std::string data_block(const std::string& name, const std::vector<std::vector<double>>& rows) {
  std::string out = fmt::format("${} << EOD\n", name);
  for (const std::vector<double>& row : rows) {
    const char* separator = "";
    for (const double value : row) {
      out += separator;
      out += std::isfinite(value) ? fmt::format("{:.7g}", value) : "NaN";
      separator = " ";
    }
    out += '\n';
  }
  if (rows.empty()) out += "NaN NaN NaN NaN NaN\n";
  return out + "EOD\n";
}

std::string log_ticks(char axis, double lower, double upper) {
  const double decades = std::log10(upper / lower);
  std::vector<double> steps = {1.0};
  if (decades <= 2.6) steps = {1.0, 2.0, 5.0};
  if (decades <= 0.8) steps = {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
  std::string list;
  const int last = static_cast<int>(std::ceil(std::log10(upper)));
  for (int power = static_cast<int>(std::floor(std::log10(lower))); power <= last; ++power) {
    for (const double step : steps) {
      const double value = step * std::pow(10.0, power);
      if (value < lower * 0.999 || value > upper * 1.001) continue;
      list += fmt::format("{}'{:g}' {:.6g}", list.empty() ? "" : ", ", value, value);
    }
  }
  return list.empty() ? std::string() : fmt::format("set {}tics ({})\n", axis, list);
}

std::string plot_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front())) != 0) {
    name = "f-" + name;
  }
  return name;
}

}  // namespace recoil
