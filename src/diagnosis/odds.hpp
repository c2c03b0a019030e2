#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace recoil {

inline constexpr double most_impacts = 1e6;  ///< that anybody makes
/// ln 99: from these expected log odds on, a cause counts as seen, or as told from another.
inline constexpr double wanted_log_odds = 4.59511985013459;

/// The fewest impacts for which `log_odds(count)`, which rises with them, is what is wanted; none
/// where `most` would not do.
template <class LogOdds>
std::optional<int> fewest_impacts(const LogOdds& log_odds, double most) {
  const auto enough = [&](double count) { return log_odds(count) >= wanted_log_odds; };
  if (!enough(most)) return std::nullopt;
  double few = 0.5;
  double many = most;
  while (many > 1.001 * few && std::ceil(few) < std::ceil(many)) {
    const double middle = std::sqrt(few * many);
    (enough(middle) ? many : few) = middle;
  }
  return std::max(1, static_cast<int>(std::ceil(many)));
}

}  // namespace recoil
