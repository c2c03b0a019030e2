#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/names.hpp"
#include "diagnosis/candidate_result.hpp"
#include "diagnosis/diagnosis_options.hpp"
#include "diagnosis/expected_effects.hpp"
#include "diagnosis/next_experiments.hpp"
#include "diagnosis/outlying_points.hpp"
#include "diagnosis/structure.hpp"
#include "diagnosis/unstated_errors.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/interval.hpp"

namespace recoil {

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

/// Every diameter of every dataset in four bands of equal width in ln V; empty bands are left out.
std::vector<MisfitCell> misfit_map(const FitResult& fitted);

enum class Verdict { adequate, cause_named, not_separable, unexplained };
template <>
struct NamesOf<Verdict> {
  static constexpr std::array<std::string_view, 4> names = {"adequate", "cause_named",
                                                            "not_separable", "unexplained"};
};

/// The capture velocity of one diameter under both models.
struct CaptureChange {
  std::size_t dataset = 0;
  double diameter = 0.0;                 ///< [m]
  std::optional<double> base, extended;  ///< [m/s]; none where nothing is captured
};

/// The answer for all points, where some were set aside.
struct AnswerForAll {
  Verdict verdict = Verdict::adequate;
  std::vector<std::string> named, rivals, resembles;
};

/// Exact materials would leave structure where those within their errors leave none.
struct MaterialsExplain {
  double p_value_exact = 1.0;  ///< of the structure that exact materials leave
};

/// What an adequate model would leave if laws and losses had no error (`LawErrors`).
struct IfExact {
  double p_value = 1.0;  ///< of the structure, `quick_structure`
  /// Where that is no more than the level of the diagnosis: the possible causes that fit best under
  /// exact laws, none behind the first by more than its margin.
  std::vector<std::string> listed;
};

/// How often data sets like these, in which a cause acts, are answered how (`DesignRates`).
struct Detection {
  std::string id;         ///< of the cause
  double strength = 1.0;  ///< its effect on e^2, over the effect that was found [1]
  int datasets = 0;       ///< simulated
  int named = 0;          ///< it alone is named
  int listed = 0;         ///< it is listed among others
  int wrong = 0;          ///< something else is named
};

/// What these points could have shown.
struct OwnDesign {
  std::vector<Detection> detection;  ///< of each cause that is named or listed
  int datasets = 0;                  ///< simulated with nothing but the base model
  int alarms = 0;                    ///< of these, how many are not adequate
};

/// The base model with a cause added.
struct ExtendedModel {
  CandidateResult cause;         ///< as it was found, with the weights of the base fit
  std::optional<FitResult> fit;  ///< as `fit` has it, with settled weights; else `failure`
  std::string failure;           ///< why there is no usable fit
  /// Intervals of the parameters [slots] of the base fit and of this one: the
  /// profile where standard deviations are stated, otherwise with 199
  /// replicates.
  std::vector<IntervalSet> base_intervals, intervals;
  std::vector<CaptureChange> capture;
};

/// The answers. The base model leaves nothing systematic:
struct Adequate {
  std::optional<MaterialsExplain> materials;  ///< where its constants matter
  std::optional<IfExact> if_exact;            ///< where laws are allowed an error
};

/// One explanation, of one cause or of two at once, is told from all others.
struct CauseNamed {
  ExtendedModel extended;  ///< by it
};

/// Several explanations, which these data cannot tell apart.
struct NotSeparable {
  ExtendedModel extended;           ///< by the best of them
  std::vector<std::string> rivals;  ///< causes in any of them
  std::vector<std::string> alone;   ///< where the best takes two: those that come close alone
  std::vector<std::string> common;  ///< causes in all of them
  std::string shared_cause;         ///< of which all rivals are laws; empty: none
  std::vector<NextExperiment> experiments;  ///< the least effort first
};

/// Something of this shape acts: what fits best, but cannot be true, or not be
/// told from an unknown law of size.
struct Resembles {
  std::vector<std::string> causes;
};

/// Unstated errors do as well as the best explanation, `cause`, or better.
struct ErrorsTooSmall {
  std::string cause;
};

/// Nothing in the catalogue explains the structure.
struct Unexplained {};

using DiagnosisAnswer =
    std::variant<Adequate, CauseNamed, NotSeparable, Resembles, ErrorsTooSmall, Unexplained>;

/// What `diagnose` finds.
struct Diagnosis {
  DiagnosisOptions options;
  FitSpec spec;
  std::vector<Dataset> datasets;
  FitResult base;
  DiagnosisAnswer answer;
  Structure structure;                      ///< of the base model's residuals
  std::vector<OutlyingPoint> outlying;      ///< set aside; all that follows is without them
  std::optional<AnswerForAll> for_all;      ///< with them; none where there are none
  std::vector<MisfitCell> where;            ///< the map
  std::vector<double> free_form;            ///< discrepancy as residuals [points]; empty: none
  double free_form_p = 1.0;                 ///< of the scatter that it leaves
  std::vector<CandidateResult> candidates;  ///< single mechanisms, the best first
  std::vector<CandidateResult> pairs;       ///< the best pairs of causes, when one did not suffice
  std::vector<ExpectedEffect> expected;     ///< of what the conditions state, the largest first
  std::vector<UnstatedErrors> unstated;  ///< the likelier first; empty when the model is adequate
  std::optional<OwnDesign> own_design;   ///< where it was asked for
  /// What a reader has to know about the points: for reconstructions, what their recipe put there.
  std::vector<std::string> remarks;

  Verdict verdict() const;
  std::vector<std::string> named() const;      ///< causes; empty: none is named
  std::vector<std::string> rivals() const;     ///< empty: nothing is listed
  std::vector<std::string> resembles() const;  ///< empty: no shape is recognised
  std::vector<std::string> causes() const;     ///< whichever of these there are
  const ExtendedModel* extended() const;       ///< null where there is none
  const HeldOutGain* gain() const;             ///< of its fit; null where there is none
  /// The answer, if it is this one.
  template <class One>
  const One* answer_if() const {
    return std::get_if<One>(&answer);
  }
};

/// Have all points about the same diameter, so that none shows how an effect depends on it?
bool has_one_size(const Observations& data);

/// Could the points show anything of how e varies with V and d, beside what the parameters take?
bool tests_the_curve(const Diagnosis& diagnosis);

/// Do series of one size differ, at the same velocities, in a way that nothing named explains?
bool series_differ(const Diagnosis& diagnosis);

/// Have so many simulated data sets no fit that a reader has to know (more than one in a hundred)?
bool simulations_failed(const Structure& structure);

/// The diameter and band of velocities at which the base model misses most; null where it misses
/// nowhere by two standard errors.
const MisfitCell* worst_cell(const Diagnosis& diagnosis);

/// The point that makes more than half of the misfit, if one does: index into the observations.
std::optional<std::size_t> dominant_point(const Diagnosis& diagnosis);

/// How many more points rebounded than parameters are free: with fewer than three hardly anything
/// but the model could have been seen.
struct Evidence {
  int rebounds = 0;
  int free = 0;
  bool hardly_any() const { return rebounds - free < 3; }
};
Evidence evidence_for(const Diagnosis& diagnosis);

/// The cause that takes more than four fifths of the misfit and is not named, because structure is
/// left; null where there is none.
const CandidateResult* closest_cause(const Diagnosis& diagnosis);

/// Errors that were not stated and that would do as well as the answer, or without one; beside two
/// causes at once also those that fit less well, as they need one number.
std::vector<UnstatedErrors> rival_errors(const Diagnosis& diagnosis);

}  // namespace recoil
