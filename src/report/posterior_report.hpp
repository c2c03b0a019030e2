#pragma once

#include <string>

#include "analysis/analysis.hpp"

namespace recoil {

/// The joint draws of the posterior as CSV: one column for each slot that moves and each capture
/// velocity, SI units; before them the numbers of the chain and of the draw in it, after them the
/// scale of the noise where it is unknown, ln likelihood and ln prior. Empty without a posterior.
std::string posterior_csv(const Analysis& analysis);

}  // namespace recoil
