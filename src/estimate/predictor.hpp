#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "estimate/model.hpp"
#include "estimate/point_conditions.hpp"

namespace recoil {

/// Which mechanisms of a model act: all, as in the data, or only those that are no error of the
/// measurement, for what a sphere does whether it is measured or not.
enum class Effects { as_measured, of_nature };

/// A model's answer for one (diameter, velocity).
struct Prediction {
  ImpactOutcome outcome = ImpactOutcome::integration_failure;
  double restitution_squared = 0.0;  ///< continued below zero for a capture, see ImpactResult
  std::vector<double> gradient;      ///< d e^2 / d theta, one per slot; empty unless asked for

  bool usable() const {
    return outcome == ImpactOutcome::rebound || outcome == ImpactOutcome::captured;
  }
  /// e [1]: 0 when captured.
  double restitution() const;
};

/// Simulates one impact under `theta`.
Prediction predict(const ImpactModel& model, std::span<const double> theta, std::size_t dataset,
                   double diameter, double velocity, bool gradient);

/// The model at a fixed list of points under many theta: what does not depend on theta is worked
/// out once, all points fly together, and nothing is allocated after the first evaluation.
class PointPredictor {
 public:
  /// Refers to `model`, which must outlive it.
  PointPredictor(const ImpactModel& model, std::vector<PointConditions> points,
                 Effects effects = Effects::as_measured);

  /// Simulates every point under `theta`, with gradients when asked for.
  /// @return how many impacts the fast solver handed over to the reference
  /// @throws CalledOff
  long evaluate(std::span<const double> theta, bool gradient);

  std::size_t size() const { return points_.size(); }
  /// The outcome and e^2 at point i, mechanisms included.
  const ImpactResult& at(std::size_t i) const { return results_[i]; }
  /// Writes scale * d e^2(point i) / d theta into `row` [slots].
  void gradient_row(std::size_t i, double scale, std::span<double> row) const;
  /// d e^2 / d V [s/m] and d e^2 / d D [1/m] at point i, theta held.
  double velocity_slope(std::size_t i) const;
  double diameter_slope(std::size_t i) const;

 private:
  void take_materials(std::span<const double> theta, bool gradient);
  long evaluate_extended(std::span<const double> theta, const ImpactOptions& options);

  const ImpactModel& model_;
  std::vector<PointConditions> points_;
  std::vector<double> beta_per_f0_;          // beta is proportional to f0,
  std::vector<double> range_per_f0_;         // and so is Maugis's lambda
  std::vector<double> force_, force_slope_;  // per dataset: f0, and its slope in its parameter
  std::vector<double> beta_scale_;           // per dataset: beta over that of the stated materials
  std::vector<double> range_scale_;          // and lambda
  std::vector<std::vector<MaterialSlope>> material_slopes_;  // per dataset, where uncertain
  std::vector<Surroundings> surroundings_;                   // per dataset, under the last theta
  std::optional<ExtendedImpacts> extended_;                  // when mechanisms act
  std::vector<std::size_t> slots_;  // of the values of every point, with extended_
  std::vector<double> nulls_;       // of these values where there is no slot
  std::vector<double> values_;
  std::vector<ImpactGroups> groups_;
  std::vector<ImpactResult> results_;
};

/// The typical sphere of a point as the mechanisms leave it at the contact.
ContactView contact_view(const ImpactModel& model, std::span<const double> theta,
                         const PointConditions& point);

/// Simulates every point under `theta` at once.
std::vector<Prediction> predict(const ImpactModel& model, std::span<const double> theta,
                                std::vector<PointConditions> points, bool gradient);

}  // namespace recoil
