#include "plot/xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>

#include "core/error.hpp"

namespace recoil::plot {
namespace {

/// White space between elements with a line break or a tab: it only lays out the file.
bool is_layout(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos &&
         text.find_first_of("\t\r\n") != std::string_view::npos;
}

XmlNode node_of(const pugi::xml_node& from) {
  XmlNode node{from.name(), from.value(), {}, {}};
  for (const pugi::xml_attribute& attribute : from.attributes()) {
    node.attributes.emplace_back(attribute.name(), attribute.value());
  }
  for (const pugi::xml_node& child : from.children()) {
    const bool text = child.type() == pugi::node_pcdata;
    if (!text || !is_layout(child.value())) node.children.push_back(node_of(child));
  }
  return node;
}

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

XmlNode parse_xml(std::string_view document) {
  pugi::xml_document parsed;
  const pugi::xml_parse_result result = parsed.load_buffer(
      document.data(), document.size(), pugi::parse_minimal | pugi::parse_ws_pcdata);
  if (!result) {
    throw ComputationError(fmt::format("gnuplot's SVG is not well-formed at byte {} ({})",
                                       result.offset, result.description()));
  }
  return node_of(parsed.document_element());
}

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
