#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "estimate/model.hpp"
#include "estimate/observation.hpp"
#include "estimate/velocity_grid.hpp"

namespace recoil {

/// Which mechanisms of a model act: all, as in the data, or only those of the impact itself,
/// without errors of the measurement.
enum class Effects { as_measured, of_nature };

/// The prediction of a model for one impact.
struct Prediction {
  ImpactOutcome outcome = ImpactOutcome::integration_failure;
  double restitution_squared = 0.0;  ///< continued below zero for a capture, see ImpactResult
  std::vector<double> gradient;      ///< d e^2 / d theta [slots]; empty unless requested

  bool usable() const {
    return outcome == ImpactOutcome::rebound || outcome == ImpactOutcome::captured;
  }
  /// e [1]: 0 when captured.
  double restitution() const;
};

/// Simulates one impact under `theta`. @param diameter [m] @param velocity [m/s]
Prediction predict(const ImpactModel& model, std::span<const double> theta, std::size_t dataset,
                   double diameter, double velocity, bool gradient);

/// Evaluates the model at a fixed list of points for many theta. Quantities that do not depend on
/// theta are computed once; for few points, no memory is allocated after the first evaluation. Many
/// points are simulated in blocks on all threads of the caller's arena; results do not depend on
/// the number of threads. For few points, the results at the last theta are kept, and those at the
/// first theta with gradients, because refits of samples start there. Many points of few diameters
/// are interpolated between simulated ones (VelocityGrid). Its many private members are this
/// memory.
class PointPredictor {
 public:
  /// Keeps a reference to `model`, which must outlive it and not change.
  PointPredictor(const ImpactModel& model, std::vector<PointConditions> points,
                 Effects effects = Effects::as_measured);

  /// Simulates every point under `theta`, with gradients if `gradient`.
  /// @throws CalledOff
  void evaluate(std::span<const double> theta, bool gradient);

  /// Receives the results of points `first`, `first` + 1, ...; other threads may call it at the
  /// same time with other blocks.
  using TakeBlock = std::function<void(std::size_t first, std::span<const ImpactResult> answers)>;
  /// The same, but passes the results of many points to `take` block by block instead of keeping
  /// them; `at` and the slopes are then not available.
  void evaluate_blocks(std::span<const double> theta, bool gradient, const TakeBlock& take);
  /// Does `evaluate_blocks` keep its results, so that a second evaluation at the same theta is
  /// free?
  bool keeps_answers() const;

  std::size_t size() const { return points_.size(); }
  /// The number of impacts so far that the fast solver handed to the reference.
  long handovers() const { return handovers_; }
  /// The outcome and e^2 at point i, mechanisms included.
  const ImpactResult& at(std::size_t i) const { return results_[i]; }
  /// Writes scale * d e^2(point i) / d theta into `row` [slots].
  void gradient_row(std::size_t i, double scale, std::span<double> row) const {
    gradient_row(i, results_[i], scale, row);
  }
  /// The same for a result of `evaluate_blocks`.
  void gradient_row(std::size_t i, const ImpactResult& answer, double scale,
                    std::span<double> row) const;
  /// d e^2 / d V [s/m] and d e^2 / d D [1/m] at point i, at constant theta.
  double velocity_slope(std::size_t i) const;
  double diameter_slope(std::size_t i) const;

