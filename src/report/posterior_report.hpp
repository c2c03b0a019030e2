#pragma once

#include <string>

#include "analysis/analysis.hpp"

namespace recoil {

/// The joint draws of the posterior as CSV: one column for each slot that moves and each capture
/// velocity, SI units. Empty without a posterior.
std::string posterior_csv(const Analysis& analysis);

}  // namespace recoil
