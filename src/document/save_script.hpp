#pragma once

#include <string_view>

namespace recoil {

/// The JavaScript of every page with pictures: beside each of them links that save it as SVG and
/// its data as CSV. save.js, embedded when the program is built.
std::string_view save_script();

}  // namespace recoil
