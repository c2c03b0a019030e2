#pragma once

#include <string>

#include "core/json.hpp"

namespace recoil {

/// The JSON of a fit.json that was written before, `format_version` looked at first.
/// @param file names it in messages
/// @param reader what reads it, for messages: "recoil compare"
/// @throws InputError when it is not JSON, no result of a fit, or has another format_version than
///   this program writes
Json read_fit_json(const std::string& file, const std::string& text, const std::string& reader);

}  // namespace recoil
