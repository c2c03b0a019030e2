#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "estimate/model.hpp"
#include "estimate/observation.hpp"

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
/// out once, and few points are answered without allocating anything after the first evaluation.
/// Many points fly in blocks, on all threads of the arena that asks; no digit depends on that. The
/// answers of few points to the first theta with gradients are kept, because refits of many samples
/// begin at one place, and those to the last theta.
class PointPredictor {
 public:
  /// Refers to `model`, which must outlive it unchanged.
  PointPredictor(const ImpactModel& model, std::vector<PointConditions> points,
                 Effects effects = Effects::as_measured);

  /// Simulates every point under `theta`, with gradients when asked for.
  /// @return how many impacts the fast solver handed over to the reference
  /// @throws CalledOff
  long evaluate(std::span<const double> theta, bool gradient);

  /// What takes the answers of points `first`, `first` + 1 ...; other blocks may come at the same
  /// time on other threads.
  using TakeBlock = std::function<void(std::size_t first, std::span<const ImpactResult> answers)>;
  /// The same, but the answers of many points are handed over block by block instead of kept, so
  /// that `at` and the slopes have none.
  long evaluate_blocks(std::span<const double> theta, bool gradient, const TakeBlock& take);
  /// Does `evaluate_blocks` keep its answers, so that the same theta costs nothing a second time?
  bool keeps_answers() const;

  std::size_t size() const { return points_.size(); }
  /// The outcome and e^2 at point i, mechanisms included.
  const ImpactResult& at(std::size_t i) const { return results_[i]; }
  /// Writes scale * d e^2(point i) / d theta into `row` [slots].
  void gradient_row(std::size_t i, double scale, std::span<double> row) const {
    gradient_row(i, results_[i], scale, row);
  }
  /// The same for an answer that `evaluate_blocks` gave.
  void gradient_row(std::size_t i, const ImpactResult& answer, double scale,
                    std::span<double> row) const;
  /// d e^2 / d V [s/m] and d e^2 / d D [1/m] at point i, theta held.
  double velocity_slope(std::size_t i) const;
  double diameter_slope(std::size_t i) const;

 private:
  void take_parameters(std::span<const double> theta, bool gradient);
  void take_materials(std::span<const double> theta, bool gradient);
  ImpactGroups groups_at(std::size_t i) const;
  long fly(std::size_t first, const ImpactOptions& options, std::span<ImpactResult> answers) const;
  long evaluate_extended(std::span<const double> theta, const ImpactOptions& options);

  const ImpactModel& model_;
  std::vector<PointConditions> points_;
  /// Of every point the first under the same conditions, which answers for it (itself: none); empty
  /// where no two are alike.
  std::vector<std::size_t> alike_;
  std::vector<double> beta_per_f0_;          // beta is proportional to f0,
  std::vector<double> range_per_f0_;         // and so is Maugis's lambda
  std::vector<double> C_H_, C_A_;            // per dataset, under the last theta, as all below
  std::vector<double> force_, force_slope_;  // f0, and its slope in its parameter
  std::vector<double> beta_scale_;           // beta over that of the stated materials
  std::vector<double> range_scale_;          // and lambda
  std::vector<std::vector<MaterialSlope>> material_slopes_;  // where uncertain
  std::vector<Surroundings> surroundings_;
  std::optional<ExtendedImpacts> extended_;  // when mechanisms act
  std::vector<std::size_t> slots_;           // of the values of every point, with extended_
  std::vector<double> nulls_;                // of these values where there is no slot
  std::vector<double> values_;
  std::vector<ImpactResult> results_;
  std::vector<double> last_theta_;  // of results_
  bool last_gradient_ = false;
  std::vector<double> first_theta_;  // with gradients
  std::vector<ImpactResult> first_results_;
};

/// The typical sphere of a point as the mechanisms leave it at the contact.
ContactView contact_view(const ImpactModel& model, std::span<const double> theta,
                         const PointConditions& point);

/// Simulates every point under `theta` at once.
std::vector<Prediction> predict(const ImpactModel& model, std::span<const double> theta,
                                std::vector<PointConditions> points, bool gradient);

/// Where the kinetic energy of that sphere goes. @param impact of the base model at its contact
WholeImpactEnergy whole_impact_energy(const ImpactModel& model, std::span<const double> theta,
                                      const PointConditions& point, const ImpactResult& impact);

}  // namespace recoil
