#include "estimate/noise_spec.hpp"

namespace recoil {

std::string to_string(VarianceFunction function) {
  switch (function) {
    case VarianceFunction::stated:
      return "stated";
    case VarianceFunction::constant:
      return "constant";
    case VarianceFunction::proportional:
      return "proportional";
    case VarianceFunction::capture:
      return "capture";
    case VarianceFunction::steep:
      return "steep";
  }
  return "";
}

}  // namespace recoil
