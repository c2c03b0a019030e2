#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/json_result.hpp"
#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/model_verdict.hpp"
#include "estimate/two_point.hpp"
#include "impact/impact.hpp"
#include "predict/validity.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/identifiability.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/two_point_comparison.hpp"

namespace recoil {

/// Lower and upper end.
using Ends = std::array<double, 2>;

using Strings = std::vector<std::string>;

/// Parts of schemas.
inline constexpr std::string_view sha256_schema = R"({"pattern": "^[0-9a-f]{64}$"})";
inline constexpr std::string_view at_least_one = R"({"minimum": 1})";
inline constexpr std::string_view rebound_or_captured = R"({"enum": ["rebound", "captured"]})";
inline constexpr std::string_view largest_or_least = R"({"enum": ["largest", "least"]})";
inline constexpr std::string_view number_or_auto =
    R"({"anyOf": [{"type": "integer", "minimum": 0}, {"const": "auto"}]})";

/// The descriptions of members that several results have.
inline constexpr std::string_view about_format_version =
    "version of the format; it increases when a key is removed or changes its meaning, not when "
    "one is added";
inline constexpr std::string_view about_recoil_version = "version of the program";
inline constexpr std::string_view about_restitution_summary =
    "mean e of every series and diameter; then, if settings have several points, of every setting";
inline constexpr std::string_view about_velocity_dependence =
    "without adhesion: change of e per decade of V, the same in all series, by weighted least "
    "squares; null if only one velocity or no error is known";
inline constexpr std::string_view about_series_differ =
    "without adhesion: test whether series of one size differ at equal V (analysis of covariance)";
inline constexpr std::string_view about_restitution_range =
    "every size of every dataset: e at the slowest and at the fastest setting with a rebound";

inline constexpr std::string_view about_friction =
    "Coulomb friction between spheres and surface, of every dataset with tangential_restitution";

// One member per line.
// clang-format off

/// A dataset of a result.
struct DatasetEntry { RECOIL_RESULT(
    (std::string, id, "name of the dataset"),
    (std::string, title, "its title"),
    (Provenance, provenance, "origin of the data"),
    (std::string, provenance_sentence, "the meaning of the provenance"),
    (std::size_t, points, "number of points"),
    (std::string, sha256, "SHA-256 of datapackage.json and the points", "", sha256_schema),
    (Strings, sources, "where the data come from")) };

/// The dataset of a simulated impact or of a mixture.
struct DatasetReference { RECOIL_RESULT(
    (std::string, id, "name of the dataset"),
    (Provenance, provenance, "origin of the data"),
    (std::string, provenance_sentence, "the meaning of the provenance"),
    (std::string, sha256, "SHA-256 of datapackage.json and the points", "", sha256_schema)) };

/// One check of the validity of the model, at the worst point of a dataset.
struct ValidityEntry { RECOIL_RESULT(
    (ValidityQuantity, quantity, "what is compared with its limit"),
    (OrNull<double>, value, "value at the worst point", "1"),
    (double, limit, "the largest or the least value at which the model holds", "1"),
    (std::string, limit_is, "whether the limit is the largest or the least valid value", "",
     largest_or_least),
    (bool, exceeded, "true: the value is beyond the limit, and the model does not hold there"),
    (std::string, dataset, "dataset of that point"),
    (double, diameter_um, "diameter of that point", "um"),
    (double, incident_velocity, "incident velocity of that point", "m/s"),
    (std::string, text, "the check in words")) };

/// A mean of e over a series of one diameter, or over one setting of it.
struct RestitutionMeanEntry { RECOIL_RESULT(
    (std::string, dataset, "dataset"),
    (std::string, series, "series"),
    (OrNull<std::string>, setting, "setting; null for the whole series"),
    (double, diameter_um, "diameter", "um"),
    (OrNull<double>, incident_velocity, "mean V of a setting; null for the whole series", "m/s"),
    (double, value, "mean e", "1"),
    (OrReason<Ends>, interval, "95 % interval, from the scatter or from the stated errors, "
     "whichever is wider", "1"),
    (int, points, "number of points", "", at_least_one),
    (int, launches, "number of launches of these points; 0: none is stated")) };

/// The slope b of e = a_series + b log10 V.
struct VelocityDependenceEntry { RECOIL_RESULT(
    (OrReason<double>, slope, "slope", "1/decade"),
    (OrNull<Ends>, interval, "95 % interval of the slope", "1/decade"),
    (OrNull<double>, p_value, "p-value of no slope", "1"),
    (std::size_t, without_error, "points that state no error while others do; each counts with the "
     "median of the others")) };

/// e at the ends of the velocities of one size.
struct RestitutionRangeEntry {
  struct End { RECOIL_RESULT(
      (double, incident_velocity, "mean V of the setting", "m/s"),
      (double, restitution, "mean e of its rebounds", "1")) };
  RECOIL_RESULT(
    (std::string, dataset, "dataset"),
    (double, diameter_um, "diameter", "um"),
    (End, slowest, "the slowest setting"),
    (End, fastest, "the fastest setting")) };

/// The coefficient of friction of one dataset.
struct FrictionEntry { RECOIL_RESULT(
    (std::string, dataset, "dataset"),
    (OrReason<double>, mu, "coefficient of friction, from e_t = 1 - mu (1 + e) V_n / V_t of spheres "
     "that slide, and 5/7 of those that roll", "1"),
    (OrReason<Ends>, interval, "95 % interval, from the scatter by Student's t", "1"),
    (OrNull<double>, lower_limit, "the smallest mu that agrees with the points, where all of them "
     "may roll and no more is known", "1"),
    (std::size_t, points, "points with e and a tangential restitution"),
    (std::size_t, sliding, "those that slide to the end at the best mu; the others roll")) };

/// The test for differences between series, and the largest difference.
struct SeriesDifferEntry {
  using Pair = std::array<std::string, 2>;
  RECOIL_RESULT(
    (OrReason<double>, p_value, "p-value of no difference", "1"),
    (OrNull<Pair>, most_different, "the two series that differ most"),
    (OrNull<double>, difference, "difference of their e", "1"),
    (OrNull<Ends>, interval, "95 % interval of this difference", "1")) };

/// How wrong the laws are, if the fit was averaged over their error.
struct LawErrorFound { RECOIL_RESULT(
    (bool, seen, "whether the points show an error: it makes them at least 20 times as probable"),
    (double, probability_of_exact_laws, "posterior probability of exact laws", "1"),
    (double, median, "median of the error if the laws are not exact, relative to the loss", "1"),
    (double, lower, "lower end of its interval", "1"),
    (double, upper, "upper end of its interval", "1")) };

/// A law of loss of the dry contact, compared with the others.
struct LossLawEntry { RECOIL_RESULT(
    (std::string, id, "the law"),
    (OrNull<double>, delta_aicc, "its AICc minus that of the best law", "1")) };

/// The interval to quote.
template <class Kind>
struct RecommendedEntry { RECOIL_RESULT(
    (OrNull<Kind>, interval, "the interval to quote"),
    (std::string, why, "the rule that selects it, or why there is none")) };

/// `fit.json`: the result of one fit. SI units unless the name of a member says otherwise.
struct FitFile {
  struct Source { RECOIL_RESULT(
      (std::string, id, "name of the fit file without ending"),
      (std::string, sha256, "SHA-256 of the fit file", "", sha256_schema)) };

