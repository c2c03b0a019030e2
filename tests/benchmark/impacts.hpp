#pragma once

#include <filesystem>
#include <vector>

#include "impact/impact.hpp"
#include "measure.hpp"

namespace recoil::bench {

/// A fixed random set of impacts as the shipped fits meet them. Each takes a shipped dataset and
/// one of its diameters, a velocity drawn evenly in its logarithm from 0.6 of the smallest to the
/// largest of the dataset (so that some spheres are captured), the f0 of the materials, and C_H and
/// C_A within a factor of two about the estimates of the dataset's own fit.
///
/// @param root the project's folder, with `fits/` and `datasets/`
std::vector<ImpactGroups> representative_impacts(const std::filesystem::path& root,
                                                 std::size_t count);

/// All impacts by the fast path, as a fit asks for them.
void run_fast(const std::vector<ImpactGroups>& impacts, AdhesionLaw law, bool gradient,
              std::vector<ImpactResult>& results);

/// All impacts by CVODES at its default tolerance, with forward sensitivities for the gradient.
void run_reference(const std::vector<ImpactGroups>& impacts, AdhesionLaw law, bool gradient,
                   std::vector<ImpactResult>& results);

/// What the set is made of, and the largest differences between the two paths on it, relative to
/// max(1, |value|).
Json describe_impacts(const std::vector<ImpactGroups>& impacts);

}  // namespace recoil::bench
