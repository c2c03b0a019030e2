#include "data/toml_number.hpp"

#include <cmath>

namespace recoil {

std::optional<double> finite_number(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
  const auto* value = node.as_floating_point();
  if (value == nullptr || !std::isfinite(value->get())) return std::nullopt;
  return value->get();
}

}  // namespace recoil
