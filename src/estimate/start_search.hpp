#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/observations.hpp"

namespace recoil {

/// How one of several starts ended.
enum class StartOutcome {
  best,           ///< reached the smallest chi2
  same,           ///< reached the chi2 and the parameters of the best
  tie,            ///< reached its chi2 at other parameters, see StartSummary::differing
  worse,          ///< ended in a worse local minimum
  flat,           ///< ended where the points do not depend on a parameter
  not_converged,  ///< failed
};

/// The end of one of several starts.
struct StartSummary {
  std::vector<double> start;
  std::vector<double> end;
  double chi2 = 0.0;
  DescentEnd ending = DescentEnd::no_answer;
  std::string message;  ///< message of the minimiser
  StartOutcome outcome = StartOutcome::not_converged;
  std::vector<std::size_t> differing = {};  ///< for a tie: the slots whose values differ

  bool converged() const { return ending == DescentEnd::minimum || ending == DescentEnd::valley; }
};

/// The end of a start from which the fit to all points continues.
struct StartLead {
  std::size_t start = 0;  ///< index of the start
  LeastSquaresResult run;
};

/// Result of the descents from several starts.
struct StartSearch {
  std::vector<StartSummary> starts;
  std::size_t points = 0;  ///< number of points used
  bool sampled = false;    ///< true: a subset of more than 500
  /// The best run first. If the points are a subset, also every run that ended at other parameters
  /// with a sum of squares that the subset cannot distinguish from the smallest. Empty if no
  /// descent ended.
  std::vector<StartLead> leads;
  long handovers = 0;  ///< impacts that the fast solver handed to the reference
};

/// Descends from `first` and, with `several`, from other dampings and from the starts that the
/// catalogue of mechanisms lists.
StartSearch search_from_starts(const ImpactModel& model, const Observations& data,
                               const std::vector<double>& first, bool several,
                               LeastSquaresOptions options);

/// Sets `outcome` and `differing` of every start. Values of chi2 are the same within 0.1 %, values
/// of a parameter within a tenth of its standard error, or within 0.1 % if it has none.
/// @param best index of the start that the fit continued
/// @param std_error standard errors of the fit, or 0 [slots]
void compare_starts(std::vector<StartSummary>& starts, std::size_t best,
                    const std::vector<double>& std_error);

}  // namespace recoil
