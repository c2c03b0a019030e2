#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/names.hpp"
#include "diagnosis/candidate_result.hpp"
#include "diagnosis/diagnosis_options.hpp"
#include "diagnosis/next_experiments.hpp"
#include "diagnosis/outlying_points.hpp"
#include "diagnosis/structure.hpp"
#include "diagnosis/unstated_errors.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/interval.hpp"

namespace recoil {

/// The misfit of the base model in one band of velocities at one diameter.
struct MisfitCell {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double slowest = 0.0;   ///< incident velocity [m/s]
  double fastest = 0.0;   ///< [m/s]
  int points = 0;
  double restitution = 0.0;   ///< mean of e - e_model [1]: positive if the model is too low
  double energy = 0.0;        ///< mean of m V^2 / 2 (e^2 - e_model^2) [J]
  double standardised = 0.0;  ///< mean of e - e_model over its standard error [1]
};

/// The cells of every diameter of every dataset in four bands of equal width in ln V, without empty
/// bands.
std::vector<MisfitCell> misfit_map(const FitResult& fitted);

enum class Verdict { adequate, cause_named, not_separable, unexplained };
constexpr auto names_of_values(Verdict) {
  return name_list("adequate", "cause_named", "not_separable", "unexplained");
}

/// The capture velocity of one diameter under both models.
struct CaptureChange {
  std::size_t dataset = 0;
  double diameter = 0.0;                 ///< [m]
  std::optional<double> base, extended;  ///< [m/s]; nullopt if no sphere is captured
};

/// An effect that theory predicts from the stated conditions of the data.
struct ExpectedEffect {
  std::string id;  ///< id of the mechanism
  std::size_t dataset = 0;
  Condition condition = Condition::ambient_pressure;
  double stated = 0.0;    ///< value of the condition, in its unit
  double diameter = 0.0;  ///< diameter of the point with the largest effect [m]
  double velocity = 0.0;  ///< incident velocity of that point [m/s]
  double change = 0.0;    ///< change of e at that point [1]
};

/// The answer for all points, if outlying points were set aside.
struct AnswerForAll {
  Verdict verdict = Verdict::adequate;
  std::vector<std::string> named, rivals, resembles;
};

/// The model is adequate within the errors of the materials, but exact materials leave structure.
struct MaterialsExplain {
  double p_value_exact = 1.0;  ///< p-value of the structure that exact materials leave
};

/// The answer if laws and losses have no error (`LawErrors`), for single causes.
struct IfExact {
  double p_value = 1.0;  ///< p-value of the structure that the base model leaves
  /// If the p-value is at most the level of the diagnosis: the cause that is named, if one is, and
  /// the possible causes that fit best, all within the margin of the first.
  std::vector<std::string> named, listed;
};

/// How often simulated data sets like these, in which a cause acts, get each answer
/// (`DesignRates`).
struct Detection {
  std::string id;         ///< id of the cause
  double strength = 1.0;  ///< its effect on e^2 over the estimated effect [1]
  int datasets = 0;       ///< number of simulated data sets
  int named = 0;          ///< number in which it alone is named
  int listed = 0;         ///< number in which it is listed among others
  int wrong = 0;          ///< number in which only another cause is named
};

/// How often a diagnosis of points like these finds a cause.
struct OwnDesign {
  std::vector<Detection> detection;  ///< for each cause that is named or listed
  int datasets = 0;                  ///< number of data sets simulated with the base model alone
  int alarms = 0;                    ///< number of these that are not adequate
};

/// The base model with a cause added.
struct ExtendedModel {
  CandidateResult cause;         ///< as the search found it, with the weights of the base fit
  std::optional<FitResult> fit;  ///< result of `fit`, with converged weights; else see `failure`
  std::string failure;           ///< reason for a missing fit
  /// Intervals of the parameters [slots] of the base fit and of this one: from the profile if
  /// standard deviations are stated, otherwise with 199 replicates.
  std::vector<IntervalSet> base_intervals, intervals;
  std::vector<CaptureChange> capture;
};

/// The answers of a diagnosis. Adequate: the base model leaves no structure, or an error of the
/// laws explains it and no possible cause does as well.
struct Adequate {
  std::optional<MaterialsExplain> materials;  ///< if the errors of the constants matter
};

/// One explanation, a cause or a pair of causes, is distinguished from all others.
struct CauseNamed {
  ExtendedModel extended;  ///< the base model with it
};

/// Several explanations that these data cannot distinguish.
struct NotSeparable {
  ExtendedModel extended;           ///< the base model with the best of them
  std::vector<std::string> rivals;  ///< the causes in any of them
  std::vector<std::string> alone;   ///< if the best is a pair: single causes that are close
  std::vector<std::string> common;  ///< the causes in all of them
  std::string shared_cause;         ///< the cause of which all rivals are laws; empty: none
  bool law_error = false;           ///< an error of the laws explains as much as any of them
};

/// The residuals have the shape of these causes, which fit best but are implausible, or cannot be
/// distinguished from an unknown law of size.
struct Resembles {
  std::vector<std::string> causes;
};

/// Unstated errors explain the data as well as the best explanation, `cause`, or better.
struct ErrorsTooSmall {
  std::string cause;
};

/// Nothing in the catalogue explains the structure.
struct Unexplained {};

using DiagnosisAnswer =
    std::variant<Adequate, CauseNamed, NotSeparable, Resembles, ErrorsTooSmall, Unexplained>;

/// The result of `diagnose`: its inputs, its answer, and one member for each section of the page.
struct Diagnosis {
  DiagnosisOptions options;
  FitSpec spec;
  std::vector<Dataset> datasets;
  FitResult base;
  /// The fit of all points as stated, on which `judge_model` gives the verdict; null for the answer
  /// alone.
  std::shared_ptr<const FitResult> fitted;
  DiagnosisAnswer answer;
  /// The answer with exact laws; nullopt if a cause is named without them, or for the answer alone.
  std::optional<IfExact> if_exact;
  /// Experiments that distinguish the rivals. If no cause is named or listed but exact laws would
  /// leave structure: the causes that exact laws list, and the base model with an error of its
  /// laws.
  NextExperiments next;
  Structure structure;  ///< structure of the base model's residuals
  /// Points that were set aside; the other members are without them.
  std::vector<OutlyingPoint> outlying;
  std::optional<AnswerForAll> for_all;  ///< the answer with them; nullopt if there are none
  std::vector<MisfitCell> where;        ///< the misfit map
  std::vector<double> free_form;  ///< free-form discrepancy as residuals [points]; empty: none
  double free_form_p = 1.0;       ///< p-value of the scatter that it leaves
  std::vector<CandidateResult> candidates;  ///< single mechanisms, the best first
  std::vector<CandidateResult> pairs;       ///< the best pairs of causes, if no single one explains
  std::vector<ExpectedEffect> expected;     ///< effects of the stated conditions, the largest first
  std::vector<UnstatedErrors> unstated;     ///< the likeliest first; empty if the model is adequate
  std::optional<OwnDesign> own_design;      ///< if requested
  /// Remarks about the points; for reconstructed data, the effects that their recipe contains.
  std::vector<std::string> remarks;

