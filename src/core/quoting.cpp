#include "core/quoting.hpp"

#include <algorithm>
#include <array>

namespace recoil {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// True for an ASCII letter or digit in any locale, and for one of `others`.
bool is_plain(char c, std::string_view others) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         others.find(c) != std::string_view::npos;
}

/// True for a character that changes the order or the place of the letters around it: marks,
/// embeddings and isolates of direction (UAX #9), and separators of lines.
bool redirects(std::string_view character) {
  if (character == "\xD8\x9C") return true;                           // U+061C
  if (character.size() != 3 || character[0] != '\xE2') return false;  // U+2000 to U+2FFF
  const unsigned last = byte_at(character, 2);
  if (character[1] == '\x80') return last == 0x8E || last == 0x8F || (last >= 0xA8 && last <= 0xAE);
  return character[1] == '\x81' && last >= 0xA6 && last <= 0xA9;  // U+2066 to U+2069
}

}  // namespace

void replace_all(std::string& text, std::string_view old, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(old, at)) != std::string::npos; at += by.size()) {
    text.replace(at, old.size(), by);
  }
}

std::size_t utf8_length(std::string_view text, std::size_t i) {
  const unsigned first = byte_at(text, i);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  const std::size_t length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (i + length > text.size()) return 0;
  // The narrower limits of the second byte exclude overlong forms, surrogates and > U+10FFFF.
  const unsigned lowest = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned highest = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  const unsigned second = byte_at(text, i + 1);
  if (second < lowest || second > highest) return 0;
  for (std::size_t k = 2; k < length; ++k) {
    if ((byte_at(text, i + k) & 0xC0U) != 0x80U) return 0;
  }
  return length;
}

std::string printable(std::string_view text, bool lines) {
  const auto plain = [](char c) { return c >= ' ' && c < '\x7f'; };
  if (std::all_of(text.begin(), text.end(), plain)) return std::string(text);
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const unsigned byte = byte_at(text, i);
    const bool c1 = length == 2 && byte == 0xC2 && byte_at(text, i + 1) < 0xA0;
    const bool stays = lines && (text[i] == '\n' || text[i] == '\t');
    if (length == 0) {
      out += '?';
    } else if ((!stays && (byte < 0x20 || byte == 0x7f || c1)) ||
               redirects(text.substr(i, length))) {
      out += ' ';
    } else {
      out += text.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return out;
}

std::string shell_word(std::string_view word) {
  bool safe = !word.empty();
  std::string quoted = "'";
  for (const char c : word) {
    safe = safe && is_plain(c, "_-./=,:+%@");
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return safe ? std::string(word) : quoted + "'";
}

std::string url_path(std::string_view path) {
  std::string out;
  for (const char c : path) {
    out += is_plain(c, "-._~/") ? std::string(1, c)
                                : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

std::string comment_text(std::string_view line) {
  std::string out = printable(line);
  // C: */ ends and /* nests, \ and its trigraph join lines. LAMMPS: & joins lines, quotes span
  // them. Python reads an encoding from "coding=" and "coding:" in its first lines (PEP 263).
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> unsafe = {
      {{"\\", "/"},
       {"\"", "'"},
       {"&", "+"},
       {"*/", "* /"},
       {"/*", "/ *"},
       {"??", "? ?"},
       {"coding=", "coding ="},
       {"coding:", "coding :"}}};
  for (const auto& [old, by] : unsafe) replace_all(out, old, by);
  return out;
}

void show(std::FILE* stream, std::string_view text) {
  const std::string shown = printable(text, true);
  std::fwrite(shown.data(), 1, shown.size(), stream);
}

}  // namespace recoil
