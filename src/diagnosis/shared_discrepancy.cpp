#include "diagnosis/shared_discrepancy.hpp"

#include "diagnosis/discrepancy.hpp"

namespace recoil {

std::shared_ptr<const Discrepancy> nothing_shared() {
  static const auto nothing = std::make_shared<const Discrepancy>();
  return nothing;
}

}  // namespace recoil
