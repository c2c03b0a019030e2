#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

#include "report/format.hpp"

namespace recoil {

/// A text report as it grows, in blocks with a name; every line is kept within `columns`.
class Blocks {
 public:
  static constexpr std::size_t columns = 100;
  static constexpr std::size_t margin = 4;

  void open(const std::string& name, const std::string& remark = "") {
    text_ += fmt::format("[[{}]]{}\n", name, remark);
  }

  /// A sentence, wrapped.
  void say(const std::string& sentence, std::size_t indent = margin) {
    text_ += std::string(indent, ' ') + wrap(sentence, columns, indent) + '\n';
  }

  /// One of a list.
  void entry(const std::string& words) {
    text_ += fmt::format("    - {}\n", wrap(words, columns, margin + 2));
  }

  /// A line whose blanks align it; only one that is too long is wrapped.
  void line(const std::string& content) {
    if (margin + content.size() <= columns) {
      text_ += std::string(margin, ' ') + content + '\n';
    } else {
      text_ += std::string(margin, ' ') + wrap(content, columns, 2 * margin) + '\n';
    }
  }

  void item(const std::string& name, const std::string& value) {
    text_ += fmt::format("    {:<19}= {}\n", name, wrap(value, columns, margin + 21));
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace recoil
