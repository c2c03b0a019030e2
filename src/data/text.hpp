#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/numbers.hpp"
#include "core/quoting.hpp"

namespace recoil {

/// The place of byte `offset` of `text`. Lines end with LF, CR or CR LF. Columns count UTF-8 code
/// points, as editors do. An offset beyond the end is taken as the end.
Location locate(std::string_view text, std::size_t offset, const std::string& file);

/// Checks that `text` is UTF-8, because JSON and HTML results repeat names and titles.
/// @throws InputError at the first byte that is NUL or not valid UTF-8 (RFC 3629)
void require_text(std::string_view text, const std::string& file);

/// `text` with a blank instead of each no-break space, tab and carriage return.
std::string with_plain_blanks(std::string text);

/// The first `longest` characters of `text`, followed by dots if there are more.
std::string shortened(std::string_view text, std::size_t longest);

/// `word` between single quotes, cut to 40 characters: for messages.
std::string quote(std::string_view word);

/// "did you mean 'x'?" if a known word is near, otherwise "known: a, b, c".
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

/// The unit after a number in a message: " m/s"; empty for a pure number ("1" or "").
std::string unit_suffix(std::string_view unit);

/// "a, b, c and 7 more": a list of words for a message, each printable and cut to 40 characters, at
/// most about 400 characters in all.
std::string listed(const std::vector<std::string>& words);

/// "1 point", "7 points". @param many if it is not `one` and an s
std::string counted(long long count, std::string_view one, std::string_view many = "");
template <std::integral Count>
std::string counted(Count count, std::string_view one, std::string_view many = "") {
  return counted(static_cast<long long>(count), one, many);
}

/// "a, b, c".
std::string join(const std::vector<std::string>& words);

}  // namespace recoil
