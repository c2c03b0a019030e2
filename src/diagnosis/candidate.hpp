#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "estimate/fit.hpp"
#include "estimate/observation.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {

class Discrepancy;

/// The discrepancy of residuals with nothing but their own noise.
std::shared_ptr<const Discrepancy> nothing_shared();

/// The model of a fit with further mechanisms, ready to be refitted to many samples.
struct Candidate {
  std::vector<std::string>
      added;              ///< ids of the further mechanisms, in the order in which they act
  bool released = false;  ///< parameters that the catalogue holds fixed are free
  FitSpec spec;
  ImpactModel model;
  std::vector<PointConditions> impacts;  ///< all of the datasets
  int free_count = 0;

  /// The ids of what is added: one, or "one + another".
  std::string name() const;
  bool adds(const std::string& id) const;
  /// Does `slot` belong to one of the further mechanisms?
  bool adds(const ParameterSlot& slot) const;
};

/// The place of a mechanism's first parameter among those of the chain, as in
/// ImpactModel::slot_own; their number if it is not in the chain.
std::size_t first_parameter(const ImpactModel& model, const Mechanism& mechanism);

/// What of the catalogue the model does not have and could have: it knows the law of adhesion and
/// acts somewhere.
std::vector<const Mechanism*> mechanisms_that_may_act(const FitSpec& spec,
                                                      const ImpactModel& model);

/// The slot of the strength of `mechanism`, which is the first of its parameters.
/// @pre it is in the chain, and its strength is not one per series.
const ParameterSlot& strength_at(const ImpactModel& model, const Mechanism& mechanism,
                                 const PointConditions& at);

/// Does a stated condition take `mechanism` away from this impact?
bool is_taken_away(const ImpactModel& model, const Mechanism& mechanism, const PointConditions& at);

/// What values the parameter of slot `j`, of a mechanism, can have in the impacts of `candidate`
/// while the others are at `theta`.
AllowedValues allowed_values(const Candidate& candidate, std::span<const double> theta,
                             std::size_t j);

/// `spec` with the mechanisms `added` on top of its own, their parameters as the catalogue has
/// them.
/// @param release free those parameters too that the catalogue holds fixed
/// @param possible keep them within the range that is physically plausible
Candidate make_candidate(const FitSpec& spec, const std::vector<Dataset>& datasets,
                         const std::vector<std::string>& added, bool release = false,
                         bool possible = false);

/// The fit of one candidate to one sample under weights that stay as they are, so that the
/// deviances of all candidates are those of one likelihood.
struct Refit {
  bool usable = false;
  std::vector<double> theta;      ///< [slots]
  double chi2 = 0.0;              ///< sum of the squares of `residuals`
  std::vector<double> residuals;  ///< weighted, whitened by `discrepancy` [points]
  std::vector<double> jacobian;   ///< d residual / d theta [points x slots]
  std::vector<bool> moving;       ///< [slots] free, and not resting on a bound
  std::shared_ptr<const Discrepancy> discrepancy = nothing_shared();

  RECOIL_FIELDS(usable, theta, chi2, residuals, jacobian, moving)
};

/// Start values for the model `to`: its moving slots take the values of `theta` under `model` that
/// have the same label; the others keep their initial values.
std::vector<double> carried_over(const ImpactModel& model, std::span<const double> theta,
                                 const ImpactModel& to);

/// Minimises from `near`, with the parameters of the added mechanisms also at every start that the
/// catalogue advises; of these starts the `tries` with the smallest deviance are followed, and as
/// many with the damping of the base model taken down to a tenth, if `tries` exceeds one. With no
/// tries only `near` is followed.
/// @param near theta of the candidate: the base parameters of a fit without the mechanisms, say
/// @param discrepancy what the residuals share beside their own noise
Refit refit_candidate(const Candidate& candidate, const Observations& data,
                      std::span<const double> near, int tries,
                      std::shared_ptr<const Discrepancy> discrepancy = nothing_shared());

/// -2 ln likelihood but for a constant: the deviance where standard deviations are stated,
/// n ln(deviance / n) where only their proportions are known and their scale is estimated.
double log_deviance(const Observations& data, double chi2);

/// log_deviance + 2 k + 2 k (k + 1) / (n - k - 1), k the number of free parameters (and of the
/// scale, where it is estimated): Hurvich & Tsai (1989), Biometrika 76, 297-307.
double corrected_criterion(const Observations& data, double chi2, int free_count);

/// The same for a refit, whose covariance counts in the likelihood by its determinant.
double corrected_criterion(const Observations& data, const Refit& refit, int free_count);

}  // namespace recoil
