#pragma once

#include <Eigen/Dense>
#include <optional>

#include "plan/possible_causes.hpp"

namespace recoil {

inline constexpr int most_more_impacts = 10000;  ///< on top of a plan

/// What is true, seen by one who takes another effect for it, or the base model: what that leaves
/// of the truth at the settings, and what more impacts would add (`planned_causes`).
class Comparison {
 public:
  /// @param rival null: the base model
  /// @param least,most what the amplitude of `rival` can be, over itself
  Comparison(const PlanGround& ground, double law_error, const Effect& truth, const Effect* rival,
             double least, double most);

  /// To be expected for the truth.
  double log_odds() const { return 0.5 * chi2_; }

  /// Impacts at place `i` for expected odds of 99 to 1, where a condition may have taken away the
  /// truth or the rival; none where `most_more_impacts` would not do.
  std::optional<int> impacts_for(Eigen::Index i, bool no_truth, bool no_rival) const;

 private:
  Eigen::Index functions() const { return ground_.functions.cols(); }
  void lay_out();
  Eigen::VectorXd left() const;
  double product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const;

  const PlanGround& ground_;
  double law_error_;
  const Effect& truth_;
  const Effect* rival_;
  double k_ = 0.0;
  Eigen::Index of_truth_ = 0, of_rival_ = 0;
  Eigen::MatrixXd columns_;
  Eigen::LDLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd found_;
  double chi2_ = 0.0;
};

/// With that effect of `rival` that does best in the place of `truth`; none where it does nothing
/// at the settings.
std::optional<Comparison> closest_comparison(const PlanGround& ground, double law_error,
                                             const PossibleCause& truth,
                                             const PossibleCause& rival);

}  // namespace recoil
