#pragma once

#include <Eigen/Dense>
#include <vector>

#include "data/dataset.hpp"
#include "diagnosis/candidate_result.hpp"
#include "diagnosis/search.hpp"

namespace recoil {

/// Impacts that could be made, and the standard deviation of e of one of them [1].
struct PossibleImpacts {
  std::vector<PointConditions> at;
  std::vector<double> sd;
};

/// What a rival predicts of possible impacts.
struct PredictedSpread {
  std::vector<double> restitution;  ///< mean e, 0 where captured; NaN without an answer
  /// Of the prediction, in units of the variance of one impact: how far the parameters are known
  /// from the points, and how wrong the laws may be there, given how they do on the points.
  std::vector<double> variance;
};

/// The predictive distribution of `rival` after the points of `base`, linear in the parameters that
/// move and in the errors of the laws (`LawErrors`), normal: with A the weighted slopes of the
/// points in both and r their weighted residuals at the fit, both have the mean -(A'A + I')^(-1)
/// A'r and the covariance (A'A + I')^(-1), I' of the errors of laws alone, which are one a priori:
/// what the points say of the errors of a law moves its predictions, too.
/// @param without a mechanism that a changed condition takes away from the possible impacts; null:
///   none
PredictedSpread predicted_spread(const SearchBase& base, const CandidateResult& rival,
                                 const PossibleImpacts& possible,
                                 const Mechanism* without = nullptr);

/// What a rival predicts of several impacts together, each at a place of its own.
struct PredictedTogether {
  Eigen::VectorXd restitution;  ///< mean e, 0 where captured; NaN without an answer
  Eigen::MatrixXd covariance;   ///< of the predictions, each in the deviation of one impact; empty
                                ///< without an answer
};

/// A rival's model of all that was measured and of impacts on another target, `Elsewhere`.
class RivalElsewhere {
 public:
  /// @param target `on_target` of a dataset of `base`, at place `like`
  RivalElsewhere(const SearchBase& base, const CandidateResult& rival, const Dataset& target,
                 std::size_t like);

  /// e at places on the target with its damping and adhesion as on the present one, or as they
  /// would follow from the materials; NaN without an answer.
  std::vector<double> restitution(const std::vector<PointConditions>& at) const;

  /// The predictive distribution as in `predicted_spread`; the errors of the laws are the same on
  /// both targets.
  PredictedTogether predicted(const PossibleImpacts& possible) const;

 private:
  const SearchBase& base_;
  CandidateResult rival_;       ///< with the target
  Eigen::VectorXd precisions_;  ///< known beforehand of its parameters [slots]
};

}  // namespace recoil
