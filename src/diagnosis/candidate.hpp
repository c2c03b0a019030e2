#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "estimate/fit.hpp"
#include "estimate/observation.hpp"
#include "estimate/weights.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {

class Discrepancy;

/// The discrepancy of residuals that share no errors.
std::shared_ptr<const Discrepancy> nothing_shared();

/// The model of a fit with added mechanisms, prepared for refits to many samples.
struct Candidate {
  std::vector<std::string> added;  ///< ids of the added mechanisms, in the order in which they act
  bool released = false;           ///< true: parameters that the catalogue fixes are free
  FitSpec spec;
  ImpactModel model;
  std::vector<PointConditions> impacts;  ///< the conditions of all points
  int free_count = 0;

  /// The ids of the added mechanisms: "one", or "one + another".
  std::string name() const;
  bool adds(const std::string& id) const;
  /// Does `slot` belong to one of the added mechanisms?
  bool adds(const ParameterSlot& slot) const;
};

/// The index of a mechanism's first parameter among those of the chain, as in
/// ImpactModel::slot_own; the number of these parameters if the mechanism is not in the chain.
std::size_t first_parameter(const ImpactModel& model, const Mechanism& mechanism);

/// The mechanisms of the catalogue that the model lacks and could have: they work with its adhesion
/// law and act in at least one dataset.
std::vector<const Mechanism*> mechanisms_that_may_act(const FitSpec& spec,
                                                      const ImpactModel& model);

/// The slot of the strength of `mechanism`, which is its first parameter.
/// @pre it is in the chain, and its strength is not one per series
const ParameterSlot& strength_at(const ImpactModel& model, const Mechanism& mechanism,
                                 const PointConditions& at);

/// Does a stated condition remove `mechanism` from this impact?
bool is_taken_away(const ImpactModel& model, const Mechanism& mechanism, const PointConditions& at);

/// The allowed values of slot `j`, a parameter of a mechanism, in the impacts of `candidate` with
/// the other parameters at `theta`.
AllowedValues allowed_values(const Candidate& candidate, std::span<const double> theta,
                             std::size_t j);

/// `spec` with the mechanisms `added` to its own and their parameters as in the catalogue.
/// @param release also free the parameters that the catalogue fixes
/// @param possible keep them near the physically plausible range
Candidate make_candidate(const FitSpec& spec, const std::vector<Dataset>& datasets,
                         const std::vector<std::string>& added, bool release = false,
                         bool possible = false);

/// The fit of one candidate to one sample with fixed weights, so that the deviances of all
/// candidates belong to the same likelihood.
struct Refit {
  bool usable = false;
  std::vector<double> theta;      ///< [slots]
  double chi2 = 0.0;              ///< sum of the squares of `residuals`
  std::vector<double> residuals;  ///< weighted, whitened by `discrepancy` [points]
  std::vector<double> jacobian;   ///< d residual / d theta [points x slots]
  /// [slots] free and not at a bound; a constant if the points determine it.
  std::vector<bool> moving;
  std::shared_ptr<const Discrepancy> discrepancy = nothing_shared();
  double law_error = 0.0;  ///< size of the laws' error in it, relative to the loss [1]

  /// The indices of the moving slots.
  std::vector<std::size_t> moving_slots() const;

  RECOIL_FIELDS(usable, theta, chi2, residuals, jacobian, moving, law_error)
};

/// Start values for the model `to`: its moving slots take the values of `theta` under `model` that
/// have the same label; the others keep their initial values.
std::vector<double> carried_over(const ImpactModel& model, std::span<const double> theta,
                                 const ImpactModel& to);

/// The residuals of the points of a simulated data set after a descent from `near`; nullopt if it
/// fails. The parameters are within a thousandth of their errors.
std::optional<std::vector<double>> residuals_of_refit(const Candidate& candidate,
                                                      const WeightedData& sample,
                                                      std::span<const double> near,
                                                      const Discrepancy& discrepancy);

/// Minimises from `near`, with the parameters of the added mechanisms also at every start that the
/// catalogue advises; of these starts it follows the `tries` with the smallest deviance and, if
/// `tries` exceeds one, as many with a tenth of the damping of the base model. With `tries` = 0 it
/// follows only `near`. One mechanism is followed to the minimum; if it lowers the deviance by less
/// than 1e-6, it gets the values at which it vanishes. Of two, hundreds of pairs are fitted and
/// compared by a margin of 6; their descents end where the criterion is known to 0.1.
/// @param near theta of the candidate, for example with the base parameters of a fit without the
///   mechanisms
/// @param discrepancy the errors that the residuals share
Refit refit_candidate(const Candidate& candidate, const Observations& data, const Weights& weights,
                      std::span<const double> near, int tries,
                      std::shared_ptr<const Discrepancy> discrepancy = nothing_shared());

/// D + 2 k + 2 k (k + 1) / (n - k - 1), with k the number of free parameters (including the scale
/// if it is estimated): Hurvich & Tsai (1989), Biometrika 76, 297-307. D is -2 ln likelihood up to
/// a constant: the deviance if standard deviations are stated; n ln(deviance / n) if only their
/// ratios are known and their scale is estimated.
double corrected_criterion(const Observations& data, double chi2, int free_count);

/// The same for a refit, including the determinant of its covariance in the likelihood.
double corrected_criterion(const Observations& data, const Refit& refit, int free_count);

}  // namespace recoil
