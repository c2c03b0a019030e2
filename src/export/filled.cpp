#include "export/filled.hpp"

#include <cassert>

#include "core/quoting.hpp"

namespace recoil {

std::string filled(std::string_view text,
                   std::initializer_list<std::pair<std::string_view, std::string>> values) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('@', at);
    out += text.substr(at, open - at);
    if (open == std::string_view::npos) break;
    const std::size_t close = text.find('@', open + 1);
    const std::string_view name = text.substr(open + 1, close - open - 1);
    bool found = false;
    for (const auto& [known, value] : values) {
      if (known != name) continue;
      out += value;
      found = true;
    }
    assert(found && "a place without a value");
    static_cast<void>(found);
    at = close + 1;
  }
  return out;
}

std::string commented(const std::vector<std::string>& lines, std::string_view mark) {
  std::string out;
  for (const std::string& line : lines) {
    out += mark;
    out += comment_text(line);
    while (!out.empty() && out.back() == ' ') out.pop_back();
    out += '\n';
  }
  return out;
}

}  // namespace recoil