  struct ParameterOptions {
    using Bounds = std::array<OrNull<double>, 2>;
    RECOIL_RESULT(
      (OrNull<double>, initial, "value at which the fit starts", "its unit"),
      (bool, free, "whether it is fitted"),
      (Bounds, bounds, "lower and upper bound; null: none", "its unit")) };

  /// The options in use, from the fit file, the command line and the defaults.
  struct Options { RECOIL_RESULT(
      (AdhesionLaw, adhesion, "law of adhesion"),
      (AdhesionDampingPhase, adhesion_damping_phase, "phase in which the adhesion damping acts"),
      (std::string, loss, "loss of the dry contact"),
      (Strings, mechanisms, "ids of the mechanisms"),
      (bool, mixed_sizes, "whether points average over sizes that a dataset states"),
      (Json, replicates, "bootstrap replicates", "", number_or_auto),
      (Scheme, scheme, "requested bootstrap scheme"),
      (double, level, "level of the intervals", "1"),
      (std::uint64_t, seed, "seed of all random numbers"),
      (bool, materials, "whether the errors of the constants widen the intervals"),
      (bool, materials_adjusted, "whether the points move the constants (`adjust`)"),
      (Named<ParameterOptions>, parameters, "options of every parameter")) };

  /// The contact properties that follow from the materials of one dataset.
  struct Contact { RECOIL_RESULT(
      (std::string, dataset, "dataset"),
      (OrNull<double>, stiffness_K_Pa, "stiffness K in use", "Pa"),
      (OrNull<double>, stiffness_K_derived_Pa, "K of the elastic constants", "Pa"),
      (OrNull<double>, adhesion_energy_J_per_m2, "work of adhesion in use", "J/m2"),
      (OrNull<double>, f0_N_per_m, "f0 at the reference diameter", "N/m"),
      (OrNull<double>, W_of_f0_J_per_m2, "work of adhesion that belongs to f0 (eqs 9, 10)", "J/m2"),
      (OrNull<double>, f0_eq12_N_per_m, "f0 of the work of adhesion (eq. 12)", "N/m"),
      (OrNull<double>, reference_diameter_um, "diameter to which f0 belongs", "um"),
      (OrNull<double>, particle_density_kg_per_m3, "density of the particle", "kg/m3"),
      (OrNull<double>, adhesion_velocity_m_per_s, "velocity scale of the adhesion", "m/s"),
      (Strings, contradictions, "inputs that contradict each other, and which was used")) };

