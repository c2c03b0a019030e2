#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/units.hpp"

/// The words of the command line: values with units, errors, lists.
namespace recoil {

/// "4.9um", "4.9 um" -> 4.9e-6. @param option names it in messages: "--diameter"
/// @throws InputError when it is no number with a unit of this dimension.
double value_with_unit(const std::string& word, Dimension dimension, const std::string& option);

/// One standard deviation, relative to the value or absolute.
struct StatedError {
  double relative = 0.0;  ///< [1]
  double absolute = 0.0;  ///< SI

  bool stated() const { return relative > 0.0 || absolute > 0.0; }
  double of(double value) const { return relative * value + absolute; }
};

/// "2%" is relative, "0.5mm" absolute; nothing stated for an empty word. Restitutions are given
/// without a unit. @throws InputError
StatedError stated_error(const std::string& word, Dimension dimension, const std::string& option);

/// Splits at commas that are not inside quotation marks, blanks around the parts dropped.
std::vector<std::string> split_list(std::string_view text);

/// "name=value" at the first '='; nothing when there is none.
std::optional<std::pair<std::string, std::string>> split_pair(const std::string& word);

}  // namespace recoil
