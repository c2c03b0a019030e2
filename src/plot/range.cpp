#include "plot/range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace recoil::plot {
namespace {

std::string superscript(int number) {
  static constexpr std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴",
                                                         "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out;
  for (const char c : fmt::format("{}", number)) {
    out += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  }
  return out;
}

}  // namespace

Range range_of(const std::vector<double>& values, double margin) {
  Range range{INFINITY, -INFINITY};
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    range.lower = std::min(range.lower, value);
    range.upper = std::max(range.upper, value);
  }
  if (!(range.lower <= range.upper)) return {};
  double width = range.width();
  if (!(width > 0.0)) width = range.upper != 0.0 ? std::abs(range.upper) : 1.0;
  return {range.lower - margin * width, range.upper + margin * width};
}

Range log_range_of(const std::vector<double>& values, double margin) {
  std::vector<double> logs;
  for (const double value : values) {
    if (value > 0.0) logs.push_back(std::log10(value));
  }
  const Range range = range_of(logs, margin);
  return {std::pow(10.0, range.lower), std::pow(10.0, range.upper)};
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

Scaling scaling_for(double magnitude, const std::string& unit) {
  if (!(magnitude > 0.0) || !std::isfinite(magnitude)) return {1.0, unit};
  if (magnitude >= 0.1 && magnitude < 1000.0) return {1.0, unit};
  const int power = 3 * static_cast<int>(std::floor(std::log10(magnitude) / 3.0));
  return {std::pow(10.0, -power), fmt::format("10{} {}", superscript(power), unit)};
}

}  // namespace recoil::plot