  struct Model { RECOIL_RESULT(
      (std::string, equation, "equation of motion"),
      (AdhesionLaw, adhesion, "law of adhesion"),
      (AdhesionDampingPhase, adhesion_damping_phase, "phase in which the adhesion damping acts"),
      (std::vector<Contact>, contacts, "values that follow from the materials of each dataset"),
      (OrAbsent<double>, separation_m, "z0 of Maugis' law", "m")) };

  using Recommended = RecommendedEntry<IntervalKind>;

  struct Intervals { RECOIL_RESULT(
      (OrNull<Ends>, wald, "Wald interval", "its unit"),
      (OrNull<Ends>, profile, "profile-likelihood interval", "its unit"),
      (OrNull<Ends>, percentile, "bootstrap percentile interval", "its unit"),
      (OrNull<Ends>, bca, "BCa bootstrap interval", "its unit"),
      (OrNull<Ends>, studentized, "studentized bootstrap interval", "its unit"),
      (Named<std::string>, why, "reasons for the intervals that are null, by kind"),
      (Recommended, recommended, "as `recommended` of the parameter"),
      (OrNull<Ends>, posterior, "posterior interval", "its unit")) };

  struct IntervalErrors { RECOIL_RESULT(
      (OrNull<Ends>, wald, "of the Wald interval", "its unit"),
      (OrNull<Ends>, profile, "of the profile-likelihood interval", "its unit"),
      (OrNull<Ends>, percentile, "of the percentile interval", "its unit"),
      (OrNull<Ends>, bca, "of the BCa interval", "its unit"),
      (OrNull<Ends>, studentized, "of the studentized interval", "its unit")) };

  struct BcaConstants { RECOIL_RESULT(
      (OrNull<double>, bias, "bias correction z0", "1"),
      (OrNull<double>, acceleration, "acceleration a", "1")) };

  /// One source of a standard error.
  struct BudgetRow { RECOIL_RESULT(
      (std::string, source, "scatter, spread, numerics, an error of the data (`velocity`, ...), or "
       "a constant"),
      (OrNull<double>, sd, "standard error from this source alone", "its unit"),
      (OrNull<double>, share, "share of the variance", "1"),
      (OrAbsent<Ends>, move, "change if this constant is one sd lower and one sd higher",
       "its unit")) };

  struct ExactIntervals { RECOIL_RESULT(
      (OrNull<Ends>, wald, "Wald interval", "its unit"),
      (OrNull<Ends>, profile, "profile-likelihood interval", "its unit")) };

  struct MaterialsExact { RECOIL_RESULT(
      (OrNull<double>, value, "estimate", "its unit"),
      (OrNull<double>, std_error, "standard error", "its unit"),
      (ExactIntervals, intervals, "intervals")) };

  /// What fits best with exact laws: an impact that is simulated has no error of the laws.
  struct LawsExact { RECOIL_RESULT(
      (OrNull<double>, value, "estimate", "its unit"),
      (OrNull<double>, std_error, "standard error", "its unit")) };

