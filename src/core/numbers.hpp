#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace recoil {

/// What counts as a blank within a line. The last three are no-break spaces, which spreadsheets and
/// web pages put around numbers.
inline constexpr std::array<std::string_view, 6> blanks = {" ",      "\t",     "\r",
                                                           "\u00A0", "\u202F", "\u2007"};

/// `text` without the blanks, no-break spaces, tabs and carriage returns around it.
std::string_view trimmed(std::string_view text);

/// Parses a finite decimal number with blanks around it; nullopt for any other text (nan, inf,
/// overflow, trailing characters, a decimal comma).
std::optional<double> parse_number(std::string_view text);

/// Parses a whole number in decimal digits, "010" is ten; nullopt for any other text and for a
/// number that 64 bits do not hold.
std::optional<std::int64_t> parse_whole_number(std::string_view text);

/// Parses hours:minutes:seconds, "01:30:00"; nullopt for any other text.
/// @return the time [s]
std::optional<std::int64_t> parse_clock_time(std::string_view text);

}  // namespace recoil
