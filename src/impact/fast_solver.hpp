#pragma once

#include <span>

#include "impact/impact.hpp"

namespace recoil {

/// e^2 and its gradient, several impacts per SIMD register: the two phases as integral equations
/// (impact/phase_solver.hpp), or where these do not converge by a method of fixed order on the
/// regularised field (impact/step_solver.hpp). Hundreds to thousands of times faster than the
/// reference, and never a different answer. Certified against the reference over a wide box, see
/// tests/impact/fast_solver_test.cpp: e^2 to 1e-9, gradient to 1e-7.
///
/// Where neither can hold its accuracy (too many or too small steps) the reference answers
/// instead, and is counted. The same digits come out for an impact alone or among others, at any
/// register width. No memory is allocated.
/// `options.budget` is not supported here. @pre !options.budget, results.size() == groups.size()
/// @return how many impacts were handed over
long simulate_impacts_fast(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                           std::span<ImpactResult> results);

/// The same for one impact. Many at once cost a fraction of this each.
ImpactResult simulate_impact_fast(const ImpactGroups& groups, const ImpactOptions& options);

/// How many impacts of this process were handed over to the reference so far.
long reference_handovers();

}  // namespace recoil