  struct Parameter { RECOIL_RESULT(
      (OrReason<double>, value, "estimate, or the fixed value", "its unit"),
      (std::string, unit, "unit of the parameter"),
      (bool, free, "whether it was fitted"),
      (bool, at_bound, "whether the estimate rests on a bound"),
      (OrReason<double>, std_error, "standard error", "its unit"),
      (Intervals, intervals, "intervals by kind, [lower, upper]"),
      (Recommended, recommended, "which interval to quote"),
      (OrNull<ProfileShape>, profile_shape, "shape of the profile likelihood"),
      (IntervalErrors, intervals_mc_error, "Monte-Carlo error of both ends"),
      (Named<std::string>, intervals_note, "notes by kind, such as an end at a bound"),
      (OrNull<std::string>, intervals_differ, "why the kinds differ"),
      (OrNull<BcaConstants>, bca_constants, "constants of the BCa interval"),
      (OrNull<double>, bound_share, "share of the replicates that rest on a bound", "1"),
      (OrAbsent<std::vector<BudgetRow>>, budget, "contributions to the standard error"),
      (OrAbsent<bool>, budget_linear, "whether the moves of the budget agree with linear "
       "propagation"),
      (OrAbsent<OrNull<double>>, budget_sd_without_first_constant, "the error that would remain if "
       "the constant with the largest share were exact", "its unit"),
      (OrAbsent<MaterialsExact>, materials_exact, "the fit with exact constants"),
      (OrAbsent<LawsExact>, laws_exact, "the fit with exact laws; simulate, plan and export take "
       "it")) };

  /// A material constant with a stated error.
  struct Constant { RECOIL_RESULT(
      (OrNull<double>, value, "fitted value", "its unit"),
      (std::string, unit, "unit of the constant"),
      (std::string, meaning, "what it is"),
      (OrNull<double>, std_error, "standard error of the fitted value", "its unit"),
      (OrNull<double>, stated, "stated value", "its unit"),
      (OrNull<double>, stated_sd, "stated standard deviation; of the logarithm if lognormal",
       "its unit or 1"),
      (std::string, distribution, "distribution of the stated error", "",
       R"({"enum": ["normal", "lognormal"]})"),
      (OrNull<double>, moved_sd, "fitted minus stated value, in standard deviations", "1"),
      (Strings, datasets, "datasets that have this constant"),
      (OrAbsent<LawsExact>, laws_exact, "the fit with exact laws; simulate, plan and export take "
       "it")) };

  using Matrix = Named<Named<OrNull<double>>>;

  struct CaptureIntervals { RECOIL_RESULT(
      (OrNull<Ends>, delta, "interval by the delta method", "m/s"),
      (OrNull<Ends>, percentile, "bootstrap percentile interval", "m/s"),
      (OrNull<Ends>, studentized, "studentized bootstrap interval", "m/s"),
      (OrAbsent<OrNull<Ends>>, posterior, "posterior interval", "m/s")) };

  struct CaptureVelocity { RECOIL_RESULT(
      (std::string, dataset, "dataset"),
      (OrNull<double>, diameter_um, "diameter", "um"),
      (std::string, unit, "unit of the values", "", R"({"const": "m/s"})"),
      (OrReason<double>, value, "capture velocity V*: slower spheres stay. Null without adhesion "
       "and if all points record only that all or none of their impacts were captured", "m/s"),
      (OrNull<double>, lower_limit, "the fastest capture, if no point has both outcomes", "m/s"),
      (OrNull<double>, upper_limit, "the slowest rebound, if no point has both outcomes", "m/s"),
      (OrNull<Ends>, interval, "the recommended interval", "m/s"),
      (OrNull<Ends>, interval_mc_error, "Monte-Carlo error of its ends", "m/s"),
      (CaptureIntervals, intervals, "intervals by kind"),
      (RecommendedEntry<CaptureIntervalKind>, recommended, "which interval to quote"),
      (OrAbsent<std::string>, why, "why there is no interval"),
      (OrAbsent<std::vector<BudgetRow>>, budget, "contributions to the standard error"),
      (OrAbsent<bool>, budget_linear, "whether the moves of the budget agree with linear "
       "propagation"),
      (OrAbsent<OrNull<double>>, budget_sd_without_first_constant, "the error that would remain if "
       "the constant with the largest share were exact", "m/s")) };

  struct Derived { RECOIL_RESULT(
      (std::vector<CaptureVelocity>, capture_velocity, "by dataset and diameter")) };

