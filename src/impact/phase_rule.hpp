#pragma once

#include <cstddef>
#include <vector>

namespace recoil {

/// Gauss nodes s_i on [0, 1], with matrices that act on values at the nodes: they integrate the
/// interpolating polynomial up to each node and up to 1, and give its two highest Legendre
/// coefficients.
struct GaussRule {
  using Row = std::vector<double>;
  using Series = std::vector<double>;  ///< coefficients of Legendre polynomials

  explicit GaussRule(std::size_t nodes);

  std::size_t count;
  Row node;
  Row weight;                ///< sum_j weight[j] f(s_j) = integral from 0 to 1
  std::vector<Row> up_to;    ///< sum_j up_to[i][j] f(s_j) = integral from 0 to s_i
  Row last, last_but_one;    ///< rows that give the coefficients of P_(count - 1) and P_(count - 2)
  std::vector<Row> of_node;  ///< [node][k]: P_k at the node

  /// sum_j row[j] f(s_j) = integral from 0 to s.
  Row integral_up_to(double s) const;

  /// Cardinal functions for an f that is a polynomial times s, or with `at_both_ends` times
  /// s (1 - s): function j is 1 at node j and 0 at the other nodes. The error of the integral of f
  /// then vanishes like s^2, so that the integral divided by s^2 is accurate at the first nodes.
  std::vector<Series> vanishing(bool at_both_ends) const;

  /// The same for an f that is a sum of the functions of `vanishing`.
  Row integral_up_to(double s, const std::vector<Series>& vanishing) const;
};

/// The nodes of a phase: part[i] is the fraction of the distance in q from the inner turning point
/// to the other end at node i, and rate[i] its derivative in s. u vanishes like the square root of
/// this distance. The fraction is s^2 (1 + c (1 - s^2)), or sin^2(pi s / 2) if the other end is a
/// turning point, too, so that u is smooth in s.
///
/// The members are plain arrays, because the kernels of fast_kernel.cpp must not share inline
/// functions.
struct PhaseRule {
  static constexpr std::size_t most = 24;  ///< nodes
  static constexpr std::size_t few = 8;    ///< nodes of the coarse rule

  std::size_t count = 0;
  double part[most] = {}, rate[most] = {};
  double weight[most] = {}, last[most] = {}, last_but_one[most] = {};  ///< as in GaussRule
  double up_to[most][most] = {};
  /// sum_j losses[i][j] f(s_j) = integral up to node i of an f that vanishes where u does.
  double losses[most][most] = {};
  /// The same from values at the nodes of the rule with `few` of them.
  double from_few[most][few] = {};

  PhaseRule(std::size_t nodes, bool both_ends_turn);
};

/// The rules that the fast solver uses.
struct PhaseRules {
  PhaseRule coarse{PhaseRule::few, false};
  PhaseRule coarse_capture{PhaseRule::few, true};
  PhaseRule smooth{16, false};
  PhaseRule fine{PhaseRule::most, false};
  PhaseRule fine_capture{PhaseRule::most, true};
};
const PhaseRules& phase_rules();

}  // namespace recoil
