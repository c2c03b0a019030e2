#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "document/sentence.hpp"

/// Numbers as people read them.
namespace recoil {

/// `value` with at most `count` significant digits; "n/a" for anything that is not finite.
std::string number(double value, int count = 4);

/// `value` with all of its `count` significant digits, zeros at the end included: "1.00".
std::string digits(double value, int count);

/// A value and its error, the error with two significant digits and both with the same decimals:
/// ("0.00312", "0.00021").
std::pair<std::string, std::string> number_with_error(double value, double error);

/// A p-value for people: "0.43", "0.0021", "< 1e-6".
std::string p_value_text(double p);

/// "95 %" of a level 0.95.
std::string percent(double fraction);

/// How a number is written.
struct Notation {
  enum class Kind { significant, padded, fixed, signed_fixed, scientific, probability };
  Kind kind = Kind::significant;
  int digits = 4;        ///< significant ones, or decimals
  double scale = 1.0;    ///< the number times this is what is written
  std::string suffix{};  ///< directly behind it: " %"
};

inline Notation significant(int digits) { return {Notation::Kind::significant, digits}; }
inline Notation padded(int digits) { return {Notation::Kind::padded, digits}; }
inline Notation fixed(int decimals) { return {Notation::Kind::fixed, decimals}; }
inline Notation signed_fixed(int decimals) { return {Notation::Kind::signed_fixed, decimals}; }
inline Notation scientific(int decimals) { return {Notation::Kind::scientific, decimals}; }
inline Notation probability() { return {Notation::Kind::probability}; }
inline Notation in_percent(Notation of_number) {
  of_number.scale = 100.0;
  of_number.suffix = " %";
  return of_number;
}

std::string text_of(double value, const Notation& notation);

/// From here to there.
struct NumberRange {
  double lower = std::numeric_limits<double>::quiet_NaN();
  double upper = std::numeric_limits<double>::quiet_NaN();
  Notation notation = padded(4);

  /// "[0.0027, 0.0035]"
  std::string text() const;
  operator Sentence() const { return text(); }
};

/// A value, with its standard error and its unit where it has them.
struct Number {
  double value = std::numeric_limits<double>::quiet_NaN();
  Notation notation{};
  double error = 0.0;  ///< one standard deviation; 0: none, and the notation decides the digits
  std::string unit{};  ///< empty where the heading of a column says it
  std::optional<std::pair<double, double>> band{};  ///< in which it lies, in the same notation

  /// "0.00312 +/- 0.00021 s/m", "0.853 [0.840, 0.866]"
  Sentence words() const;
  operator Sentence() const { return words(); }
};

/// A whole number.
template <class Count>
Number whole(Count count) {
  return {static_cast<double>(count), fixed(0)};
}

/// A quantity that may not be known.
std::optional<Number> number_if(const std::optional<double>& value, const Notation& notation);

}  // namespace recoil