  struct SolverUse { RECOIL_RESULT(
      (Solver, name, "solver of the impacts"),
      (long, handovers, "number of impacts that went to the reference solver"),
      (DescentEnd, ended, "where the minimisation ended: at a minimum, in a valley (a combination "
       "of parameters has no effect along it), or where chi2 is flat (the points do not depend on "
       "a parameter, whose value then means nothing)", "",
       R"({"enum": ["minimum", "valley", "flat"]})"),
      (Strategy, strategy, "the minimiser that found the answer: Ceres' trust region, "
       "Levenberg-Marquardt within bounds, or Gauss-Newton")) };

  /// Whether the model describes the points.
  struct ModelVerdictFound { RECOIL_RESULT(
      (ModelVerdict, verdict, "whether the model describes the points"),
      (std::string, text, "the same in words"),
      (OrNull<LawErrorFound>, law_error, "how wrong the laws are; null: taken as exact")) };

  struct Goodness { RECOIL_RESULT(
      (OrReason<double>, chi2, "sum of the squared weighted residuals, with exact laws", "1"),
      (int, dof, "degrees of freedom", "", R"({"minimum": null})"),
      (OrReason<double>, p_value, "p-value of chi2 under the stated errors of points and constants",
       "1"),
      (OrReason<double>, minus_two_log_likelihood, "-2 ln of the density of e, with all constants",
       "1"),
      (OrReason<double>, rmse, "root mean square of e - e_model", "1"),
      (OrReason<double>, noise_scale, "factor by which the residuals exceed the noise", "1"),
      (std::string, noise_text, "the noise in words")) };

  struct NoiseCandidate { RECOIL_RESULT(
      (VarianceFunction, variance, "variance function"),
      (OrNull<double>, scale, "its scale", "1"),
      (OrNull<double>, criterion, "its criterion: the least is chosen", "1"),
      (double, handicap, "penalty in the criterion", "1")) };

  struct Noise { RECOIL_RESULT(
      (VarianceFunction, variance, "variance function"),
      (bool, chosen, "whether the points chose it"),
      (OrReason<double>, scale, "scale of the estimated noise", "1"),
      (std::string, scale_text, "the scale in words"),
      (std::vector<NoiseCandidate>, candidates, "the compared variance functions"),
      (OrReason<double>, margin, "margin of the choice, in the criterion", "1"),
      (int, points_with_velocity_errors, "points with an error of V"),
      (int, points_with_diameter_errors, "points with an error of the diameter"),
      (OrReason<double>, event_spread, "relative spread of the capture velocity from impact to "
       "impact", "1"),
      (OrReason<double>, setting_sd, "error of e that the points of one setting share", "1"),
      (bool, setting_sd_estimated, "whether this error was estimated"),
      (std::string, residuals, "distribution of the residuals", "",
       R"({"enum": ["normal", "student"]})"),
      (OrReason<double>, student_dof, "degrees of freedom of Student's t", "1"),
      (OrNull<double>, efficiency, "share of the precision that Student's t keeps", "1"),
      (std::string, text, "the noise in words")) };

  struct Direction { RECOIL_RESULT(
      (Named<OrNull<double>>, exponents, "the combination is the product of the parameters to "
       "these powers", "1"),
      (OrNull<double>, relative_sd, "relative standard deviation of the combination", "1"),
      (std::string, words, "the combination in words")) };

  struct MorePoints { RECOIL_RESULT(
      (std::string, dataset, "dataset"),
      (double, diameter_um, "diameter", "um"),
      (double, incident_velocity, "incident velocity", "m/s"),
      (int, points, "number of further points"),
      (Named<OrNull<double>>, relative_sd, "relative errors with these points", "1")) };

  /// The information of the points by direction, and the effect of more points.
  struct Information { RECOIL_RESULT(
      (std::vector<Direction>, directions, "combinations of parameters, the best known first"),
      (Named<OrNull<double>>, relative_sd, "relative standard deviations of the parameters", "1"),
      (OrNull<double>, condition, "condition number of the information", "1"),
      (std::vector<MorePoints>, more_points, "the best places for more points")) };

  struct Identifiable { RECOIL_RESULT(
      (OrNull<IdentifiabilityVerdict>, verdict, "whether the parameters are well determined: all, "
       "some or none"),
      (std::string, text, "the verdict in words"),
      (Named<bool>, parameters, "whether this parameter is well determined: the model fits, the "
       "interval excludes both bounds, and its error is at most a tenth of the value"),
      (Information, information, "what the points determine")) };

