#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "core/error.hpp"
#include "support/hostile_cases.hpp"

namespace support {

/// A mistake in a file: what is replaced by what, where the complaint points, and a key word of
/// what it says is wrong and of what it suggests.
struct Mistake {
  std::string name;
  std::string old_text;
  std::string new_text;
  std::string begin;  ///< "points.csv:3:7: "
  std::string word;   ///< of the problem or the reason
  std::string hint;   ///< of the suggestion
};

/// The InputError that `action` throws, if it throws one.
template <class Action>
std::optional<recoil::InputError> error_of(const Action& action) {
  try {
    action();
  } catch (const recoil::InputError& error) {
    count_hostile_cases();
    return error;
  }
  return std::nullopt;
}

/// Its line; "no error" when there is none.
template <class Action>
std::string message_of(const Action& action) {
  const auto error = error_of(action);
  return error ? error->what() : "no error";
}

/// `error` points at the place, says what is wrong and what to do, in one line that is short enough
/// to be read.
/// @param folder what is left out of the line before it is compared with `mistake.begin`.
void expect_mistake(const std::optional<recoil::InputError>& error, const Mistake& mistake,
                    const std::string& folder = "");

inline void PrintTo(const Mistake& mistake, std::ostream* out) { *out << mistake.name; }

/// Names the cases of a parameterised test.
inline std::string name_of(const testing::TestParamInfo<Mistake>& info) { return info.param.name; }

}  // namespace support
