#pragma once

#include <nlohmann/json.hpp>

namespace recoil {

/// Keys keep the order in which they are written, so that two files compare line by line.
using Json = nlohmann::ordered_json;

}  // namespace recoil
