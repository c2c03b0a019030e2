#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "data/system.hpp"
#include "diagnosis/candidate_result.hpp"

namespace recoil {

struct SearchBase;

enum class ExperimentKind {
  points,    ///< more impacts, at another velocity and diameter
  condition  ///< more impacts under a changed condition, which removes one of the two causes
};
constexpr auto names_of_values(ExperimentKind) { return name_list("points", "condition"); }

/// An experiment that distinguishes two rivals.
struct NextExperiment {
  ExperimentKind kind = ExperimentKind::points;
  std::string one, other;  ///< names of the two candidates
  std::size_t dataset = 0;
  std::size_t series = 0;  ///< the series of that dataset with the most similar impacts
  double diameter = 0.0;   ///< [m]
  double velocity = 0.0;   ///< incident velocity [m/s]
  /// e predicted by `one` minus e predicted by `other` [1]. For kind `condition`, the change
  /// removes the mechanism of `one`.
  double difference = 0.0;
  int events = 0;  ///< number of impacts for expected odds of 99 to 1
  /// Expected ln odds for the right one from that many impacts, averaged over which one it is.
  double log_odds = 0.0;
  double worst_log_odds = 0.0;  ///< the same for the less favourable of the two
  /// For kind `condition`: the changed condition.
  Condition condition = Condition::ambient_pressure;
  double value = 0.0;      ///< value of the condition, in its unit
  std::string_view doing;  ///< instruction: "pump the chamber"

  /// Does it take so many impacts that a reader must be warned?
  bool expensive() const { return events > 2000; }
};

/// Two rivals that no experiment in reach distinguishes.
struct Inseparable {
  std::string one, other;   ///< names of the two candidates
  double difference = 0.0;  ///< largest |e of one - e of the other| of a possible impact [1]
};

struct NextExperiments {
  std::vector<NextExperiment> list;  ///< the best first
  std::vector<Inseparable> inseparable;
};

/// The name of the base model, whose laws err, among the rivals of an experiment.
inline constexpr std::string_view law_error_as_rival = "law_error";

/// For every two of the first four `rivals`: the impact conditions that distinguish them with the
/// fewest impacts. If the catalogue has a condition that removes a mechanism of only one of the
/// two, also the best impact under that condition. A rival without an added mechanism is the base
/// model with an error of its laws. Experiments of more than a million impacts are omitted.
///
/// The first is the one with the least effort for the probability that one of its two rivals acts.
/// The effort is the number of impacts, plus 100 for a changed condition; the probability of a
/// rival is proportional to exp(-`delta_aicc` / 2).
///
/// The impacts to choose from are 24 velocities from 0.7 times the slowest to 1.5 times the fastest
/// measured at which spheres rebound under one of the two, for every diameter of the data and for
/// the commercial sphere sizes nearest to 0.6 times the smallest and 1.6 times the largest
/// diameter.
///
/// Each rival predicts the mean e of n impacts as a normal variable. Its variance has three parts:
/// the scatter of one impact over n, the errors of the fitted parameters, and the errors of the
/// laws (`LawErrors`). If a rival is right, the expected log odds for it are the Kullback-Leibler
/// divergence of the two normal distributions (Box & Hill 1967, Technometrics 9, 57-71); they stay
/// finite as n grows. The smaller of both must be ln 99.
///
/// The parameters and the errors of the laws are normal: with A the weighted slopes of the measured
/// points in both and r the weighted residuals, their mean is -(A'A + I')^-1 A'r and their
/// covariance (A'A + I')^-1, where I' is 1 for each error of a law and 0 for each parameter. The
/// mean and the variance of e are those of 32 draws of them (16 and their mirror images), because e
/// falls steeply to a capture: there a rival predicts nothing certain.
NextExperiments next_experiments(const SearchBase& base,
                                 const std::vector<const CandidateResult*>& rivals);

/// Standard deviation of e of one impact [1]: that of the nearest point of the dataset in ln V, at
/// least 0.001.
double scatter_of_one_event(const FitResult& base, std::size_t dataset, double velocity);

}  // namespace recoil
