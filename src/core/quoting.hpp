#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace recoil {

// Functions that escape text from users (file names, titles) for another syntax. For HTML and XML
// see plot::escape_xml, for JSON json_text.

/// Replaces every `old`, which is not empty, in `text`.
void replace_all(std::string& text, std::string_view old, std::string_view by);

/// Length of the UTF-8 sequence that starts at byte `i` of `text`; 0 when it is not valid (RFC
/// 3629).
std::size_t utf8_length(std::string_view text, std::size_t i);

/// Text for a terminal: control characters (C0, DEL and C1) become spaces, bytes that are not UTF-8
/// become question marks. @param lines keeps line feeds and tabs
std::string printable(std::string_view text, bool lines = false);

/// `word` as one word of a POSIX shell, quoted if necessary.
std::string shell_word(std::string_view word);

/// `path` as a relative URL: all bytes except letters, digits and "-._~/" become %XX (RFC 3986).
std::string url_path(std::string_view path);

/// `line` as a comment in Python, LAMMPS, LIGGGHTS, C, C++ and OpenFOAM: nothing in it ends the
/// comment, joins it to the next line or states an encoding.
std::string comment_text(std::string_view line);

/// Writes `text` as `printable` with its lines. A failure stays in the state of `stream`.
void show(std::FILE* stream, std::string_view text);

/// Formats text and writes it with `show`.
template <class... Args>
void print_text(std::FILE* stream, fmt::format_string<Args...> format, Args&&... args) {
  show(stream, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void print_text(fmt::format_string<Args...> format, Args&&... args) {
  show(stdout, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace recoil
