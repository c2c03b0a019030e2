#pragma once

#include <vector>

#include "diagnosis/candidate_result.hpp"

namespace recoil {

/// The parameters of the mechanisms that `candidate` adds, as `refit` has them, and whether they
/// are possible: within the plausible range of the catalogue, or no more than two standard errors
/// outside. Where the catalogue cannot know the material:
/// - a yield pressure above 0.3 E* is refused: no solid resists a shear of more than about a tenth
///   of its modulus (Frenkel 1926, Z. Phys. 37, 572-609), and a contact flows at 2.8 times the
///   yield stress (Tabor 1951, The Hardness of Metals).
/// @param noise_scale what the standard deviations of the sample are to be multiplied by
std::vector<FoundParameter> found_parameters(const Candidate& candidate, const Refit& refit,
                                             double noise_scale);

/// (J'J)^-1/2 of every moving slot; 0 elsewhere and where J'J is singular [slots].
std::vector<double> standard_errors(const Refit& refit, double noise_scale);

}  // namespace recoil
