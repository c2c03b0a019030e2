#include "plot/draw.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "plot/gnuplot.hpp"
#include "plot/gnuplot_script.hpp"
#include "plot/inline_svg.hpp"

namespace recoil::plot {

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
