#include "plot/xml.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace recoil::plot {
namespace {

constexpr std::string_view blanks = " \t\r\n";

class Reader {
 public:
  explicit Reader(std::string_view document) : document_(document) {}

  XmlNode root() {
    skip_prolog();
    XmlNode node = element();
    if (node.is_text()) fail();
    return node;
  }

 private:
  [[noreturn]] void fail() const {
    throw ComputationError(fmt::format("gnuplot's SVG is not well-formed at byte {}", at_));
  }

  bool starts(std::string_view words) const { return document_.substr(at_).starts_with(words); }

  void skip_blanks() { at_ = std::min(document_.find_first_not_of(blanks, at_), document_.size()); }

  void skip_past(std::string_view words) {
    const std::size_t end = document_.find(words, at_);
    if (end == std::string_view::npos) fail();
    at_ = end + words.size();
  }

  void skip_prolog() {
    for (skip_blanks(); starts("<?") || starts("<!"); skip_blanks()) {
      skip_past(starts("<?") ? "?>" : starts("<!--") ? "-->" : ">");
    }
  }

  std::string_view word() {
    const std::size_t end = document_.find_first_of(" \t\r\n=/><", at_);
    if (end == std::string_view::npos || end == at_) fail();
    const std::string_view found = document_.substr(at_, end - at_);
    at_ = end;
    return found;
  }

  std::pair<std::string, std::string> attribute() {
    std::pair<std::string, std::string> found;
    found.first = word();
    skip_blanks();
    if (!starts("=")) fail();
    ++at_;
    skip_blanks();
    if (!starts("'") && !starts("\"")) fail();
    const std::string_view quote = document_.substr(at_++, 1);
    const std::size_t begin = at_;
    skip_past(quote);
    found.second = document_.substr(begin, at_ - 1 - begin);
    return found;
  }

  XmlNode element() {
    if (!starts("<")) fail();
    ++at_;
    XmlNode node;
    node.name = word();
    for (skip_blanks(); !starts(">") && !starts("/>"); skip_blanks()) {
      node.attributes.push_back(attribute());
    }
    const bool closed = starts("/>");
    at_ += closed ? 2 : 1;
    if (!closed) read_children(node);
    return node;
  }

  void read_children(XmlNode& node) {
    while (!starts("</")) {
      if (starts("<!--")) {
        skip_past("-->");
      } else if (starts("<")) {
        node.children.push_back(element());
      } else {
        const std::size_t end = document_.find('<', at_);
        if (end == std::string_view::npos) fail();
        const std::string_view text = document_.substr(at_, end - at_);
        const bool layout = text.find_first_not_of(blanks) == std::string_view::npos &&
                            text.find_first_of("\t\r\n") != std::string_view::npos;
        if (!layout) node.children.push_back({"", std::string(text), {}, {}});
        at_ = end;
      }
    }
    at_ += 2;
    if (word() != node.name) fail();
    skip_blanks();
    if (!starts(">")) fail();
    ++at_;
  }

  std::string_view document_;
  std::size_t at_ = 0;
};

void write(const XmlNode& node, std::string& out) {
  if (node.is_text()) {
    out += node.text;
    return;
  }
  out += "<" + node.name;
  for (const auto& [key, value] : node.attributes) {
    const bool quoted = value.find('"') != std::string::npos;
    out += fmt::format(" {0}={2}{1}{2}", key, value, quoted ? '\'' : '"');
  }
  if (node.children.empty()) {
    out += "/>";
    return;
  }
  out += ">";
  const bool words = node.name == "text" || node.name == "tspan" ||
                     std::any_of(node.children.begin(), node.children.end(),
                                 [](const XmlNode& child) { return child.is_text(); });
  for (const XmlNode& child : node.children) {
    if (!words) out += '\n';
    write(child, out);
  }
  if (!words) out += '\n';
  out += "</" + node.name + ">";
}

}  // namespace

const std::string* XmlNode::attribute(std::string_view key) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const auto& pair) { return pair.first == key; });
  return found == attributes.end() ? nullptr : &found->second;
}

std::string* XmlNode::attribute(std::string_view key) {
  return const_cast<std::string*>(std::as_const(*this).attribute(key));
}

void XmlNode::erase_attribute(std::string_view key) {
  std::erase_if(attributes, [&](const auto& pair) { return pair.first == key; });
}

XmlNode parse_xml(std::string_view document) { return Reader(document).root(); }

std::string escape_xml(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
  }
  return out;
}

std::string write_xml(const XmlNode& node) {
  std::string out;
  write(node, out);
  return out;
}

}  // namespace recoil::plot
