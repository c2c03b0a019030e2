#include "core/program.hpp"

#include "core/files.hpp"

namespace recoil {

std::string version() { return RECOIL_VERSION; }

std::string program_stamp() {
  static const std::string stamp = sha256_of_file("/proc/self/exe");
  return stamp;
}

}  // namespace recoil
