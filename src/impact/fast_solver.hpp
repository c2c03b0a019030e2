#pragma once

#include "impact/impact.hpp"

namespace recoil {

/// e^2 and its gradient by a method of fixed order on the regularised field, much faster than the
/// reference: DOP853 steps on dual numbers, with the turning point and the release landed exactly
/// by taking u, then q, as the independent variable of the last steps (Henon 1982, Physica D 5,
/// 412-414). Accuracy against the reference: see tests/impact/fast_solver_test.cpp.
///
/// Where it cannot hold its accuracy (too many or too small steps) it returns
/// `integration_failure` or `step_limit`, and `simulate_impact_fast` hands over to the reference.
/// `options.budget` is not supported here. @pre !options.budget
ImpactResult simulate_impact_fast(const ImpactGroups& groups, const ImpactOptions& options);

/// How many impacts of this process were handed over to the reference so far.
long reference_handovers();

}  // namespace recoil
