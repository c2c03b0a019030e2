#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace recoil {

/// What a piece of a sentence is; how it looks is the writers' business.
enum class RunKind {
  text,
  symbol,  ///< of the model: "C_H", "V*", "f0"
  unit,    ///< "um", "J/m2"
  plus_minus,
  exponent,   ///< of what stands before it: "0.83" of "d^0.83"
  qualifier,  ///< what a symbol belongs to: the dataset of "C_A[mica]"
  strong,
  code,
  link
};

struct Run {
  RunKind kind = RunKind::text;
  std::string text;
  std::string address = {};  ///< of a link

  bool operator==(const Run&) const = default;
};

/// Words with the symbols, units and links that stand among them. Plain text becomes a sentence by
/// itself, and nothing is ever looked for in it; what is to be set as a symbol is said so where the
/// sentence is made, see `say`.
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

/// As characters of plain ASCII where the words are: "C_H = 3 +/- 1 um". For JSON and the terminal.
std::string plain_text(const Sentence& sentence);
std::vector<std::string> plain_texts(const std::vector<Sentence>& sentences);

/// The symbol of a parameter's label: "C_A[mica]" is C_A of mica.
Sentence symbol(std::string_view label);
Sentence unit(std::string_view name);
Sentence exponent(std::string number);
Sentence strong(std::string text);
Sentence code(std::string text);
Sentence link(std::string text, std::string address);

/// " m/s"; nothing for a pure number, whose unit is empty or "1".
Sentence unit_after_number(std::string_view name);

/// What may be filled into a sentence.
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

/// A sentence by its pattern, in which {} or {:.3g} takes the next filling, as in fmt::format, and
/// a name in braces is set as what it is: {C_H} a symbol, {um} a unit, {+/-} the sign. A brace
/// itself is written twice.
///
///   say("{} points give {C_H} = {:.3g} s/m at {} {um}", count, value, diameter)
template <class... Fillings>
Sentence say(std::string_view pattern, const Fillings&... fillings) {
  return compose(pattern, {Filling(fillings)...});
}

/// `words` with a capital at the start, unless it is a symbol, and a full stop at the end; empty
/// stays empty.
Sentence as_sentence(Sentence words);

Sentence join(const std::vector<Sentence>& parts, const Sentence& between);

/// What `words` says of every item, with `between` between them: a string where it gives text.
template <class Items, class Words>
auto joined(const Items& items, std::string_view between, const Words& words) {
  using Said = std::decay_t<decltype(words(*std::begin(items)))>;
  std::conditional_t<std::is_same_v<Said, Sentence>, Sentence, std::string> text;
  for (auto item = std::begin(items); item != std::end(items); ++item) {
    if (item != std::begin(items)) text += between;
    text += words(*item);
  }
  return text;
}

/// An identifier such as "jkr_loss" in words: "JKR loss".
std::string words_of(std::string identifier);

}  // namespace recoil
