#include "page_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <vector>

namespace recoil {
namespace {

constexpr std::size_t megabyte = 1000000;

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++count;
  return count;
}

/// Values of the attribute, in single or double quotes.
std::vector<std::string> attribute(const std::string& html, const std::string& name) {
  std::vector<std::string> values;
  const std::regex pattern("[\\s]" + name + "\\s*=\\s*(?:\"([^\"]*)\"|'([^']*)')");
  for (std::sregex_iterator it(html.begin(), html.end(), pattern), end; it != end; ++it) {
    values.push_back((*it)[1].matched ? (*it)[1].str() : (*it)[2].str());
  }
  return values;
}

}  // namespace

void expect_self_contained(const std::string& html) {
  using testing::HasSubstr;
  using testing::Not;
  EXPECT_LT(html.size(), megabyte);
  std::set<std::string> ids;
  for (const std::string& id : attribute(html, "id")) {
    EXPECT_TRUE(ids.insert(id).second) << "id " << id << " twice";
  }
  EXPECT_TRUE(attribute(html, "src").empty());
  for (const char* name : {"href", "xlink:href"}) {
    for (const std::string& target : attribute(html, name)) {
      EXPECT_THAT(target, testing::AnyOf(testing::StartsWith("#"), testing::StartsWith("data:"),
                                         testing::MatchesRegex("[a-z0-9-]+(/[a-z0-9-]+)?\\.html")));
      const bool anchor = target.starts_with("#");
      EXPECT_TRUE(!anchor || ids.contains(target.substr(1))) << target;
    }
  }
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  for (std::size_t at = 0; (at = html.find("url(", at)) != std::string::npos; ++at) {
    const std::string target = html.substr(at + 4, html.find(')', at) - at - 4);
    EXPECT_TRUE(target.starts_with("#") && ids.contains(target.substr(1))) << target;
  }
  // The page has one embedded program and JSON without markup. No script is loaded, and no text of
  // a dataset starts one.
  const std::size_t programs = occurrences(html, "<script type=\"text/javascript\">");
  const std::size_t data = occurrences(html, "<script type=\"application/json\" class=\"");
  EXPECT_LE(programs, 1U);
  EXPECT_EQ(occurrences(html, "<script"), programs + data);
  EXPECT_EQ(occurrences(html, "</script"), programs + data);
  for (const char* network : {"fetch(", "XMLHttpRequest", "import(", "WebSocket", "sendBeacon"}) {
    EXPECT_THAT(html, Not(HasSubstr(network)));
  }
  EXPECT_EQ(occurrences(html, "<div"), occurrences(html, "</div>"));
  EXPECT_EQ(occurrences(html, "<figure "), occurrences(html, "</figure>"));
  EXPECT_THAT(html, HasSubstr("name=\"viewport\""));
  EXPECT_THAT(html, HasSubstr("@media print"));
}

}  // namespace recoil
