#pragma once

#include <algorithm>

#include "document/document.hpp"

/// Looking through a document.
namespace support {

/// The section of that id; null where there is none.
inline const recoil::Section* section_of(const recoil::Document& document, std::string_view id) {
  const auto found = std::find_if(document.sections.begin(), document.sections.end(),
                                  [&](const recoil::Section& section) { return section.id == id; });
  return found == document.sections.end() ? nullptr : &*found;
}

/// The tables of a section.
inline std::vector<const recoil::Table*> tables_of(const recoil::Section& section) {
  std::vector<const recoil::Table*> tables;
  for (const recoil::Block& block : section.blocks) {
    if (const auto* table = std::get_if<recoil::Table>(&block.content())) tables.push_back(table);
  }
  return tables;
}

}  // namespace support
