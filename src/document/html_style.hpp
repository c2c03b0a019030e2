#pragma once

#include <string_view>

namespace recoil {

/// The style sheet of every page: light and dark, screen, phone and paper.
std::string_view style_sheet();

}  // namespace recoil
