#include "plot/draw.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cstring>
#include <string_view>
#include <vector>

#include "core/child.hpp"
#include "core/error.hpp"
#include "plot/gnuplot_script.hpp"
#include "plot/inline_svg.hpp"

namespace recoil::plot {
namespace {

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

std::string run_gnuplot(const std::string& script, const std::string& program,
                        std::chrono::milliseconds limit) {
  const ChildOutcome child = run_child({program, "-d"}, script, limit);  // -d: no user's settings
  if (child.failed != 0) {
    throw ComputationError(
        fmt::format("gnuplot cannot be started: {} ({}); install the package gnuplot-nox",
                    std::strerror(child.failed), program));
  }
  if (child.timed_out) {
    throw ComputationError(fmt::format("gnuplot did not end within {} s and was stopped",
                                       std::chrono::duration<double>(limit).count()));
  }
  if (child.status != 0) {
    throw ComputationError(fmt::format("gnuplot failed on a plot: {}", complaint(child.err)));
  }
  return child.out;
}

void require_gnuplot() {
  if (is_installed("gnuplot")) return;
  throw InputError({}, "gnuplot is not installed", "it draws the pictures",
                   "install the package gnuplot-nox");
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
