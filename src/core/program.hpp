#pragma once

#include <string>

namespace recoil {

/// This program's version, "0.2.0".
std::string version();

/// SHA-256 of the file of the running program: another build may give other digits. Empty when it
/// cannot be read.
std::string program_stamp();

}  // namespace recoil
