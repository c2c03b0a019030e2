#include "estimate/scheme.hpp"

#include <algorithm>

namespace recoil {

const std::vector<std::string>& scheme_names() {
  static const std::vector<std::string> names = {"auto", "parametric", "residual",
                                                 "wild", "case",       "cluster"};
  return names;
}

std::string to_string(Scheme scheme) { return scheme_names()[static_cast<std::size_t>(scheme)]; }

std::optional<Scheme> scheme_named(const std::string& name) {
  const auto found = std::find(scheme_names().begin(), scheme_names().end(), name);
  if (found == scheme_names().end()) return std::nullopt;
  return static_cast<Scheme>(found - scheme_names().begin());
}

}  // namespace recoil
