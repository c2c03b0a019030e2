#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace recoil {

/// Text of users (names of files, titles) on its way into another language: one function for each.
/// HTML and XML: plot::escape_xml; JSON: json_text.

/// Length of the UTF-8 sequence that starts at byte `i` of `text`; 0 when it is not valid (RFC
/// 3629).
std::size_t utf8_length(std::string_view text, std::size_t i);

/// For a terminal: control characters (C0, DEL and C1) become spaces, bytes that are not UTF-8
/// become question marks. @param lines line feeds and tabs stay
std::string printable(std::string_view text, bool lines = false);

/// One word of a POSIX shell.
std::string shell_word(std::string_view word);

/// A relative address of a page: every byte but letters, digits and "-._~/" as %XX (RFC 3986).
std::string url_path(std::string_view path);

/// A line of a comment in Python, LAMMPS, LIGGGHTS, C, C++ and OpenFOAM: nothing in it ends the
/// comment, joins it to the next line or states an encoding.
std::string comment_text(std::string_view line);

/// Writes `text` as a terminal may show it. A failure stays in the state of `stream`.
void show(std::FILE* stream, std::string_view text);

/// Formats and shows.
template <class... Args>
void print_text(std::FILE* stream, fmt::format_string<Args...> format, Args&&... args) {
  show(stream, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void print_text(fmt::format_string<Args...> format, Args&&... args) {
  show(stdout, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace recoil