 private:
  /// @param grid whether points may be interpolated
  /// @param law_error null: none
  PointPredictor(const ImpactModel& model, std::vector<PointConditions> points, Effects effects,
                 bool grid, const LawError* law_error);
  /// Simulates the nodes of the grid, and the points between which it does not interpolate.
  void evaluate_grid(std::span<const double> theta, bool gradient);
  void choose_direct(std::span<const double> theta, bool gradient);
  /// A quantity of point i, given that of a simulated point: of(predictor, its index there).
  template <class Of>
  double from_grid(std::size_t i, const Of& of) const;
  void add_grid_row(std::size_t i, double scale, std::span<double> row) const;
  void take_parameters(std::span<const double> theta, bool gradient);
  void take_materials(std::span<const double> theta, bool gradient);
  void take_law_error(std::span<const double> theta);
  /// By the error of the laws at point i, for the last theta.
  double loss_factor(std::size_t i) const { return bends_.empty() ? 1.0 : bends_[i].value; }
  /// Applies the error of the laws to the answers of points `first`, `first` + 1, ...
  void bend(std::size_t first, std::span<ImpactResult> answers) const;
  void base_gradient_row(std::size_t i, const ImpactResult& answer, double scale,
                         std::span<double> row) const;
  /// The slope of e^2 at point i in an input, given that of the model: with the error of the laws.
  double bent_slope(std::size_t i, double slope, double PointConditions::*input) const;
  ImpactGroups groups_at(std::size_t i) const;
  long simulate_range(std::size_t first, const ImpactOptions& options,
                      std::span<ImpactResult> answers) const;
  void evaluate_extended(std::span<const double> theta, const ImpactOptions& options);

  const ImpactModel& model_;
  Effects effects_;
  const LawError* law_error_;
  std::vector<PointConditions> points_;
  std::optional<VelocityGrid> grid_;
  std::unique_ptr<PointPredictor> nodes_;     // of the grid
  std::unique_ptr<PointPredictor> direct_;    // points that the grid does not interpolate; or null
  std::vector<std::size_t> direct_points_;    // their indices
  std::vector<std::size_t> place_of_direct_;  // for every point its index among them, or none
  std::vector<double> node_rows_, direct_rows_;  // d e^2 / d theta there [points x slots]
  /// For every point the index of the first with the same conditions, whose result it takes; empty
  /// if all points differ.
  std::vector<std::size_t> alike_;
  std::vector<double> beta_per_f0_;          // beta over f0: beta is proportional to f0
  std::vector<double> range_per_f0_;         // Maugis's lambda over f0
  std::vector<double> C_H_, C_A_;            // per dataset at the last theta, as all below
  std::vector<double> force_, force_slope_;  // f0, and d f0 / d (adhesion parameter)
  std::vector<double> beta_scale_;           // beta relative to the stated materials
  std::vector<double> range_scale_;          // lambda relative to the stated materials
  std::vector<std::vector<MaterialSlope>> material_slopes_;  // empty if exact
  std::vector<Surroundings> surroundings_;
  std::vector<double> law_functions_;        // phi of LawError [points x coefficients]; or empty
  std::vector<LossFactor> bends_;            // of the losses [points]; or empty
  std::optional<ExtendedImpacts> extended_;  // when mechanisms act
  std::vector<std::size_t> slots_;           // slots of the values of every point, with extended_
  std::vector<double> nulls_;                // these values without a slot
  std::vector<double> values_;
  std::vector<ImpactResult> results_;
  std::vector<double> last_theta_;  // theta of results_
  bool last_gradient_ = false;
  long handovers_ = 0;
  std::vector<double> first_theta_;  // with gradients; its results are in first_results_
  std::vector<ImpactResult> first_results_;
};

/// A sphere of the stated diameter and f0 at the contact, after the mechanisms that act before it.
ContactView contact_view(const ImpactModel& model, std::span<const double> theta,
                         const PointConditions& point);

/// Simulates every point under `theta` at once.
std::vector<Prediction> predict(const ImpactModel& model, std::span<const double> theta,
                                std::vector<PointConditions> points, bool gradient);

/// e at every velocity [1] for spheres with the dataset, diameter and series of `sphere`: a curve.
/// NaN where the impact cannot be solved. @param velocities [m/s]
std::vector<double> restitution_curve(const ImpactModel& model, std::span<const double> theta,
                                      PointConditions sphere, std::span<const double> velocities,
                                      Effects effects = Effects::as_measured);

/// The energy budget of that sphere. @param impact result of the base model at its contact
WholeImpactEnergy whole_impact_energy(const ImpactModel& model, std::span<const double> theta,
                                      const PointConditions& point, const ImpactResult& impact);

}  // namespace recoil
