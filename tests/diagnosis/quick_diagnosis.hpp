#pragma once

#include "diagnosis/diagnose.hpp"

namespace recoil {

/// A diagnosis with half of the simulated data sets, for tests whose answers are clear.
inline DiagnosisOptions quick() {
  DiagnosisOptions options;
  options.simulated = 199;
  return options;
}

/// Four batches: what is read too much in each [1].
inline constexpr double batch_offset[] = {0.04, -0.05, 0.045, -0.03};

}  // namespace recoil
