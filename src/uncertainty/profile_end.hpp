#pragma once

#include <functional>
#include <optional>

namespace recoil {

/// The profile of an objective along one parameter. Its evaluations are minimisations over the
/// other parameters.
struct ProfileWalk {
  /// The rise of the objective over its minimum with the parameter at `value`, minimised from the
  /// last kept place. It is not below the true rise, but above it if the minimisation ends in a
  /// worse minimum. Nullopt if it fails.
  std::function<std::optional<double>(double value)> rise;
  /// Keeps the place where the last minimisation ended.
  std::function<void()> keep;
};

struct ProfileEnd {
  double value;
  bool at_bound;
};

/// The end of a profile interval on the side of `bound`: the value at which the rise is the allowed
/// one, or the bound.
///
/// Only values with a smaller rise are kept, so that a worse minimum beyond the end does not lead
/// to the next values. Where a minimisation fails, the walk goes on with half of the step. A value
/// counts as excluded if the rise exceeds the allowed one even when minimised from a value that is
/// not excluded and close to it.
///
/// Nullopt if the end does not lie between a value with a smaller and one with a larger rise, or if
/// there is no value with a smaller rise between it and the estimate.
/// @param stride first step > 0
/// @param allowed the allowed rise at a value of the parameter
std::optional<ProfileEnd> find_profile_end(const ProfileWalk& walk, double estimate, double bound,
                                           double stride,
                                           const std::function<double(double)>& allowed);

}  // namespace recoil
