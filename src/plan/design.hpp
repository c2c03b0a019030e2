#pragma once

#include <Eigen/Dense>
#include <vector>

namespace recoil {

/// The choice among possible points that minimises the variances of given quantities. A point i
/// adds the information x_i x_i' about p parameters; with n_i points of each kind,
///   M = known + sum n_i x_i x_i',
/// and the quantities are linear functions c of the parameters, with the variances c' M^-1 c.
///
/// Where x_i and c depend on values that only the experiment will tell, there is one problem for
/// each draw of these values, all with the same possible points. The functions below then minimise
/// the geometric mean over the draws of the sum of the variances,
///   exp(mean ln sum c' M^-1 c),
/// so that every draw counts by the share of its information that is lost, however large its
/// variances are: Chaloner, K. & Larntz, K. (1989), J. Stat. Plan. Inference 21, 191-208; Atkinson,
/// A. C., Donev, A. N. & Tobias, R. D. (2007), Optimum Experimental Designs, with SAS, chapter 18.
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

using DesignProblems = std::vector<DesignProblem>;  ///< one for each draw

/// The geometric mean of the sum of the variances; infinite if M is singular under a draw.
double mean_sum_of(const DesignProblems& draws, const std::vector<double>& counts);

/// The shares of `points` points that minimise `mean_sum_of` (with one draw a linear optimality
/// criterion; for a single c: c-optimality), by the multiplicative algorithm
///   w_i <- w_i d_i^(1/2) / sum w_j d_j^(1/2),  d_i = mean |C' M^-1 x_i|^2 / sum c' M^-1 c,
/// which with one draw decreases the sum in every step if `known` is 0: Silvey, S. D.,
/// Titterington, D. M. & Torsney, B. (1978), Commun. Stat. A 7, 1379-1389; Yu, Y. (2010), Ann.
/// Stat. 38, 1593-1606. It ends when no d_i of
/// all places exceeds the weighted average by more than 0.2 % (several draws: 1 %).
/// @param shares where to start; empty: equal shares
std::vector<double> optimal_shares(const DesignProblems& draws, double points,
                                   std::vector<double> shares = {});

/// A lower bound of `mean_sum_of` for any choice of as many points as `counts`: its logarithm is
/// convex in the counts and lies above its tangent.
double least_possible_sum(const DesignProblems& draws, const std::vector<double>& counts);

/// `points` integer counts in proportion to `shares`: the efficient rounding of Pukelsheim, F. &
/// Rieder, S. (1992), Biometrika 79, 763-770.
std::vector<int> whole_points(const std::vector<double>& shares, int points);

/// `counts` after exchanges of one point for another that decrease `mean_sum_of`; tried are those
/// with the largest d_j - d_i: Fedorov, V. V. (1972), Theory of Optimal Experiments, chapter 3.
std::vector<int> after_exchanges(const DesignProblems& draws, std::vector<int> counts);

}  // namespace recoil