  struct Suspect { RECOIL_RESULT(
      (std::size_t, point, "number of the point, from 1"),
      (OrNull<double>, incident_velocity, "incident velocity", "m/s"),
      (OrNull<double>, diameter_um, "diameter", "um"),
      (OrNull<double>, disturbance_when_failed, "its disturbance in the failed replicates", "1"),
      (OrNull<double>, disturbance_otherwise, "its disturbance in the other replicates", "1")) };

  struct Failures {
    using Indices = std::vector<std::uint64_t>;
    RECOIL_RESULT(
      (std::string, text, "the failures in words"),
      (Indices, replicates, "numbers of the failed replicates, at most 100"),
      (std::string, message, "message of the minimiser"),
      (std::vector<Suspect>, suspects, "the points with the largest disturbances in them")) };

  struct Bootstrap { RECOIL_RESULT(
      (Scheme, scheme, "scheme in use"),
      (std::string, scheme_why, "why this scheme"),
      (int, replicates, "number of replicates"),
      (int, failed, "number of replicates whose fit failed"),
      (OrNull<Failures>, failures, "null if none failed"),
      (OrNull<double>, mc_error_of_width, "largest Monte-Carlo error of an interval end, over the "
       "width of the interval", "1"),
      (std::uint64_t, seed, "seed"),
      (std::size_t, usable, "number of replicates with an answer"),
      (int, two_point_replicates, "number of replicates that also ran the two-point iteration"),
      (Named<int>, two_point_failed, "number of these without an answer, by dataset")) };

  struct Marginal { RECOIL_RESULT(
      (OrNull<double>, mean, "posterior mean", "its unit"),
      (OrNull<double>, sd, "posterior standard deviation", "its unit"),
      (OrNull<double>, r_hat, "split R-hat of the chains", "1"),
      (OrNull<double>, effective_draws, "effective number of draws", "1"),
      (OrNull<double>, effective_tail_draws, "effective number of draws in the tails", "1")) };

  struct LeaveOneOut {
    using Terms = std::vector<OrNull<double>>;
    RECOIL_RESULT(
      (double, elpd, "expected log predictive density", "1"),
      (double, se, "its standard error", "1", R"({"minimum": 0})"),
      (double, p_loo, "effective number of parameters", "1"),
      (Terms, elpd_of_points, "its term of every point, in the order of `residuals`", "1"),
      (Terms, pareto_k, "Pareto k of every point; above largest_pareto_k its term means nothing; "
       "null: all draws have equal weight", "1"),
      (double, largest_pareto_k, "min(1 - 1/log10(draws), 0.7)", "1"),
      (double, mcse, "Monte Carlo error of elpd from the number of draws", "1",
       R"({"minimum": 0})"),
      (Terms, r_eff, "relative efficiency of the draws for the likelihood of every point: "
       "effective draws over draws", "1")) };

  struct Posterior { RECOIL_RESULT(
      (int, steps, "steps of every chain in the kept round"),
      (std::size_t, chains, "number of chains"),
      (OrNull<double>, acceptance, "share of accepted proposals", "1"),
      (std::size_t, draws, "number of kept draws"),
      (OrNull<std::string>, missing, "why there is no posterior; null if there is one"),
      (Named<Marginal>, parameters, "marginal of every parameter, with its convergence"),
      (OrReason<LeaveOneOut>, loo, "points left out one at a time (PSIS-LOO)")) };

  struct PaperPoint { RECOIL_RESULT(
      (OrNull<double>, incident_velocity, "incident velocity", "m/s"),
      (OrNull<double>, restitution, "e", "1"),
      (OrNull<double>, diameter_um, "diameter", "um")) };

  struct TwoPointParameter { RECOIL_RESULT(
      (OrReason<double>, value, "calibrated value", "its unit"),
      (std::string, unit, "unit of the parameter"),
      (OrReason<double>, spread, "standard deviation under resampling", "its unit")) };

  struct TwoPoint { RECOIL_RESULT(
      (TwoPointStatus, status, "end of the iteration"),
      (std::string, text, "the result in words"),
      (int, iterations, "number of iterations"),
      (OrNull<double>, diameter_um, "diameter of the two points", "um"),
      (OrNull<PaperPoint>, low_point, "the slow point"),
      (OrNull<PaperPoint>, high_point, "the fast point"),
      (Named<TwoPointParameter>, parameters, "C_H and C_A"),
      (OrReason<double>, rmse, "root mean square of e - e_model at all points", "1"),
      (OrReason<double>, held_out_rmse, "the same at the other diameters", "1"),
      (int, failed, "number of replicates without an answer")) };

