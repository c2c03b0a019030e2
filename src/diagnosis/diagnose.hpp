#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/candidate.hpp"
#include "diagnosis/held_out.hpp"
#include "diagnosis/structure.hpp"
#include "uncertainty/uncertainty_result.hpp"

namespace recoil {

struct DiagnosisOptions {
  int simulated = 999;  ///< data sets of the base model that calibrate the tests of the residuals
  int compared = 39;    ///< of these, how many are fitted with every candidate
  /// A correct model is accused in this part of all data, if the stated deviations are right. 5 %
  /// are promised: the rest is room for what they do not cover, such as velocities that a table
  /// rounds to three digits where e is steep, close to capture.
  double level = 0.02;
  double chance = 0.05;  ///< what a cause gains, chance gives in no more than this part
  /// Two causes whose criteria differ by less cannot be told apart. For a false rival R and the
  /// truth T, with delta^2 the misfit that R would leave, the difference of their deviances is
  /// about normal with mean delta^2 and standard deviation 2 delta, so that R leads by c with a
  /// probability of at most Phi(-sqrt(c)), attained at delta^2 = c: 2.3 % at 4, for rivals of as
  /// many parameters. From a difference of 4 on, a model has "considerably less support" (Burnham &
  /// Anderson 2002, Model Selection and Multimodel Inference, section 2.6).
  double apart = 4.0;
  double apart_in_pairs = 6.0;  ///< the same for two at once, where more rivals crowd: 0.7 % each
  std::uint64_t seed = 20260101;
  int threads = 0;  ///< 0: all cores. No digit depends on it.
};

/// Where the fitted base model misses: one diameter, one band of velocities.
struct MisfitCell {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double slowest = 0.0;   ///< incident velocity [m/s]
  double fastest = 0.0;   ///< [m/s]
  int points = 0;
  double restitution = 0.0;   ///< mean of e - e_model [1]: positive where the model is too low
  double energy = 0.0;        ///< mean of m V^2 / 2 (e^2 - e_model^2) [J]
  double standardised = 0.0;  ///< mean of e - e_model over its standard error [1]
};

/// A parameter of an added mechanism as it was fitted.
struct FoundParameter {
  std::string label;
  std::string unit;
  double value = 0.0;
  double null_value = 0.0;
  bool plausible = true;
  bool nearly = true;  ///< plausible, or no further outside than half the range, or a factor of two
  std::string why_not;  ///< when it is not plausible
};

inline constexpr double tolerated_level = 0.01;  ///< structure below this p-value is left behind

/// One mechanism, or several at once, tried as an explanation.
struct CandidateResult {
  Candidate candidate;
  Refit refit;
  MechanismKind kind = MechanismKind::physics;
  std::vector<FoundParameter> parameters;
  double delta_aicc = 0.0;        ///< criterion less that of the base model: negative is better
  std::optional<double> p_value;  ///< see `diagnose`; none for several at once
  double remaining_p = 0.0;       ///< of the structure that it leaves, `quick_structure`
  /// Of the base model's misfit beyond the noise, what is left [1]; 1 where no errors are stated.
  double remaining_part = 1.0;
  std::optional<HeldOutGain> gain;  ///< where worth computing
  bool plausible = true;
  bool nearly = true;  ///< see `FoundParameter`; limits of what is possible are no sharper
  std::string aside;   ///< why it is not taken for a cause; empty otherwise

  bool explains() const { return aside.empty(); }
};

/// Errors of the measurement beyond the stated ones that might do in place of a cause.
struct UnstatedErrors {
  std::string id;           ///< "velocity_errors" or "larger_deviations"
  double value = 0.0;       ///< relative sd of every velocity [1], or factor on every deviation [1]
  double delta_aicc = 0.0;  ///< criterion less that of the base model as stated
  double remaining_p = 0.0;  ///< of what is systematic, or of heavy tails, under them

