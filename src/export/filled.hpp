#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace recoil {

/// `text` with every @NAME@ replaced by its value. Every name has to have a value, and every value
/// a place: a writer that breaks this is mistaken.
std::string filled(std::string_view text,
                   std::initializer_list<std::pair<std::string_view, std::string>> values);

/// Each line behind `mark` ("# "), with a line end.
std::string commented(const std::vector<std::string>& lines, std::string_view mark);

}  // namespace recoil
