#pragma once

#include <span>
#include <string>
#include <string_view>

namespace recoil {

/// A ball of a sport, as its rules state it. A range of the rules is here its middle.
struct TabledBall {
  std::string_view name;
  double diameter = 0.0;  ///< [m]
  double mass = 0.0;      ///< [kg]
  std::string_view source;
};

std::span<const TabledBall> tabled_balls();

/// The ball `name`, with or without the word "ball", in any case, with blanks or hyphens.
/// @throws InputError for an unknown name
const TabledBall& tabled_ball(const std::string& name);

}  // namespace recoil
