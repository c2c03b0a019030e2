#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace recoil::plot {

/// An element of an XML document, or a piece of text (then without a name). Text and values stand
/// as in the file, entities included.
struct XmlNode {
  std::string name;
  std::string text;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlNode> children;

  bool is_text() const { return name.empty(); }
  /// Null where there is none.
  const std::string* attribute(std::string_view key) const;
  std::string* attribute(std::string_view key);
  void erase_attribute(std::string_view key);
};

/// The root element of a well-formed document. Prolog, comments and white space between elements
/// (blanks with a line break or a tab) are left out.
/// @throws ComputationError where it is not well-formed.
XmlNode parse_xml(std::string_view document);

/// `text` as the content of an element or of an attribute, in XML as in HTML; control characters,
/// which have no place there, become blanks.
std::string escape_xml(std::string_view text);

std::string write_xml(const XmlNode& node);

}  // namespace recoil::plot
