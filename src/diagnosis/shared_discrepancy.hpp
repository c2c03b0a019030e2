#pragma once

#include <memory>

namespace recoil {

class Discrepancy;

/// What residuals share that have nothing but their own noise.
std::shared_ptr<const Discrepancy> nothing_shared();

}  // namespace recoil
