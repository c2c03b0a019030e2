#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/names.hpp"

namespace recoil {

/// How the number of bins is found.
enum class HistogramRule { sturges, freedman_diaconis };

template <>
struct NamesOf<HistogramRule> {
  static constexpr std::array<std::string_view, 2> names = {"sturges", "freedman-diaconis"};
};

/// Counts in bins of equal width from the smallest to the largest value.
struct Histogram {
  HistogramRule rule = HistogramRule::sturges;
  double lower = 0.0;
  double width = 1.0;
  std::vector<std::size_t> counts;

  double edge(std::size_t bin) const { return lower + width * static_cast<double>(bin); }
  double middle(std::size_t bin) const { return lower + width * (static_cast<double>(bin) + 0.5); }
};

/// Sturges' rule: 1 + log2(n) bins, rounded up (Sturges 1926, J. Am. Stat. Assoc. 21, 65-66). The
/// rule of the paper; too coarse for more than a few hundred values or several peaks.
Histogram sturges(const std::vector<double>& values);

/// The rule of Freedman & Diaconis (1981, Z. Wahrscheinlichkeitstheorie 57, 453-476): bins of width
/// 2 (q75 - q25) n^(-1/3), at most 2000 of them; Sturges' number when the quartiles coincide.
Histogram freedman_diaconis(const std::vector<double>& values);

}  // namespace recoil