  bool leave_nothing() const { return delta_aicc < 0.0 && remaining_p >= tolerated_level; }
};

enum class Verdict { adequate, cause_named, not_separable, unexplained };
std::string to_string(Verdict verdict);

/// A measurement that would tell two rivals apart.
struct NextMeasurement {
  std::size_t dataset = 0;
  double velocity = 0.0;  ///< [m/s]
  double diameter = 0.0;  ///< [m]
  std::string one, other;
  double difference = 0.0;    ///< of the two predictions of e [1]
  double event_sd = 0.0;      ///< of one impact's e there [1]
  std::optional<int> events;  ///< that tell them apart at three standard errors; none: 10^6
                              ///< would not do
};

/// The capture velocity of one diameter under both models.
struct CaptureChange {
  std::size_t dataset = 0;
  double diameter = 0.0;                 ///< [m]
  std::optional<double> base, extended;  ///< [m/s]; none where nothing is captured
};

struct Diagnosis {
  DiagnosisOptions options;
  FitSpec spec;
  std::vector<Dataset> datasets;
  FitResult base;
  Verdict verdict = Verdict::adequate;
  std::string text;                         ///< the answer in words
  Structure structure;                      ///< of the base model's residuals
  std::vector<MisfitCell> where;            ///< the map
  std::vector<double> free_form;            ///< discrepancy as residuals [points]; empty: none
  double free_form_p = 1.0;                 ///< of the scatter that it leaves
  std::vector<CandidateResult> candidates;  ///< single mechanisms, the best first
  std::vector<CandidateResult> pairs;       ///< the best pairs, when one did not suffice
  std::vector<std::string> named;
  std::vector<std::string> rivals;
  std::vector<std::string> common;          ///< of the rivals, those that every explanation has
  std::string shared_cause;                 ///< of which all rivals are laws; empty: none
  std::optional<CandidateResult> extended;  ///< the model of `extended.toml`
  std::optional<FitResult> extended_fit;
  /// Intervals of the parameters [slots] of the base fit and of the extended one: the profile
  /// where standard deviations are stated, otherwise with 199 replicates.
  std::vector<IntervalSet> base_intervals, extended_intervals;
  std::optional<HeldOutGain> gain;
  std::vector<CaptureChange> capture;
  std::vector<NextMeasurement> next;
  std::vector<UnstatedErrors> unstated;  ///< the likelier first; empty when the model is adequate
  std::string outdone;  ///< the best explanation, where unstated errors do better; else empty
  std::vector<std::string> warnings;
  /// What a reader has to know about the points: for reconstructions, what their recipe put there.
  std::vector<std::string> remarks;
};

/// What the fitted model of `spec` gets wrong, and why.
///
/// 1. The residuals are tested for structure (`StructureStatistics`); the p-value comes from data
///    sets simulated by the fitted model and refitted.
/// 2. Unless the model is adequate, every mechanism of the catalogue is added and the whole model
///    refitted, with the weights of the base fit. The p-value of a candidate is the part of data
///    sets simulated by the base model in which the best of all candidates gains as much.
/// 3. A candidate explains the data when that p-value is no more than `chance`, it leaves no
///    structure (or none to speak of beside what it took), its parameters are possible, and it
///    predicts blocks that were held out better than the base does. A description never explains.
/// 4. What is possible and fits no worse than the best explanation, but for `apart`, is its rival,
///    also where its parameters lie somewhat beyond the range of what is plausible, as such limits
///    are not sharp. One explanation alone is named; several are not
///    separable; none sends the search to pairs, unless even the best single one gains no more than
///    chance gives, as chance gives more to the best of so many pairs; if they fail too the
///    structure is unexplained. One diameter names nothing: the size dependence, which tells causes
///    apart, was not seen.
/// 5. Where errors that were not stated (`unstated_errors`) leave nothing and fit better than the
///    best single explanation by more than `apart`, or about as well as the best of the pairs, no
///    cause is told; where they would do as well, the text says so.
/// @throws ComputationError when the base model has no usable fit.
Diagnosis diagnose(const FitSpec& spec, const std::vector<Dataset>& datasets,
                   const DiagnosisOptions& options);

}  // namespace recoil
