#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/units.hpp"

namespace recoil {

/// What the value of an option is.
struct OptionType {
  std::string value;                        ///< its name in the help: "DIR"; empty: a flag
  std::string python;                       ///< type of the keyword argument in Python
  std::vector<std::string> words = {};      ///< the accepted words; empty: no list
  bool whole = false;                       ///< a whole number
  std::optional<Dimension> dimension = {};  ///< of a quantity
  std::string unit = {};                    ///< of a number without a unit
  double lowest = 0.0, highest = 0.0;       ///< of a number, in `unit`
  std::size_t least = 1, most = 1;          ///< number of values
  bool commas = false;  ///< several values are separated by commas; otherwise the option repeats
  /// A check beyond the above: what is expected instead of a text; empty if it is right. May throw
  /// InputError.
  std::function<std::string(const std::string&)> check = {};

  bool is_flag() const { return value.empty(); }
  bool is_number() const { return whole || dimension.has_value(); }
};

/// The types of the table of options.
namespace takes {

/// The largest number of values of one option.
inline constexpr std::size_t many = 100000;

/// No value: the option is there or not.
OptionType nothing();
OptionType text(const std::string& value);
OptionType path(const std::string& value);
OptionType one_of(const std::vector<std::string>& words);
/// A whole number in decimal digits.
OptionType whole(double lowest, double highest);
/// A number with or without a unit of `dimension`. @param unit of a number without one
OptionType quantity(Dimension dimension, const std::string& unit, double lowest, double highest);
/// A number, or per cent.
OptionType number(double lowest, double highest);
/// A path of a file that exists; the message names a similar one.
OptionType fit_file();
/// "3/40": a shard.
OptionType shard();
/// "01:30:00": the time limit of a shard.
OptionType clock_time();
/// "NAME=VALUE", several separated by commas. @param value the form: "FIELD=UNIT"
OptionType assignments(const std::string& value);

/// `least` to `most` values of `type` separated by commas. @param value the form: "MIN,MAX"
OptionType list(OptionType type, const std::string& value, std::size_t least, std::size_t most);
/// One value each time that the option is given; of an argument, one word after the other.
OptionType repeated(OptionType type, std::size_t least = 1, std::size_t most = many);
/// A value of `type`, or this word.
OptionType or_word(OptionType type, const std::string& word);

}  // namespace takes

/// How help and manual name the value: "DIR", "NUMBER from 0 to 1 m/s", "`one`, `mean`".
std::string value_words(const OptionType& type);

/// What is expected instead of `text`, "a whole number from 1 to 4096"; empty if it is right.
/// @throws InputError for a file that does not exist
std::string expected_instead(const OptionType& type, const std::string& text);

/// The value of a quantity or a ratio in SI. @pre expected_instead(type, text) is empty
double number_of(const OptionType& type, const std::string& text);

}  // namespace recoil
