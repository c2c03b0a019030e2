#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "core/names.hpp"
#include "diagnosis/candidate.hpp"

namespace recoil {

struct LawErrors;

/// What the points of a block have in common.
enum class FoldKind { size, velocity, target };
template <>
struct NamesOf<FoldKind> {
  static constexpr std::array<std::string_view, 3> names = {"size", "velocity", "target"};
};

/// A block of points that is predicted from the others.
struct Fold {
  FoldKind kind = FoldKind::size;
  double lower = 0.0, upper = 0.0;  ///< of the diameters [m] or velocities [m/s]
  std::size_t dataset = 0;          ///< the target
  std::vector<std::size_t> points;
};

/// Every diameter (of more than six: six groups of neighbours), the lower, middle and upper third
/// of ln V, and every dataset of several. Blocks that leave too few points to fit are left out.
/// Single points are not held out: their neighbours would tell what they are.
/// @param datasets how many there are
std::vector<Fold> held_out_folds(const Observations& data, std::size_t datasets, int free_count);

/// How one model predicts the points of one fold from all others.
struct FoldPrediction {
  bool usable = false;
  double criterion = 0.0;  ///< of the fit to the other points, `corrected_criterion`
  /// -2 ln likelihood of the fold, given the other points, but for a constant: the sum of r^2, of
  /// each no more than 25, r whitened.
  double deviance = 0.0;
  std::vector<double> error;  ///< e - e_model of each point of the fold [1]
};

/// What the other points say of the errors of the laws they say of the fold, too: with residuals r
/// and errors U of the points seen (s) and of the fold (f), those of the fold are
///   r_f - U_f (I + U_s' U_s)^-1 U_s' r_s,  of covariance I + U_f (I + U_s' U_s)^-1 U_f'.
/// @param near where the refits start [slots of the candidate]
std::vector<FoldPrediction> predict_folds(const Candidate& candidate, const Observations& data,
                                          const LawErrors& laws, const std::vector<Fold>& folds,
                                          std::span<const double> near, int threads);

/// What an extended model gains over the base on data that neither has seen. Sizes and targets that
/// were held out decide, where there are any; a band of velocities need not hold what determines a
/// mechanism (yield, without the fast impacts) and is shown beside them.
struct HeldOutGain {
  struct PerFold {
    Fold fold;
    double rmse_base = 0.0, rmse_extended = 0.0;  ///< of e [1]
    double log_score = 0.0;  ///< gain of ln likelihood, no miss taken for more than 5 sd [nat]
    bool counted = true;     ///< in the sums below
    bool chosen = true;      ///< the extended model, by the other points
  };
  bool decisive = false;  ///< are the sums those of sizes and targets?
  std::vector<PerFold> folds;
  double rmse_base = 0.0, rmse_extended = 0.0;  ///< over the counted folds [1]
  double relative = 0.0;                        ///< 1 - rmse_extended / rmse_base [1]
  double log_score = 0.0;                       ///< sum over the folds [nat]
  /// Of `relative`, 95 %: percentile of 1999 samples in which the points of every fold are drawn
  /// with replacement. It knows the scatter of the held-out points, not that of the fits.
  std::optional<double> lower, upper;

  /// Does any block that counts have other points that choose the extended model? Where none has,
  /// what was held out says nothing of it.
  bool any_chosen() const {
    return std::any_of(folds.begin(), folds.end(),
                       [](const PerFold& one) { return one.counted && one.chosen; });
  }
};

/// A fold is predicted by the model that the other points choose: by the base again where its
/// criterion on them is the smaller one. What they do not show they cannot predict, and a parameter
/// that nothing holds predicts anything (a slowest rebound, without the sphere that was so slow).
/// Folds in which either model has no answer are left out.
HeldOutGain held_out_gain(const std::vector<Fold>& folds, const std::vector<FoldPrediction>& base,
                          std::vector<FoldPrediction> extended, std::uint64_t seed);

}  // namespace recoil
