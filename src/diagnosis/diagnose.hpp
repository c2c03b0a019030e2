#pragma once

#include <vector>

#include "diagnosis/diagnosis_result.hpp"

namespace recoil {

/// What the fitted model of `spec` gets wrong, and why.
///
/// 1. The residuals are tested for structure (`StructureStatistics`); the p-value comes from data
///    sets simulated by the fitted model and refitted.
/// 2. Unless the model is adequate, every mechanism of the catalogue is added and the whole model
///    refitted, with the weights of the base fit. The p-value of a candidate is the part of data
///    sets simulated by the base model in which the best of all candidates gains as much, to first
///    order.
/// 3. A candidate explains the data when that p-value is no more than `chance`, it leaves no
///    structure (or none to speak of beside what it took), its parameters are possible, and it
///    predicts blocks that were held out better than the base does. A description never explains.
/// 4. What is possible and fits no worse than the best explanation, but for `margin`, is its rival,
///    also where its parameters lie somewhat beyond the range of what is plausible, as such limits
///    are not sharp. One explanation alone is named; several are not
///    separable; none sends the search to pairs, unless even the best single one gains no more than
///    chance gives, as chance gives more to the best of so many pairs; if they fail too the
///    structure is unexplained. One diameter names nothing: the size dependence, which tells one
///    cause from another, was not seen.
/// 5. Where errors that were not stated (`unstated_errors`) leave nothing and fit better than the
///    best single explanation by more than `margin`, or about as well as the best of the pairs, no
///    cause is told; where they would do as well, they are `rival_errors`.
/// Where the fit holds uncertain constants of the materials (Materials::propagated), the base model
/// is fitted again with constants that the points move.
/// @param base the fit of `spec` to `datasets`. @pre base.usable
/// @param base_intervals its intervals [slots], where they are known already; else they are found
/// @throws ComputationError when the fit cannot be repeated from its own answer.
Diagnosis diagnose(const FitSpec& spec, const std::vector<Dataset>& datasets, const FitResult& base,
                   const DiagnosisOptions& options,
                   const std::vector<IntervalSet>& base_intervals = {});

/// The same with the fit made first.
/// @throws ComputationError when the base model has no usable fit, too.
Diagnosis diagnose(const FitSpec& spec, const std::vector<Dataset>& datasets,
                   const DiagnosisOptions& options);

}  // namespace recoil
