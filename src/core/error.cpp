#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>
#include <utility>

#include "core/quoting.hpp"

namespace recoil {
namespace {

std::string compose(const Location& where, const std::string& problem, const std::string& why,
                    const std::string& suggestion) {
  std::string text;
  if (!where.file.empty()) {
    text += where.file;
    if (where.line > 0) text += fmt::format(":{}", where.line);
    if (where.line > 0 && where.column > 0) text += fmt::format(":{}", where.column);
    text += ": ";
  }
  text += problem;
  if (!why.empty()) text += fmt::format(" ({})", why);
  if (!suggestion.empty()) text += fmt::format("; {}", suggestion);
  return printable(text);
}

/// Levenshtein distance, with exchanges of neighbours (optimal string alignment) [number of edits].
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> above(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, above);
    std::swap(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, substituted});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

InputError::InputError(const Location& where, const std::string& problem, const std::string& why,
                       const std::string& suggestion)
    : std::runtime_error(compose(where, problem, why, suggestion)),
      where_(where),
      problem_(printable(problem)),
      why_(printable(why)),
      suggestion_(printable(suggestion)) {}

std::string plain_word(std::string_view word) {
  std::string plain;
  for (const char c : word) {
    if (c == ' ' || c == '-' || c == '_') continue;
    plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return plain;
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  const std::string plain = plain_word(word);
  std::string best;
  std::size_t best_distance =
      plain.size() <= 2 ? 1 : std::max<std::size_t>(1, (plain.size() + 1) / 4) + 1;
  for (const std::string& candidate : known) {
    const std::size_t distance = edit_distance(plain, plain_word(candidate));
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace recoil
