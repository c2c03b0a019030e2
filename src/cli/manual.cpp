#include "cli/manual.hpp"

#include <algorithm>

namespace recoil {

std::string_view ManualPage::title() const {
  const std::string_view line = text.substr(0, text.find('\n'));
  return line.substr(std::min(line.find_first_not_of("# "), line.size()));
}

const ManualPage* find_manual_page(std::string_view topic) {
  for (const ManualPage& page : manual_pages()) {
    if (page.topic == topic) return &page;
  }
  return nullptr;
}

std::vector<std::string> manual_topics() {
  std::vector<std::string> topics;
  for (const ManualPage& page : manual_pages()) topics.emplace_back(page.topic);
  return topics;
}

}  // namespace recoil
