#pragma once

#include <array>
#include <string_view>

#include "core/names.hpp"

namespace recoil {

/// How velocities were measured: it decides which errors of the measurement there can be.
enum class Method { unknown, velocimeter, drop_heights, bounce_intervals, video };

/// The words of `recoil.method`.
template <>
struct NamesOf<Method> {
  static constexpr std::array<std::string_view, 5> names = {
      "unknown", "velocimeter", "drop_heights", "bounce_intervals", "video"};
};

}  // namespace recoil
