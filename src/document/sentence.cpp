#include "document/sentence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>
#include <utility>

namespace recoil {
namespace {

constexpr std::array<std::string_view, 7> unit_names = {"um",    "uN",    "us",  "J/m2",
                                                        "kg/m3", "m/s^2", "N/m2"};

bool is_symbol_name(std::string_view name) {
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
         std::ranges::all_of(name, [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '*';
         });
}

/// The run for a name in braces: a unit, a symbol or the sign +/-.
Run named_run(std::string_view name) {
  if (name == "+/-") return {RunKind::plus_minus, "+/-"};
  if (std::ranges::find(unit_names, name) != unit_names.end()) {
    return {RunKind::unit, std::string(name)};
  }
  if (!is_symbol_name(name)) {
    throw std::logic_error(fmt::format("{{{}}} in a sentence is neither symbol nor unit", name));
  }
  return {RunKind::symbol, std::string(name)};
}

}  // namespace

Sentence::Sentence(std::string text) {
  if (!text.empty()) runs_.push_back({RunKind::text, std::move(text)});
}

Sentence::Sentence(Run run) { runs_.push_back(std::move(run)); }

Sentence& Sentence::operator+=(const Sentence& more) {
  const std::vector<Run> added = more.runs_;  // `more` may be this sentence itself
  for (const Run& run : added) {
    const bool both_text =
        run.kind == RunKind::text && !runs_.empty() && runs_.back().kind == RunKind::text;
    if (both_text) {
      runs_.back().text += run.text;
    } else {
      runs_.push_back(run);
    }
  }
  return *this;
}

std::string plain_text(const Sentence& sentence) {
  std::string text;
  for (const Run& run : sentence.runs()) {
    if (run.kind == RunKind::exponent) text += '^';
    text += run.kind == RunKind::qualifier ? fmt::format("[{}]", run.text) : run.text;
  }
  return text;
}

std::vector<std::string> plain_texts(const std::vector<Sentence>& sentences) {
  std::vector<std::string> texts;
  for (const Sentence& sentence : sentences) texts.push_back(plain_text(sentence));
  return texts;
}

Sentence symbol(std::string_view label) {
  const auto bracket = label.find('[');
  Sentence words(Run{RunKind::symbol, std::string(label.substr(0, bracket))});
  if (bracket != std::string_view::npos) {
    std::string_view owner = label.substr(bracket + 1);
    if (owner.ends_with(']')) owner.remove_suffix(1);
    words += Sentence(Run{RunKind::qualifier, std::string(owner)});
  }
  return words;
}

Sentence unit(std::string_view name) { return Sentence(Run{RunKind::unit, std::string(name)}); }
Sentence exponent(std::string number) {
  return Sentence(Run{RunKind::exponent, std::move(number)});
}

Sentence strong(std::string text) { return Sentence(Run{RunKind::strong, std::move(text)}); }
Sentence code(std::string text) { return Sentence(Run{RunKind::code, std::move(text)}); }
Sentence link(std::string text, std::string address) {
  return Sentence(Run{RunKind::link, std::move(text), std::move(address)});
}

Sentence unit_after_number(std::string_view name) {
  return name.empty() || name == "1" ? Sentence() : Sentence(" ") + unit(name);
}

Sentence Filling::rendered(std::string_view format) const {
  const auto formatted = [&](const auto& value) {
    return Sentence(fmt::format(fmt::runtime(fmt::format("{{{}}}", format)), value));
  };
  if (const auto* words = std::get_if<Sentence>(&value_)) return *words;
  if (const auto* real = std::get_if<double>(&value_)) return formatted(*real);
  return formatted(std::get<long long>(value_));
}

Sentence compose(std::string_view pattern, const std::vector<Filling>& fillings) {
  Sentence sentence;
  std::size_t next = 0;
  for (std::size_t at = 0; at < pattern.size();) {
    const char c = pattern[at];
    if (c != '{' && c != '}') {
      const std::size_t end = std::min(pattern.find_first_of("{}", at), pattern.size());
      sentence += pattern.substr(at, end - at);
      at = end;
      continue;
    }
    if (at + 1 < pattern.size() && pattern[at + 1] == c) {
      sentence += std::string(1, c);
      at += 2;
      continue;
    }
    const std::size_t close = pattern.find('}', at);
    if (c == '}' || close == std::string_view::npos) {
      throw std::logic_error(fmt::format("a single brace in the sentence '{}'", pattern));
    }
    const std::string_view inside = pattern.substr(at + 1, close - at - 1);
    if (inside.empty() || inside.front() == ':') {
      if (next == fillings.size()) {
        throw std::logic_error(fmt::format("too few arguments for the sentence '{}'", pattern));
      }
      sentence += fillings[next++].rendered(inside);
    } else {
      sentence += Sentence(named_run(inside));
    }
    at = close + 1;
  }
  if (next != fillings.size()) {
    throw std::logic_error(fmt::format("too many arguments for the sentence '{}'", pattern));
  }
  return sentence;
}

Sentence as_sentence(Sentence words) {
  if (words.empty()) return words;
  Run& first = words.runs_.front();
  if (first.kind == RunKind::text && first.text[0] >= 'a' && first.text[0] <= 'z') {
    first.text[0] = static_cast<char>(first.text[0] - 'a' + 'A');
  }
  const std::string& end = words.runs_.back().text;
  if (end.empty() || std::string_view(".!?").find(end.back()) == std::string_view::npos) {
    words += ".";
  }
  return words;
}

Sentence join(const std::vector<Sentence>& parts, const Sentence& between) {
  Sentence sentence;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) sentence += between;
    sentence += parts[i];
  }
  return sentence;
}

std::string words_of(std::string identifier) {
  std::replace(identifier.begin(), identifier.end(), '_', ' ');
  for (const std::string_view name : {"JKR", "DMT", "van der Waals", "Maugis"}) {
    const auto same = [](unsigned char a, unsigned char b) {
      return std::tolower(a) == std::tolower(b);
    };
    const auto at =
        std::search(identifier.begin(), identifier.end(), name.begin(), name.end(), same);
    if (at != identifier.end()) std::copy(name.begin(), name.end(), at);
  }
  return identifier;
}

}  // namespace recoil
