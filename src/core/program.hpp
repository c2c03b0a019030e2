#pragma once

#include <string>

namespace recoil {

/// This program's version, "0.2.0".
std::string version();

/// SHA-256 of the file of the running program: another build may give other digits. Empty when it
/// cannot be read.
std::string program_stamp();

/// Two processors with the same fingerprint give the same digits; 64 hexadecimal digits. Only the C
/// library's functions can differ: it has one version of exp, log, sin and so on for processors
/// with fused multiply-add and one for those without, and about one value in a thousand differs in
/// its last digit. The fingerprint is the SHA-256 of their values at some thousand arguments.
std::string arithmetic_fingerprint();

}  // namespace recoil
