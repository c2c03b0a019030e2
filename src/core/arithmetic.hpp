#pragma once

#include <string>

namespace recoil {

/// Two processors with the same fingerprint give the same digits; 64 hexadecimal digits. Of this
/// program only the C library's functions can differ: it has one version of exp, log, sin and so on
/// for processors that multiply and add at once and one for those that do not, and about one value
/// in a thousand differs in its last digit. So the fingerprint is that of their values at some
/// thousand arguments.
std::string arithmetic_fingerprint();

}  // namespace recoil
