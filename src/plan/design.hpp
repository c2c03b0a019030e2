#pragma once

#include <Eigen/Dense>
#include <vector>

namespace recoil {

/// The choice among possible points that minimises the variances of given quantities. A point i
/// adds the information x_i x_i' about p parameters; with n_i points of each kind,
///   M = known + sum n_i x_i x_i',
/// and the quantities are linear functions c of the parameters, with the variances c' M^-1 c.
struct DesignProblem {
  Eigen::MatrixXd rows;   ///< x_i' [possible points x p]
  Eigen::MatrixXd known;  ///< information without these points [p x p]
  Eigen::MatrixXd asked;  ///< the quantities c, one column each [p x asked]
};

/// Whole counts, for the functions below.
std::vector<double> numbers_of(const std::vector<int>& counts);

/// M for `counts` n_i, which need not be integers [p x p].
Eigen::MatrixXd information_of(const DesignProblem& problem, const std::vector<double>& counts);

/// c' M^-1 c of every c; infinite if M is singular [asked].
Eigen::VectorXd variances_of(const DesignProblem& problem, const std::vector<double>& counts);

/// The shares of `points` points that minimise the sum of the variances (a linear optimality
/// criterion; for a single c: c-optimality), by the multiplicative algorithm
///   w_i <- w_i d_i^(1/2) / sum w_j d_j^(1/2),  d_i = |C' M^-1 x_i|^2,
/// which decreases the sum in every step if `known` is 0: Silvey, S. D., Titterington, D. M. &
/// Torsney, B. (1978), Commun. Stat. A 7, 1379-1389; Yu, Y. (2010), Ann. Stat. 38, 1593-1606. It
/// ends when no d_i exceeds the weighted average by more than 0.2 %.
std::vector<double> optimal_shares(const DesignProblem& problem, double points);

/// A lower bound of the sum of the variances for any choice of as many points as `counts`: the sum
/// is convex in the counts and lies above its tangent.
double least_possible_sum(const DesignProblem& problem, const std::vector<double>& counts);

/// `points` integer counts in proportion to `shares`: the efficient rounding of Pukelsheim, F. &
/// Rieder, S. (1992), Biometrika 79, 763-770.
std::vector<int> whole_points(const std::vector<double>& shares, int points);

/// `counts` after exchanges of one point for another that decrease the sum of the variances, the
/// best exchange first: Fedorov, V. V. (1972), Theory of Optimal Experiments, chapter 3.
std::vector<int> after_exchanges(const DesignProblem& problem, std::vector<int> counts);

}  // namespace recoil
