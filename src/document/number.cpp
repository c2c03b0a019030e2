#include "document/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace recoil {
namespace {

/// 3e-05 as 3e-5.
std::string without_empty_exponent(std::string text) {
  const auto e = text.find('e');
  if (e != std::string::npos && text.size() == e + 4 && text[e + 2] == '0') text.erase(e + 2, 1);
  return text;
}

/// The exponent of ten of `value` as it reads with `count` significant digits: -1 for 0.09999 with
/// three. `value` is finite.
int written_exponent(double value, int count) {
  const std::string text = fmt::format("{:.{}e}", value, std::max(0, count - 1));
  return std::stoi(text.substr(text.find('e') + 1));
}

}  // namespace

std::string number(double value, int count) {
  if (!std::isfinite(value)) return "n/a";
  if (value == 0.0) return "0";
  if (written_exponent(value, count) >= count && std::abs(value) < 1e6) {
    return fmt::format("{:.0f}", value);
  }
  return without_empty_exponent(fmt::format("{:.{}g}", value, count));
}

std::string digits(double value, int count) {
  if (!std::isfinite(value) || value == 0.0) return number(value, count);
  const int leading = written_exponent(value, count);
  if (leading < -4 || leading > 5) return number(value, count);
  return fmt::format("{:.{}f}", value, std::max(0, count - 1 - leading));
}

std::string p_value_text(double p) {
  if (!std::isfinite(p)) return "n/a";
  return p < 1e-6 ? "< 1e-6" : number(p, 2);
}

std::string percent(double fraction) { return fmt::format("{:.4g} %", 100.0 * fraction); }

Notation beside(double value, double error) {
  const double largest = std::max(std::abs(value), error);
  const int exponent = largest < 1e-4 || largest >= 1e6 ? written_exponent(largest, 2) : 0;
  Notation notation = fixed(std::clamp(exponent + 1 - written_exponent(error, 2), 0, 12));
  notation.write = [](double number, int n) {
    return number == 0.0 ? "0" : fmt::format("{:.{}f}", number, n);
  };
  if (exponent == 0) return notation;
  notation.scale = std::pow(10.0, -exponent);
  notation.suffix = fmt::format("e{}", exponent);
  return notation;
}

Notation significant(int count) { return {number, count}; }
Notation padded(int count) { return {digits, count}; }
Notation fixed(int decimals) {
  return {[](double value, int n) { return fmt::format("{:.{}f}", value, n); }, decimals};
}
Notation signed_fixed(int decimals) {
  return {[](double value, int n) { return fmt::format("{:+.{}f}", value, n); }, decimals};
}
Notation scientific(int decimals) {
  return {[](double value, int n) { return fmt::format("{:.{}e}", value, n); }, decimals};
}
Notation probability() {
  return {[](double value, int) { return p_value_text(value); }};
}
Notation in_percent(Notation notation, const std::string& suffix) {
  notation.scale = 100.0;
  notation.suffix = suffix;
  return notation;
}

std::string text_of(double value, const Notation& notation) {
  const double scaled = value * notation.scale;
  if (!std::isfinite(scaled)) return "n/a";
  return notation.write(scaled, notation.digits) + notation.suffix;
}

std::string NumberRange::text() const {
  return fmt::format("[{}, {}]", text_of(lower, notation), text_of(upper, notation));
}

Sentence Number::words() const {
  Sentence out;
  if (error > 0.0 && std::isfinite(value)) {
    Notation common = beside(value, error);
    const std::string exponent = std::exchange(common.suffix, "");
    out = say("{} {+/-} {}", text_of(value, common), text_of(error, common));
    if (!exponent.empty()) out = say("({}){}", out, exponent);
  } else {
    out = text_of(value, notation);
  }
  if (band) out += " " + NumberRange{band->first, band->second, notation}.text();
  return out + unit_after_number(unit);
}

std::optional<Number> number_if(const std::optional<double>& value, const Notation& notation) {
  if (!value || !std::isfinite(*value)) return std::nullopt;
  return Number{*value, notation};
}

}  // namespace recoil
