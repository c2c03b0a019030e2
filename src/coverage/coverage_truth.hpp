#pragma once

#include <functional>
#include <span>

#include "coverage/coverage.hpp"
#include "estimate/observation.hpp"

namespace recoil {

/// The spheres of a coverage study: what they do under parameters theta [slots].
struct TrueImpacts {
  using Theta = std::span<const double>;
  /// Noiseless e [1] of one sphere; 0 when captured.
  std::function<double(Theta theta, const PointConditions& sphere)> restitution;
  /// V* [m/s] of spheres of `diameter` [m].
  std::function<double(Theta theta, std::size_t dataset, double diameter)> capture_velocity;
};

/// A sphere that `model` simulates itself: the study then asks whether intervals hold where the
/// model is right. @throws ComputationError where the model has no answer
TrueImpacts impacts_of(const ImpactModel& model);

using MakeImpacts = std::function<TrueImpacts(const ImpactModel& model)>;

/// The truth of a coverage study of `spec`: the fit's own estimate. The points are simulated there
/// with the noise that the points state and an error for every setting, where settings share one.
/// Where captures were counted, every impact is simulated, at a velocity that differs from the
/// stated one as much as the estimated spread says (log-normal), and counted again. Where points
/// average over sizes, every impact is that of a sphere of its own size. Where constants of the
/// materials are uncertain, every simulation draws its own.
/// @throws ComputationError when that fit has no usable answer.
CoverageTruth coverage_truth(const FitSpec& spec, const std::vector<Dataset>& datasets,
                             std::uint64_t seed, const MakeImpacts& make_impacts = impacts_of);

/// The same of a fit that is known.
CoverageTruth coverage_truth(const FitResult& fitted, const std::vector<Dataset>& datasets,
                             std::uint64_t seed, const MakeImpacts& make_impacts = impacts_of);

/// V* of every size of every dataset under theta, in the order of UncertaintyResult::capture.
std::vector<CoverageTruth::Capture> true_captures(const TrueImpacts& impacts,
                                                  std::span<const double> theta,
                                                  const std::vector<Dataset>& datasets);

/// theta with the constants of the materials drawn from their errors about what is stated: that of
/// simulation number `index`.
std::vector<double> with_drawn_constants(const ImpactModel& model, std::vector<double> theta,
                                         std::uint64_t seed, std::uint64_t index);

}  // namespace recoil
