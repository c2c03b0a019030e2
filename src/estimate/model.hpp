#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "impact/contact.hpp"
#include "impact/impact.hpp"
#include "mechanism/extended_impacts.hpp"

namespace recoil {

/// Which integrator answers: the fast fixed-order one (which hands over to the reference by itself
/// outside the region where it is certified) or CVODES throughout.
enum class Solver { fast, reference };

/// One entry of the parameter vector theta.
struct ParameterSlot {
  std::string name;     ///< of the catalogue: "C_H"
  std::string unit;     ///< [s/m], [N/m]
  std::string dataset;  ///< id when the parameter is `per = "dataset"`, else empty
  double initial = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  bool free = true;
  bool log_scale = false;
  std::string mechanism = {};       ///< id of that to which it belongs; empty for the base model
  std::string series = {};          ///< name when every series has its own, else empty
  double null_value = 0.0;          ///< of a mechanism's parameter: here the mechanism vanishes
  std::vector<double> starts = {};  ///< further ones worth trying

  /// "C_A", "C_A[wall1990-mica]", "series_offset[monday]", "series_offset[wall1990-mica/monday]".
  std::string label() const;
};

/// The model applied to the datasets of one fit: what the parameters are and how they enter.
struct ImpactModel {
  AdhesionDampingPhase phase = AdhesionDampingPhase::rebound;
  Solver solver = Solver::fast;
  double loosened = 1.0;  ///< the solver's tolerance is its own times this
  std::vector<ParameterSlot> slots;
  std::vector<ContactProperties> contacts;               ///< per dataset
  std::vector<std::size_t> slot_C_H, slot_C_A, slot_f0;  ///< per dataset: index into `slots`

  std::vector<const Mechanism*> chain;     ///< in the order in which they act
  std::vector<Surroundings> surroundings;  ///< per dataset
  /// [parameter of the chain][dataset]: index into `slots`, one or one per series.
  std::vector<std::vector<std::vector<std::size_t>>> slot_own;

  std::vector<double> initial() const;
};

/// theta with every mechanism at its null value: the base model.
std::vector<double> without_mechanisms(const ImpactModel& model, std::vector<double> theta);

/// Lays out theta for `spec`. f0 that is not free, or has no stated start, takes the value of eq.
/// 12 for its dataset.
ImpactModel make_model(const FitSpec& spec, const std::vector<Dataset>& datasets);

/// A sphere of one dataset about to hit: where a model is asked for an answer.
struct PointConditions {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  std::size_t series = no_series;

  /// A sphere of no series in particular: what belongs to a series is left out.
  static constexpr std::size_t no_series = static_cast<std::size_t>(-1);
};

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

/// SI conditions of an impact under `theta`. @pre theta.size() == model.slots.size()
ImpactConditions conditions_at(const ImpactModel& model, std::span<const double> theta,
                               std::size_t dataset, double diameter, double velocity);

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
  long evaluate_extended(std::span<const double> theta, const ImpactOptions& options);

  const ImpactModel& model_;
  std::vector<PointConditions> points_;
  std::vector<double> beta_per_f0_;          // beta is proportional to f0
  std::optional<ExtendedImpacts> extended_;  // when mechanisms act
  std::vector<std::size_t> slots_;           // of the values of every point, with extended_
  std::vector<double> nulls_;                // of these values where there is no slot
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

/// A velocity below which spheres are captured, with its gradient.
struct CaptureVelocity {
  bool found = false;
  double value = 0.0;            ///< V* [m/s]; 0 without adhesion (nothing is captured)
  std::vector<double> gradient;  ///< d V* / d theta
};

/// A sphere whose capture velocity is sought.
struct CaptureQuery {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double guess = 0.0;     ///< [m/s] where to look first; 0 uses the law for small damping
};

/// Solves e^2(V) = 0 for the largest V at which capture turns into rebound, for all spheres
/// together. Errors of the measurement (Effects) are left out.
std::vector<CaptureVelocity> capture_velocities(const ImpactModel& model,
                                                std::span<const double> theta,
                                                std::span<const CaptureQuery> queries);

/// V* to the first order in the damping, without solving an impact (see `settle`): for weights.
/// 0 where nothing is captured.
double weakly_damped_capture(const ImpactModel& model, std::span<const double> theta,
                             std::size_t dataset, double diameter);

/// The same for one sphere.
CaptureVelocity capture_velocity(const ImpactModel& model, std::span<const double> theta,
                                 std::size_t dataset, double diameter, double guess = 0.0);

}  // namespace recoil
