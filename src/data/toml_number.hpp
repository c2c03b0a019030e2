#pragma once

#include <toml++/toml.h>

#include <optional>

namespace recoil {

/// The finite number that `node` holds, nothing for nan, inf or another type. A whole number beyond
/// 2^53 becomes the nearest double, as it would in a table of points; toml++ itself gives nothing.
std::optional<double> finite_number(const toml::node& node);

}  // namespace recoil