  Verdict verdict() const;
  std::vector<std::string> named() const;      ///< the named causes; empty: none
  std::vector<std::string> rivals() const;     ///< the listed causes; empty: none
  std::vector<std::string> resembles() const;  ///< the causes with a similar shape; empty: none
  std::vector<std::string> causes() const;     ///< those of the answer: named, rivals or resembling
  const ExtendedModel* extended() const;       ///< null if there is none
  const HeldOutGain* gain() const;             ///< held-out gain of its fit; null if there is none
  /// The answer if it is of type One, else null.
  template <class One>
  const One* answer_if() const {
    return std::get_if<One>(&answer);
  }
};

/// Do all points have about the same diameter, so that the size dependence of an effect is unknown?
/// @pre there is a point
bool has_one_size(const Observations& data);

/// Can the points test how e varies with V and d, beyond what the parameters fit?
bool tests_the_curve(const Diagnosis& diagnosis);

/// Do series of one size differ at the same velocities in a way that no named cause explains?
bool series_differ(const Diagnosis& diagnosis);
/// Do points of one size at nearly one velocity scatter more than they state, without a named
/// cause?
bool repeats_scatter(const Diagnosis& diagnosis);

/// Did the fits of more than 1 % of the simulated data sets fail, so that a reader must know?
bool simulations_failed(const Structure& structure);

/// The cell with the largest misfit of the base model; null if none exceeds two standard errors.
const MisfitCell* worst_cell(const Diagnosis& diagnosis);

/// The point that contributes more than half of the misfit, as an index into the observations;
/// nullopt without one.
std::optional<std::size_t> dominant_point(const Diagnosis& diagnosis);

/// The number of rebounds compared with the free parameters: with fewer than three more, the points
/// can hardly contradict the model.
struct Evidence {
  int rebounds = 0;
  int free = 0;
  bool hardly_any() const { return rebounds - free < 3; }
};
Evidence evidence_for(const Diagnosis& diagnosis);

/// The cause that explains more than 80 % of the misfit but is not named because structure is left;
/// null without one.
const CandidateResult* closest_cause(const Diagnosis& diagnosis);

/// The cause, or else the pair, that leaves no structure and is not named all the same: see its
/// `set_aside`, or a cause that is not possible fits better. Null without one.
const CandidateResult* doubtful_cause(const Diagnosis& diagnosis);

/// Unstated errors that explain the data as well as the answer, or without an answer. Next to a
/// pair of causes also those that fit less well, as they need only one number.
std::vector<UnstatedErrors> rival_errors(const Diagnosis& diagnosis);

}  // namespace recoil
