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
#include <optional>

#include "core/error.hpp"
#include "report/html_page.hpp"

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

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

/// Removes every `open`...`close`, both included.
void remove_between(std::string& text, std::string_view open, std::string_view close) {
  for (std::size_t at = 0; (at = text.find(open, at)) != std::string::npos;) {
    const std::size_t end = text.find(close, at);
    if (end == std::string::npos) return;
    text.erase(at, end + close.size() - at);
  }
}

/// Removes the groups that gnuplot opens and closes without drawing.
void remove_empty_groups(std::string& text) {
  constexpr std::string_view close = "</g>\n";
  for (std::size_t at = 0; (at = text.find("<g fill", at)) != std::string::npos;) {
    const std::size_t end = text.find(">\n", at);
    if (end != std::string::npos && text.compare(end + 2, close.size(), close) == 0) {
      text.erase(at, end + 2 + close.size() - at);
    } else {
      ++at;
    }
  }
}

/// Markers and filters that are defined but not used.
void remove_unused_definitions(std::string& text) {
  remove_between(text, "\t<filter", "</filter>\n");
  for (int marker = 14; marker >= 0; --marker) {  // downwards: a marker may use a lower one
    if (text.find(fmt::format("href='#gpPt{}'", marker)) != std::string::npos) continue;
    const std::size_t id = text.find(fmt::format("id='gpPt{}'", marker));
    if (id == std::string::npos) continue;
    const std::size_t begin = text.rfind('\n', id) + 1;
    text.erase(begin, text.find('\n', id) + 1 - begin);
  }
}

/// "rgb( 34,  34,  34)" as "#222222".
void shorten_colours(std::string& text) {
  for (std::size_t at = 0; (at = text.find("rgb(", at)) != std::string::npos; ++at) {
    int red = 0;
    int green = 0;
    int blue = 0;
    int length = 0;
    if (std::sscanf(text.c_str() + at, "rgb(%d,%d,%d)%n", &red, &green, &blue, &length) == 3 &&
        length > 0) {
      text.replace(at, static_cast<std::size_t>(length),
                   fmt::format("#{:02x}{:02x}{:02x}", red, green, blue));
    }
  }
}

/// One filled circle as gnuplot draws it.
struct Dot {
  double x = 0.0, y = 0.0, radius = 0.0;
  std::string colour;
};

std::optional<Dot> dot_in(const std::string& line) {
  Dot dot;
  char colour[16] = {};
  int length = 0;
  constexpr const char* form =
      " <use xlink:href='#gpPt6' transform='translate(%lf,%lf) scale(%lf)' "
      "color='%15[#0-9a-f]'/>%n";
  if (std::sscanf(line.c_str(), form, &dot.x, &dot.y, &dot.radius, colour, &length) != 4 ||
      length != static_cast<int>(line.size())) {
    return std::nullopt;
  }
  dot.colour = colour;
  return dot;
}

/// Clouds of equal dots as one path each: strokes without length and with round ends, a sixth of
/// the text.
void pack_dots(std::string& text) {
  constexpr std::size_t fewest = 3;
  std::string out;
  std::string pending;  // the lines of a run, should it stay short
  std::string path;
  std::size_t count = 0;
  Dot first;
  const auto flush = [&] {
    if (count >= fewest) {
      out +=
          fmt::format("<path stroke='{}' stroke-width='{:.2f}' stroke-linecap='round' d='{}'/>\n",
                      first.colour, 2.0 * first.radius, path);
    } else {
      out += pending;
    }
    pending.clear();
    path.clear();
    count = 0;
  };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    const std::string line = text.substr(at, end - at);
    at = end;
    const std::optional<Dot> dot = dot_in(line.substr(0, line.find('\n')));
    const bool joins =
        dot && count > 0 && dot->colour == first.colour && dot->radius == first.radius;
    if (!joins) flush();
    if (!dot) {
      out += line;
      continue;
    }
    if (count == 0) first = *dot;
    pending += line;
    path += fmt::format("M{:.1f},{:.1f}h0", dot->x, dot->y);
    ++count;
  }
  flush();
  text = std::move(out);
}

/// Coordinate pairs "76.00,198.18" with one decimal, which is a tenth of a pixel.
void shorten_coordinates(std::string& text) {
  const auto digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool before = text[i] == ',' && i >= 4 && digit(i - 1) && digit(i - 2) &&
                        text[i - 3] == '.' && digit(i - 4);
    std::size_t end = i + 1;
    while (before && digit(end)) ++end;
    const bool after = before && end > i + 1 && end < text.size() && text[end] == '.' &&
                       digit(end + 1) && digit(end + 2) && !digit(end + 3);
    if (!after) {
      out += text[i];
      continue;
    }
    out.pop_back();
    out += text.substr(i, end + 2 - i);
    i = end + 2;
  }
  text = std::move(out);
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

  remove_between(svg, "<title>", "</title>");
  remove_empty_groups(svg);
  // What every group repeats is said once, on the canvas.
  constexpr std::string_view common = " fill=\"none\" color=\"black\" stroke=\"currentColor\"";
  replace_all(svg, fmt::format("<g{} stroke-width", common), "<g stroke-width");
  replace_all(svg, "<g id=\"gnuplot_canvas\"", fmt::format("<g id=\"gnuplot_canvas\"{}", common));
  replace_all(svg, "<rect ", "<rect stroke=\"none\" ");  // the background has no rim
  replace_all(svg, " class=\"gridline\" ", "");
  shorten_colours(svg);
  pack_dots(svg);
  shorten_coordinates(svg);
  remove_unused_definitions(svg);
  replace_all(svg, " font-family=\"DejaVu Sans\" ", " ");
  replace_all(svg, "<tspan >", "<tspan>");
  replace_all(svg, " stroke-linecap=\"butt\" stroke-linejoin=\"miter\"", "");  // the defaults
  replace_all(svg, "\"gnuplot_canvas\"", fmt::format("\"{}-canvas\"", script.name));
  replace_all(svg, "'gp", fmt::format("'{}-gp", script.name));
  replace_all(svg, "'#gp", fmt::format("'#{}-gp", script.name));
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
