#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "document/sentence.hpp"

/// Numbers formatted for readers.
namespace recoil {

/// `value` with at most `count` significant digits, or as a whole number from 10^count to 1e6;
/// "n/a" if it is not finite.
std::string number(double value, int count = 4);

/// `value` with `count` significant digits, including trailing zeros: "1.00". Below 1e-4 and from
/// 1e6 on the same as `number`.
std::string digits(double value, int count);

/// A p-value: "0.43", "0.0021", "< 1e-6".
std::string p_value_text(double p);

/// A fraction in percent: "95 %" for 0.95.
std::string percent(double fraction);

/// The format of a number.
struct Notation {
  std::string (*write)(double value, int digits) = number;
  int digits = 4;        ///< significant digits, or decimals
  double scale = 1.0;    ///< factor applied before formatting
  std::string suffix{};  ///< appended to the number: " %"
};

Notation significant(int digits);
Notation padded(int digits);  ///< significant digits, including trailing zeros
Notation fixed(int decimals);
Notation signed_fixed(int decimals);
Notation scientific(int decimals);
Notation probability();
Notation in_percent(Notation notation, const std::string& suffix = " %");

/// The notation of an estimate, its standard error and its interval: one exponent, and so many
/// decimals that the error has two significant digits. @pre both are finite, the error is positive
Notation beside(double value, double error);

/// `value` in this notation; "n/a" if it is not finite.
std::string text_of(double value, const Notation& notation);

struct NumberRange {
  double lower = std::numeric_limits<double>::quiet_NaN();
  double upper = std::numeric_limits<double>::quiet_NaN();
  Notation notation = padded(4);

  /// "[0.0027, 0.0035]"
  std::string text() const;
  operator Sentence() const { return text(); }
};

/// A value with an optional standard error, unit and interval.
struct Number {
  double value = std::numeric_limits<double>::quiet_NaN();
  Notation notation{};
  double error = 0.0;  ///< standard error, which sets the digits; 0: none, `notation` sets them
  std::string unit{};  ///< empty: none, or stated in the heading of the column
  std::optional<std::pair<double, double>> band{};  ///< its interval, in the same notation

  /// "0.00312 +/- 0.00021 s/m", "(9.30 +/- 0.12)e-5 s/m", "0.853 [0.840, 0.866]"
  Sentence words() const;
  operator Sentence() const { return words(); }
};

template <class Count>
Number whole(Count count) {
  return {static_cast<double>(count), fixed(0)};
}

/// `value` as a number; nullopt if it is missing or not finite.
std::optional<Number> number_if(const std::optional<double>& value, const Notation& notation);

}  // namespace recoil