  /// The full fit, for comparison with two points.
  struct Full { RECOIL_RESULT(
      (OrReason<double>, rmse, "root mean square of e - e_model at all points", "1"),
      (OrReason<double>, held_out_rmse, "the same at held-out diameters", "1"),
      (OrAbsent<Named<OrNull<double>>>, spread, "sd under resampling, by parameter",
       "its unit")) };

  /// One method of estimating the three parameters of the paper's model.
  struct CalibrationRow { RECOIL_RESULT(
      (std::string, dataset, "dataset"),
      (CalibrationKind, id, "two points, all points with the same f0, all points with f0 fitted, or "
       "the fit itself: the others take laws and constants as exact"),
      (bool, headline, "whether `parameters` are those of this row"),
      (OrReason<double>, f0, "f0 at the reference diameter", "N/m"),
      (OrReason<double>, C_H, "Hertz damping C_H", "1"),
      (OrReason<double>, C_A, "adhesion damping C_A", "1"),
      (OrReason<double>, C_H_standard_error, "standard error of C_H, with the constants, and an f0 "
       "that is not fitted, as exact; of the fit itself with their errors", "1"),
      (OrReason<double>, C_A_standard_error, "the same of C_A", "1"),
      (OrReason<double>, rmse, "root mean square of e - e_model at all points", "1"),
      (OrReason<double>, held_out_rmse, "the same at held-out diameters", "1")) };

  struct Start { RECOIL_RESULT(
      (std::vector<OrNull<double>>, start, "parameters at the start", "SI"),
      (std::vector<OrNull<double>>, end, "parameters at the end", "SI"),
      (OrNull<double>, chi2, "chi2 at the end, of the points that the search used (250 to 374 of "
       "them if there are more than 500)", "1"),
      (bool, converged, "true for a minimum and a valley"),
      (DescentEnd, ended, "as `solver.ended`, or the iteration limit, or no answer of the model"),
      (std::string, message, "message of the minimiser")) };

  struct CurvePoint { RECOIL_RESULT(
      (std::string, dataset, "dataset"),
      (std::string, series, "series"),
      (OrNull<double>, diameter_um, "diameter", "um"),
      (OrNull<double>, incident_velocity, "incident velocity", "m/s"),
      (OrNull<double>, restitution, "e of the fit", "1"),
      (OrNull<Ends>, band, "its pointwise band", "1"),
      (OrNull<double>, two_point, "e of the two-point calibration", "1")) };

  /// One point of the data with its residual.
  struct Residual { RECOIL_RESULT(
      (std::string, dataset, "dataset"),
      (std::string, series, "series"),
      (OrNull<double>, diameter_um, "diameter", "um"),
      (OrNull<double>, incident_velocity, "incident velocity, its normal component", "m/s"),
      (double, incidence_angle_deg, "stated angle of incidence from the normal, else 0", "deg"),
      (OrNull<double>, restitution, "e as measured", "1"),
      (OrNull<double>, restitution_sd, "its stated standard deviation; null if the point states "
       "none", "1"),
      (OrNull<double>, sd_used, "standard deviation of e in the fit", "1"),
      (OrNull<double>, sd_of_e2_from_inputs, "standard deviation of e² from the errors of V and "
       "the diameter", "1"),
      (bool, captured, "true if all impacts were captured"),
      (int, captured_count, "number of captured impacts"),
      (int, events, "number of impacts"),
      (OrNull<double>, predicted, "e of the fit", "1"),
      (OrNull<double>, weighted_residual, "residual of e² over its standard deviation", "1"),
      (OrNull<double>, leverage, "leverage of the point", "1")) };

  struct OwnCoverageEntry { RECOIL_RESULT(
      (std::string, quantity, "a parameter, or V*(diameter)"),
      (std::string, method, "the kind of interval that was counted", "",
       R"({"enum": ["wald", "profile", "delta"]})"),
      (double, share, "share of the data sets whose interval contains the truth", "1"),
      (int, datasets, "number of simulated data sets with such an interval", "", at_least_one)) };

  struct OwnDesign { RECOIL_RESULT(
      (std::vector<OwnCoverageEntry>, coverage, "every quantity with a quoted interval")) };

