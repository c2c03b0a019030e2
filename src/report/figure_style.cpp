#include "report/figure_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/svg_plot.hpp"

namespace recoil::style {

std::string preamble() {
  return "set border 3 lc rgb '#555555' lw 1\n"
         "set tics nomirror out scale 0.6,0.3 textcolor rgb '#333333'\n"
         "set grid lc rgb '#e4e4e4' lt 1 lw 0.8\n"
         "set key textcolor rgb '#222222' samplen 1.8 spacing 1.05 height 0.3\n"
         "set tmargin 1.5\nset rmargin 2\nset lmargin 8\n"
         "set errorbars 0\nset pointintervalbox 0\n";
}

std::string title(const std::string& text, const std::string& remark, const char* remark_colour) {
  const bool two = !remark.empty();
  std::string out = fmt::format(
      "set tmargin {}\nset label 1 {} at graph 0, graph 1 left offset 0,{} font ',14' "
      "textcolor rgb '{}'\n",
      two ? 3.4 : 2.2, gnuplot_text(text), two ? 1.9 : 0.8, ink);
  if (two) {
    out += fmt::format(
        "set label 2 {} at graph 0, graph 1 left offset 0,0.7 font ',12' textcolor rgb '{}'\n",
        gnuplot_text(remark), remark_colour);
  }
  return out;
}

std::string key_above() {
  return "set tmargin -1\nset key outside top center horizontal Left reverse samplen 0.8\n";
}

std::string key_below(int rows) {
  return fmt::format("set key outside bottom center vertical Left reverse samplen 1.4 maxrows {}\n",
                     rows);
}

Range range_of(const std::vector<double>& values, double margin) {
  Range range{INFINITY, -INFINITY};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    range.lower = std::min(range.lower, value);
    range.upper = std::max(range.upper, value);
  }
  if (!(range.lower <= range.upper)) return {};
  double width = range.upper - range.lower;
  if (!(width > 0.0)) width = range.upper != 0.0 ? std::abs(range.upper) : 1.0;
  return {range.lower - margin * width, range.upper + margin * width};
}

Range quantile_range(std::vector<double> values, double lower, double upper) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double p) {
    return values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1) + 0.5)];
  };
  return {at(lower), at(upper)};
}

std::string few_ticks(char axis, Range range, int count) {
  const double wanted = (range.upper - range.lower) / count;
  if (!(wanted > 0.0) || !std::isfinite(wanted)) return "";
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  double step = power;
  for (const double part : {2.0, 5.0, 10.0}) {
    if (std::abs(std::log(part * power / wanted)) < std::abs(std::log(step / wanted))) {
      step = part * power;
    }
  }
  return fmt::format("set {}tics {:.6g}\n", axis, step);
}

Scale scale_for(double magnitude, const std::string& unit) {
  if (!(magnitude > 0.0) || !std::isfinite(magnitude)) return {1.0, unit};
  if (magnitude >= 0.1 && magnitude < 1000.0) return {1.0, unit};
  const int power = 3 * static_cast<int>(std::floor(std::log10(magnitude) / 3.0));
  return {std::pow(10.0, -power), fmt::format("10^{{{}}} {}", power, unit)};
}

std::string symbol(const std::string& parameter) {
  if (parameter == "f0") return "f_{0}";
  const auto underscore = parameter.find('_');
  if (underscore == std::string::npos) return parameter;
  return fmt::format("{}_{{{}}}", parameter.substr(0, underscore),
                     parameter.substr(underscore + 1));
}

}  // namespace recoil::style
