#pragma once

#include <Eigen/Dense>
#include <vector>

namespace recoil {

/// Which of many possible points to make, so that what is asked is known best. A point i adds the
/// information x_i x_i' about p parameters; with n_i of each,
///   M = known + sum n_i x_i x_i',
/// and what is asked are linear functions c of the parameters, with the variances c' M^-1 c.
struct DesignProblem {
  Eigen::MatrixXd rows;   ///< x_i' [possible points x p]
  Eigen::MatrixXd known;  ///< information that there is without them [p x p]
  Eigen::MatrixXd asked;  ///< the c, one column each [p x asked]
};

/// M for `counts` of each point, which need not be whole.
Eigen::MatrixXd information_of(const DesignProblem& problem, const std::vector<double>& counts);

/// c' M^-1 c of every c; infinite where M is singular [asked].
Eigen::VectorXd variances_of(const DesignProblem& problem, const std::vector<double>& counts);

/// The shares of `points` points that make the sum of the variances least (a linear optimality
/// criterion; one c alone: c-optimality), by the multiplicative algorithm
///   w_i <- w_i d_i^(1/2) / sum w_j d_j^(1/2),  d_i = |C' M^-1 x_i|^2,
/// which leads down in every step where nothing else is known: Silvey, S. D., Titterington, D. M. &
/// Torsney, B. (1978), Commun. Stat. A 7, 1379-1389; Yu, Y. (2010), Ann. Stat. 38, 1593-1606. It
/// ends where no point is worth 0.2 % more than the average of those that are made.
std::vector<double> optimal_shares(const DesignProblem& problem, double points);

/// What the sum of the variances cannot be less than with as many points as `counts` has: the sum
/// is convex in them, so it lies above its tangent.
double least_possible_sum(const DesignProblem& problem, const std::vector<double>& counts);

/// `points` whole points in proportion to `shares`: the efficient rounding of Pukelsheim, F. &
/// Rieder, S. (1992), Biometrika 79, 763-770.
std::vector<int> whole_points(const std::vector<double>& shares, int points);

/// `counts` after every exchange of one point for another that lowers the sum of the variances, the
/// best first: Fedorov, V. V. (1972), Theory of Optimal Experiments, chapter 3.
std::vector<int> after_exchanges(const DesignProblem& problem, std::vector<int> counts);

}  // namespace recoil
