#include "core/program.hpp"

#include <cmath>
#include <cstring>

#include "core/files.hpp"

namespace recoil {

std::string version() { return RECOIL_VERSION; }

std::string program_stamp() {
  static const std::string stamp = sha256_of_file("/proc/self/exe");
  return stamp;
}

std::string arithmetic_fingerprint() {
  std::string bytes;
  const auto add = [&bytes](double value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  constexpr int arguments = 4000;  // each function differs at some of them
  for (int i = 1; i <= arguments; ++i) {
    const double x = 1.37e-3 * i;
    for (const double value :
         {std::exp(x), std::log(x), std::pow(x, 0.37), std::sin(x), std::cos(x), std::tan(x),
          std::atan2(x, 1.7), std::log1p(x), std::expm1(x), std::log10(x), std::log2(x),
          std::cbrt(x), std::sinh(x), std::cosh(x), std::erfc(x), std::lgamma(x),
          std::hypot(x, 1.7)}) {
      add(value);
    }
  }
  return sha256_hex(bytes);
}

}  // namespace recoil