  RECOIL_RESULT(
    (FormatVersion, format_version, about_format_version),
    (std::string, recoil_version, about_recoil_version),
    (Source, fit, "the fit file"),
    (std::string, provenance_sentence, "the meaning of the provenance, for all datasets"),
    (DatasetEntry, dataset, "the dataset; several are joined, with the weakest provenance of them"),
    (std::vector<DatasetEntry>, datasets, "each dataset"),
    (std::vector<RestitutionMeanEntry>, restitution_summary, about_restitution_summary),
    (std::vector<RestitutionRangeEntry>, restitution_range, about_restitution_range),
    (VelocityDependenceEntry, velocity_dependence, about_velocity_dependence),
    (SeriesDifferEntry, series_differ, about_series_differ),
    (std::vector<FrictionEntry>, friction, about_friction),
    (std::vector<LossLawEntry>, loss_laws, "without adhesion, and if the fit file names no loss: "
     "every loss law, the best first"),
    (Options, options, "the options in use, after command line and defaults"),
    (Model, model, "the model"),
    (Named<Parameter>, parameters, "by name; NAME[DATASET] or NAME[SERIES] if it belongs to one "
     "dataset or series"),
    (Named<Constant>, constants, "constants of the materials that have an error"),
    (OrNull<Matrix>, covariance, "covariance of the free parameters", "SI"),
    (OrNull<Matrix>, correlation, "correlation of the free parameters", "1"),
    (Derived, derived, "quantities that follow from the parameters"),
    (SolverUse, solver, "solver and minimiser"),
    (ModelVerdictFound, model_verdict, "whether the model describes the points"),
    (Goodness, goodness, "quality of the fit"),
    (Noise, noise, "noise of the points"),
    (Identifiable, identifiability, "what the points determine"),
    (std::vector<ValidityEntry>, validity, "limits of validity of the model, at the worst point of "
     "each dataset"),
    (Bootstrap, bootstrap, "the bootstrap"),
    (OrReason<OwnDesign>, own_design, "coverage in data sets that are simulated at the estimate "
     "with these points, noise and captures"),
    (OrNull<Posterior>, posterior, "null without `posterior = true`"),
    (std::vector<CalibrationRow>, comparison, "two points against all points: three rows per "
     "dataset, and one for the fit itself if it is none of them"),
    (OrReason<TwoPoint>, two_point, "the two-point calibration of the first dataset"),
    (Full, full, "the same comparison for the full fit, first dataset"),
    (Named<TwoPoint>, two_point_by_dataset, "the same, by dataset"),
    (Named<Full>, full_by_dataset, "the same, by dataset"),
    (std::vector<Start>, starts, "every starting point of the fit"),
    (Strings, warnings, "the assumptions, and which of two contradictory inputs was used"),
    (std::vector<CurvePoint>, curve, "e(V) of the fit"),
    (std::vector<Residual>, residuals, "every point")) };

// clang-format on

/// The interval of a parameter to quote; nullopt if there is none.
std::optional<Ends> recommended_interval(const FitFile::Parameter& parameter);

/// Reads the text of a fit.json.
/// @param file name of the file, for messages
/// @param reader the command that reads it, for messages: "recoil compare"
/// @throws InputError if it is not JSON, not the result of a fit, or has another format_version
FitFile read_fit_file(const std::string& file, const std::string& text, const std::string& reader);

/// One parameter of a fit.json.
struct FittedValue {
  double value = 0.0;
  std::optional<double> std_error;
};

/// Reads the fit.json of `--parameters`. @returns nullopt for an empty path
/// @throws InputError if the file is not a fit.json
std::optional<FitFile> read_parameters(const std::string& path);

/// `spec` with the loss of the dry contact that `fit`, if there is one, chose, where the fit file
/// leaves the loss to the points.
FitSpec with_fitted_loss(FitSpec spec, const std::optional<FitFile>& fit);

/// Where values come from: "from my-fit/fit.json", with "exact laws" if the fit was averaged over
/// errors of the laws.
std::string origin_words(const FitFile& fit, const std::string& path);

/// Replaces the fit file's initial values by the values of a fit.json, and returns them [slots]. If
/// the fit was averaged over errors of the laws, they are those that fit best with exact laws.
/// @param datasets the datasets of the fit file; the values must have been fitted to the same files
/// @param path the file's name in messages
/// @throws InputError if the values belong to another fit
std::vector<FittedValue> take_fitted_values(ImpactModel& model,
                                            const std::vector<Dataset>& datasets,
                                            const FitFile& fit, const std::string& path);

}  // namespace recoil
