#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/error.hpp"

namespace fuzz {

/// Ends the run as a finding when `condition` does not hold.
inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

/// A complaint is one line and short enough to be read.
inline void require_one_line(const std::exception& error) {
  const std::string text = error.what();
  const auto control = [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; };
  require(std::none_of(text.begin(), text.end(), control), "one line of printable text");
  require(text.size() < 1000, "a short message");
}

/// And it says where.
inline void require_grammar(const recoil::InputError& error) {
  require_one_line(error);
  require(!error.where().file.empty(), "the file is named");
  require(error.where().line >= 1 && error.where().column >= 1, "the place is named");
}

}  // namespace fuzz
