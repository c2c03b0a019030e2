#pragma once

#include <functional>
#include <span>

#include "coverage/coverage.hpp"
#include "estimate/observation.hpp"

namespace recoil {

/// The true impacts of a coverage study, as functions of the parameters theta [slots].
struct TrueImpacts {
  using Theta = std::span<const double>;
  /// Noiseless e [1] of one sphere; 0 if captured.
  std::function<double(Theta theta, const PointConditions& sphere)> restitution;
  /// V* [m/s] of spheres of `diameter` [m].
  std::function<double(Theta theta, std::size_t dataset, double diameter)> capture_velocity;
};

/// Impacts simulated by `model` itself: the study then tests the intervals for a correct model.
/// @throws ComputationError if an impact cannot be solved
TrueImpacts impacts_of(const ImpactModel& model);

using MakeImpacts = std::function<TrueImpacts(const ImpactModel& model)>;

/// The truth of a coverage study of `spec`: the fit's own estimate. The points are simulated with
/// the stated or estimated noise, and with an error of every setting if settings share one. If
/// captures were counted, every impact is simulated, at a velocity that differs from the stated one
/// by the estimated spread (log-normal), and counted. If points average over sizes, every impact
/// has a sphere of its own size. If material constants are uncertain, every simulation draws its
/// own.
/// @throws ComputationError if that fit is not usable
CoverageTruth coverage_truth(const FitSpec& spec, const std::vector<Dataset>& datasets,
                             std::uint64_t seed, const MakeImpacts& make_impacts = impacts_of);

/// The same for an existing fit.
CoverageTruth coverage_truth(const FitResult& fitted, const std::vector<Dataset>& datasets,
                             std::uint64_t seed, const MakeImpacts& make_impacts = impacts_of);

/// The datasets of simulation number `index` at theta [slots], with the points of `fitted`, its
/// noise
/// (`weights`), and a draw of every source of error.
/// @throws ComputationError if an impact cannot be solved
std::vector<Dataset> simulate_at(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                 const TrueImpacts& impacts, std::span<const double> theta,
                                 std::uint64_t seed, std::uint64_t index);

/// V* [m/s] of every size of every dataset at theta, in the order of UncertaintyResult::capture.
std::vector<CoverageTruth::Capture> true_captures(const TrueImpacts& impacts,
                                                  std::span<const double> theta,
                                                  const std::vector<Dataset>& datasets);

/// theta of simulation number `index`: the material constants are drawn about their stated values.
std::vector<double> with_drawn_constants(const ImpactModel& model, std::vector<double> theta,
                                         std::uint64_t seed, std::uint64_t index);

}  // namespace recoil
