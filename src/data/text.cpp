#include "data/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace recoil {
namespace {

constexpr std::size_t longest_word = 40;  // in a message [characters]

unsigned byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

bool is_continuation(unsigned byte) { return (byte & 0xC0U) == 0x80U; }

}  // namespace

Location locate(std::string_view text, std::size_t offset, const std::string& file) {
  Location where{file, 1, 1};
  const std::size_t end = std::min(offset, text.size());
  for (std::size_t i = 0; i < end; ++i) {
    const bool carriage_return_alone =
        text[i] == '\r' && !(i + 1 < text.size() && text[i + 1] == '\n');
    if (text[i] == '\n' || carriage_return_alone) {
      ++where.line;
      where.column = 1;
    } else if (!is_continuation(byte_at(text, i))) {
      ++where.column;
    }
  }
  return where;
}

void require_text(std::string_view text, const std::string& file) {
  for (std::size_t i = 0; i < text.size();) {
    const unsigned byte = byte_at(text, i);
    if (byte == 0) {
      throw InputError(locate(text, i, file), "this is not a text file",
                       fmt::format("byte {} is NUL", i + 1), "save it as UTF-8 text");
    }
    const std::size_t length = byte < 0x80 ? 1 : utf8_length(text, i);
    if (length == 0) {
      throw InputError(locate(text, i, file), fmt::format("byte 0x{:02X} is not UTF-8", byte), "",
                       "save the file as UTF-8");
    }
    i += length;
  }
}

std::string with_plain_blanks(std::string text) {
  for (const std::string_view blank : blanks) replace_all(text, blank, " ");
  return text;
}

std::string shortened(std::string_view text, std::size_t longest) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_continuation(byte_at(text, i))) continue;
    if (++characters > longest) return fmt::format("{}...", text.substr(0, i));
  }
  return std::string(text);
}

std::string quote(std::string_view word) {
  return fmt::format("'{}'", printable(shortened(word, longest_word)));
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t longest = 64;  // the search takes time in proportion to the length
  const std::string nearest = word.size() > longest ? "" : nearest_word(word, known);
  return nearest.empty() ? fmt::format("known: {}", listed(known))
                         : fmt::format("did you mean '{}'?", nearest);
}

std::string unit_suffix(std::string_view unit) {
  return unit.empty() || unit == "1" ? "" : fmt::format(" {}", unit);
}

std::string listed(const std::vector<std::string>& words) {
  constexpr std::size_t longest = 400;
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (text.size() > longest) return fmt::format("{} and {} more", text, words.size() - i);
    if (i > 0) text += ", ";
    text += printable(shortened(words[i], longest_word));
  }
  return text;
}

std::string counted(long long count, std::string_view one, std::string_view many) {
  if (count == 1) return fmt::format("1 {}", one);
  return many.empty() ? fmt::format("{} {}s", count, one) : fmt::format("{} {}", count, many);
}

std::string join(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace recoil
