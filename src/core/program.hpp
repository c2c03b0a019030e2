#pragma once

#include <string>

namespace recoil {

/// This program's version, "0.2.0".
std::string version();

/// SHA-256 of the file of the running program, because another build may give other digits. Empty
/// if the file cannot be read.
std::string program_stamp();

/// Two processors with the same fingerprint (64 hexadecimal digits) give the same digits. Only the
/// functions of the C library can differ: it has one version of exp, log, sin and so on for
/// processors with fused multiply-add and one for those without, and about one value in a thousand
/// differs in its last digit. The fingerprint is the SHA-256 of their values at 4000 arguments.
std::string arithmetic_fingerprint();

}  // namespace recoil
