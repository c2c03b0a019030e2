#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/names.hpp"
#include "diagnosis/candidate.hpp"

namespace recoil {

struct LawErrors;

/// The quantity by which the points of a block belong together.
enum class FoldKind { size, velocity, target };
constexpr auto names_of_values(FoldKind) { return name_list("size", "velocity", "target"); }

/// A block of points that is predicted from the others.
struct Fold {
  FoldKind kind = FoldKind::size;
  double lower = 0.0, upper = 0.0;  ///< range of the diameters [m] or velocities [m/s]
  std::size_t dataset = 0;          ///< the dataset of a target
  std::vector<std::size_t> points;
};

/// The blocks: every diameter (six groups of neighbours if there are more than six), the lower,
/// middle and upper third of ln V, and every dataset if there are several. Blocks that leave too
/// few points for a fit are omitted. Single points are not held out, because their neighbours
/// predict them under any model.
/// @param datasets number of datasets
std::vector<Fold> held_out_folds(const Observations& data, std::size_t datasets, int free_count);

/// The prediction of the points of one fold by a model fitted to the others.
struct FoldPrediction {
  bool usable = false;
  double criterion = 0.0;  ///< `corrected_criterion` of the fit to the other points
  /// -2 ln likelihood of the fold given the other points, up to a constant: the sum of min(r^2, 25)
  /// over its whitened residuals r, plus ln det of their covariance.
  double deviance = 0.0;
  std::vector<double> error;  ///< e - e_model of each point of the fold [1]
};

/// Predicts every fold from the other points. The errors of the laws that the other points show are
/// applied to the fold, of the size under which `refit` was made: with residuals r and errors U of
/// the points seen (s) and of the fold (f), the residuals of the fold are
///   r_f - U_f (I + U_s' U_s)^-1 U_s' r_s, with covariance I + U_f (I + U_s' U_s)^-1 U_f'.
/// @param all the refit to all points, with which the refits start
std::vector<FoldPrediction> predict_folds(const Candidate& candidate, const Observations& data,
                                          const Weights& weights, const LawErrors& laws,
                                          const std::vector<Fold>& folds, const Refit& all,
                                          int threads);

/// The gain of an extended model over the base on held-out data. Held-out sizes and targets decide
/// if there are any. Bands of velocities are only shown then: the other bands may lack the impacts
/// that determine a mechanism (yield, without the fast impacts).
struct HeldOutGain {
  struct PerFold {
    Fold fold;
    double rmse_base = 0.0, rmse_extended = 0.0;  ///< of e [1]
    double log_score = 0.0;  ///< gain of ln likelihood, with deviations limited to 5 sd [nat]
    bool counted = true;     ///< included in the sums below
    bool chosen = true;      ///< the other points select the extended model
  };
  bool decisive = false;  ///< the sums are over sizes and targets
  std::vector<PerFold> folds;
  double rmse_base = 0.0, rmse_extended = 0.0;  ///< over the counted folds [1]
  double relative = 0.0;                        ///< 1 - rmse_extended / rmse_base [1]
  double log_score = 0.0;                       ///< sum over the folds [nat]
  /// 95 % interval of `relative`: percentiles of 1999 samples in which the points of every fold are
  /// drawn with replacement. It includes the scatter of the held-out points, not that of the fits.
  std::optional<double> lower, upper;

  /// Do the other points of any counted block select the extended model? If not, the held-out data
  /// do not test it.
  bool any_chosen() const {
    return std::any_of(folds.begin(), folds.end(),
                       [](const PerFold& one) { return one.counted && one.chosen; });
  }
};

/// The gain over all folds. Each fold is predicted by the model with the smaller criterion on the
/// other points, extended or base: points that do not show an effect cannot predict it, and an
/// undetermined parameter predicts anything (for example the slowest rebound without the slowest
/// sphere). Folds in which a fit fails are omitted.
HeldOutGain held_out_gain(const std::vector<Fold>& folds, const std::vector<FoldPrediction>& base,
                          std::vector<FoldPrediction> extended, std::uint64_t seed);

}  // namespace recoil
