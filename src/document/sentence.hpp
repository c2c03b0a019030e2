#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace recoil {

/// The kind of one piece of a sentence. Each output format sets it in its own way.
enum class RunKind {
  text,
  symbol,  ///< a symbol of the model: "C_H", "V*", "f0"
  unit,    ///< "um", "J/m2"
  plus_minus,
  exponent,   ///< exponent of the preceding run: "0.83" in "d^0.83"
  qualifier,  ///< owner of the preceding symbol: "mica" in "C_A[mica]"
  strong,
  code,
  link
};

struct Run {
  RunKind kind = RunKind::text;
  std::string text;
  std::string address = {};  ///< target of a link

  bool operator==(const Run&) const = default;
};

/// Text with symbols, units and links. Plain text converts to a sentence and is not searched for
/// symbols: `say` marks them.
class Sentence {
 public:
  Sentence() = default;
  Sentence(std::string text);
  Sentence(std::string_view text) : Sentence(std::string(text)) {}
  Sentence(const char* text) : Sentence(std::string(text)) {}
  explicit Sentence(Run run);

  const std::vector<Run>& runs() const { return runs_; }
  bool empty() const { return runs_.empty(); }

  Sentence& operator+=(const Sentence& more);
  friend Sentence operator+(Sentence a, const Sentence& b) { return a += b; }
  bool operator==(const Sentence&) const = default;

 private:
  friend Sentence as_sentence(Sentence words);
  std::vector<Run> runs_;
};

/// The sentence without markup, for JSON and the terminal: "C_H = 3 +/- 1 um".
std::string plain_text(const Sentence& sentence);
std::vector<std::string> plain_texts(const std::vector<Sentence>& sentences);

/// The symbol of a parameter's label: "C_A[mica]" becomes C_A with the qualifier mica.
Sentence symbol(std::string_view label);
Sentence unit(std::string_view name);
Sentence exponent(std::string number);
Sentence strong(std::string text);
Sentence code(std::string text);
Sentence link(std::string text, std::string address);

/// " m/s"; empty for a dimensionless quantity, whose unit is "" or "1".
Sentence unit_after_number(std::string_view name);

/// An argument of `say`: text or a number.
class Filling {
 public:
  template <class T>
  requires std::convertible_to<const T&, Sentence> Filling(const T& words)
      : value_(static_cast<Sentence>(words)) {}
  template <std::floating_point T>
  Filling(T value) : value_(static_cast<double>(value)) {}
  template <std::integral T>
  Filling(T value) : value_(static_cast<long long>(value)) {}

  Sentence rendered(std::string_view format) const;

 private:
  std::variant<Sentence, double, long long> value_;
};

Sentence compose(std::string_view pattern, const std::vector<Filling>& fillings);

/// Builds a sentence from a pattern. {} or {:.3g} takes the next argument, as in fmt::format. A
/// name in braces is a symbol {C_H}, a unit {um} or the sign {+/-}. {{ and }} are literal braces.
///
///   say("{} points give {C_H} = {:.3g} s/m at {} {um}", count, value, diameter)
template <class... Fillings>
Sentence say(std::string_view pattern, const Fillings&... fillings) {
  return compose(pattern, {Filling(fillings)...});
}

/// `words` with a capital letter at the start, unless it starts with a symbol, and a full stop at
/// the end. An empty sentence stays empty.
Sentence as_sentence(Sentence words);

/// `parts` separated by `between`.
Sentence join(const std::vector<Sentence>& parts, const Sentence& between);

/// `words(item)` for every item, separated by `between`: a Sentence if `words` returns one, else a
/// string.
template <class Items, class Words>
auto joined(const Items& items, std::string_view between, const Words& words) {
  using Result = std::decay_t<decltype(words(*std::begin(items)))>;
  std::conditional_t<std::is_same_v<Result, Sentence>, Sentence, std::string> text;
  for (auto item = std::begin(items); item != std::end(items); ++item) {
    if (item != std::begin(items)) text += between;
    text += words(*item);
  }
  return text;
}

/// An identifier in words: "JKR loss" for "jkr_loss".
std::string words_of(std::string identifier);

}  // namespace recoil
