#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/least_squares.hpp"
#include "estimate/model.hpp"
#include "estimate/two_point.hpp"
#include "impact/impact.hpp"
#include "predict/validity.hpp"
#include "uncertainty/identifiability.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/two_point_comparison.hpp"

namespace recoil {

/// Lower and upper end.
using Ends = std::array<double, 2>;

/// A dataset of a result.
struct DatasetEntry {
  std::string id, title;
  Provenance provenance = Provenance::measured;
  std::string provenance_sentence;
  std::size_t points = 0;
  std::string sha256;
  std::vector<std::string> sources;
  RECOIL_FIELDS(id, title, provenance, provenance_sentence, points, sha256, sources)
};

/// One check of the validity of the model.
struct ValidityEntry {
  ValidityQuantity quantity = ValidityQuantity::contact_radius;
  std::optional<double> value;
  double limit = 0.0;
  std::string limit_is;   ///< "least" or "largest" good value
  bool exceeded = false;  ///< true: the limit is exceeded, and the model is not valid
  OrAbsent<std::string> dataset;
  OrAbsent<double> diameter_um, incident_velocity;  ///< [um], [m/s]
  std::string text;
  RECOIL_FIELDS(quantity, value, limit, limit_is, exceeded, dataset, diameter_um, incident_velocity,
                text)
};

/// A mean of e over a series of one diameter, or over one setting of it.
struct RestitutionMeanEntry {
  std::string dataset, series;
  std::optional<std::string> setting;
  double diameter_um = 0.0;
  std::optional<double> incident_velocity;  ///< mean V of a setting [m/s]
  double value = 0.0;
  OrReason<Ends> interval;
  int points = 0;
  RECOIL_FIELDS(dataset, series, setting, diameter_um, incident_velocity, value, interval, points)
};

/// The slope b of e = a_series + b log10 V [1/decade].
struct VelocityDependenceEntry {
  OrReason<double> slope;
  std::optional<Ends> interval;
  std::optional<double> p_value;
  RECOIL_FIELDS(slope, interval, p_value)
};

/// The test for differences between series, and the largest difference.
struct SeriesDifferEntry {
  OrReason<double> p_value;
  std::optional<std::array<std::string, 2>> most_different;
  std::optional<double> difference;
  std::optional<Ends> interval;
  RECOIL_FIELDS(p_value, most_different, difference, interval)
};

/// A law of loss of the dry contact, compared with the others.
struct LossLawEntry {
  std::string id;
  double delta_aicc = 0.0;
  RECOIL_FIELDS(id, delta_aicc)
};

/// `fit.json`: the result of one fit. SI units unless the name of a member says otherwise.
/// docs/fit-json.md describes every key.
struct FitFile {
  struct Source {
    std::string id, sha256;
    RECOIL_FIELDS(id, sha256)
  };

  struct ParameterOptions {
    std::optional<double> initial;
    bool free = false;
    Ends bounds = {};
    RECOIL_FIELDS(initial, free, bounds)
  };

  /// The options in use, from the fit file, the command line and the defaults.
  struct Options {
    AdhesionLaw adhesion = AdhesionLaw::ring;
    AdhesionDampingPhase adhesion_damping_phase = AdhesionDampingPhase::rebound;
    std::string loss;  ///< loss of the dry contact in use
    std::vector<std::string> mechanisms;
    bool mixed_sizes = false;  ///< true: points average over stated sizes
    Json replicates;           ///< a number, or "auto"
    Scheme scheme = Scheme::automatic;
    double level = 0.0;
    std::uint64_t seed = 0;
    bool materials = false, materials_adjusted = false;
    Named<ParameterOptions> parameters;
    RECOIL_FIELDS(adhesion, adhesion_damping_phase, loss, mechanisms, mixed_sizes, replicates,
                  scheme, level, seed, materials, materials_adjusted, parameters)
  };

  /// The contact properties that follow from the materials of one dataset.
  struct Contact {
    std::string dataset;
    std::optional<double> stiffness_K_Pa, stiffness_K_derived_Pa, adhesion_energy_J_per_m2,
        f0_N_per_m, W_of_f0_J_per_m2, f0_eq12_N_per_m, reference_diameter_um,
        particle_density_kg_per_m3, adhesion_velocity_m_per_s;
    std::vector<std::string> contradictions;
    RECOIL_FIELDS(dataset, stiffness_K_Pa, stiffness_K_derived_Pa, adhesion_energy_J_per_m2,
                  f0_N_per_m, W_of_f0_J_per_m2, f0_eq12_N_per_m, reference_diameter_um,
                  particle_density_kg_per_m3, adhesion_velocity_m_per_s, contradictions)
  };

  struct Model {
    std::string equation;
    AdhesionLaw adhesion = AdhesionLaw::ring;
    AdhesionDampingPhase adhesion_damping_phase = AdhesionDampingPhase::rebound;
    std::vector<Contact> contacts;
    OrAbsent<double> separation_m;  ///< z0 of Maugis' law
    RECOIL_FIELDS(equation, adhesion, adhesion_damping_phase, contacts, separation_m)
  };

  /// The interval to quote, and the reason.
  struct Recommended {
    std::optional<std::string> interval;  ///< key of the interval
    std::string why;
    RECOIL_FIELDS(interval, why)
  };

  struct Intervals {
    std::optional<Ends> wald, profile, percentile, bca, studentized;
    Named<std::string> why;  ///< reasons for the intervals that are null
    Recommended recommended;
    std::optional<Ends> posterior;
    RECOIL_FIELDS(wald, profile, percentile, bca, studentized, why, recommended, posterior)
  };

  struct BcaConstants {
    double bias = 0.0, acceleration = 0.0;
    RECOIL_FIELDS(bias, acceleration)
  };

  /// One source of a standard error.
  struct BudgetRow {
    std::string source;
    std::optional<double> sd, share;
    OrAbsent<Ends> move;
    RECOIL_FIELDS(source, sd, share, move)
  };

  struct MaterialsExact {
    std::optional<double> value, std_error;
    Named<std::optional<Ends>> intervals;
    RECOIL_FIELDS(value, std_error, intervals)
  };

  struct Parameter {
    OrReason<double> value;
    std::string unit;
    bool free = false, at_bound = false;
    OrReason<double> std_error;
    Intervals intervals;
    Recommended recommended;
    std::optional<ProfileShape> profile_shape;
    Named<std::optional<Ends>> intervals_mc_error;
    Named<std::string> intervals_note;
    std::optional<std::string> intervals_differ;
    std::optional<BcaConstants> bca_constants;
    std::optional<double> bound_share;
    OrAbsent<std::vector<BudgetRow>> budget;
    OrAbsent<bool> budget_linear;
    OrAbsent<std::optional<double>> budget_sd_without_first_constant;
    OrAbsent<MaterialsExact> materials_exact;
    RECOIL_FIELDS(value, unit, free, at_bound, std_error, intervals, recommended, profile_shape,
                  intervals_mc_error, intervals_note, intervals_differ, bca_constants, bound_share,
                  budget, budget_linear, budget_sd_without_first_constant, materials_exact)
  };

  /// A material constant with a stated error.
  struct Constant {
    std::optional<double> value;
    std::string unit, meaning;
    std::optional<double> std_error, stated, stated_sd;
    std::string distribution;  ///< "normal" or "lognormal"
    std::optional<double> moved_sd;
    std::vector<std::string> datasets;
    RECOIL_FIELDS(value, unit, meaning, std_error, stated, stated_sd, distribution, moved_sd,
                  datasets)
  };

  using Matrix = Named<Named<std::optional<double>>>;

  struct CaptureIntervals {
    std::optional<Ends> delta, percentile, studentized;
    OrAbsent<std::optional<Ends>> posterior;
    RECOIL_FIELDS(delta, percentile, studentized, posterior)
  };

  struct CaptureVelocity {
    std::string dataset;
    std::optional<double> diameter_um;
    std::string unit;
    OrReason<double> value;
    /// Largest velocity with captures, if no point has both outcomes [m/s].
    std::optional<double> lower_limit;
    /// Smallest velocity without captures, if no point has both outcomes [m/s].
    std::optional<double> upper_limit;
    std::optional<Ends> interval, interval_mc_error;
    CaptureIntervals intervals;
    Recommended recommended;
    OrAbsent<std::string> why;  ///< reason for a missing interval
    OrAbsent<std::vector<BudgetRow>> budget;
    OrAbsent<bool> budget_linear;
    OrAbsent<std::optional<double>> budget_sd_without_first_constant;
    RECOIL_FIELDS(dataset, diameter_um, unit, value, lower_limit, upper_limit, interval,
                  interval_mc_error, intervals, recommended, why, budget, budget_linear,
                  budget_sd_without_first_constant)
  };

  struct Derived {
    std::vector<CaptureVelocity> capture_velocity;
    RECOIL_FIELDS(capture_velocity)
  };

  struct SolverUse {
    Solver name = Solver::fast;
    long handovers = 0;
    DescentEnd ended = DescentEnd::minimum;
    Strategy strategy = Strategy::trust_region;
    RECOIL_FIELDS(name, handovers, ended, strategy)
  };

  struct Goodness {
    OrReason<double> chi2;
    int dof = 0;
    OrReason<double> p_value, minus_two_log_likelihood, rmse, noise_scale;
    std::string noise_text;
    RECOIL_FIELDS(chi2, dof, p_value, minus_two_log_likelihood, rmse, noise_scale, noise_text)
  };

  struct NoiseCandidate {
    VarianceFunction variance = VarianceFunction::constant;
    std::optional<double> scale, criterion;
    double handicap = 0.0;
    RECOIL_FIELDS(variance, scale, criterion, handicap)
  };

  struct Noise {
    VarianceFunction variance = VarianceFunction::constant;
    bool chosen = false;
    OrReason<double> scale;
    std::string scale_text;
    std::vector<NoiseCandidate> candidates;
    OrReason<double> margin;
    int points_with_velocity_errors = 0, points_with_diameter_errors = 0;
    OrReason<double> event_spread, setting_sd;
    bool setting_sd_estimated = false;
    std::string residuals;  ///< "normal" or "student"
    OrReason<double> student_dof;
    std::optional<double> efficiency;
    std::string text;
    RECOIL_FIELDS(variance, chosen, scale, scale_text, candidates, margin,
                  points_with_velocity_errors, points_with_diameter_errors, event_spread,
                  setting_sd, setting_sd_estimated, residuals, student_dof, efficiency, text)
  };

  struct Direction {
    Named<std::optional<double>> exponents;
    std::optional<double> relative_sd;
    std::string words;
    RECOIL_FIELDS(exponents, relative_sd, words)
  };

  struct MorePoints {
    std::string dataset;
    double diameter_um = 0.0, incident_velocity = 0.0;
    int points = 0;
    Named<std::optional<double>> relative_sd;
    RECOIL_FIELDS(dataset, diameter_um, incident_velocity, points, relative_sd)
  };

  /// The information of the points by direction, and the effect of more points.
  struct Information {
    std::vector<Direction> directions;
    Named<std::optional<double>> relative_sd;
    std::optional<double> condition;
    std::vector<MorePoints> more_points;
    RECOIL_FIELDS(directions, relative_sd, condition, more_points)
  };

  struct Identifiable {
    std::optional<IdentifiabilityVerdict> verdict;
    std::string text;
    Named<bool> parameters;
    Information information;
    RECOIL_FIELDS(verdict, text, parameters, information)
  };

  struct Suspect {
    std::size_t point = 0;  ///< counted from 1
    std::optional<double> incident_velocity, diameter_um, disturbance_when_failed,
        disturbance_otherwise;
    RECOIL_FIELDS(point, incident_velocity, diameter_um, disturbance_when_failed,
                  disturbance_otherwise)
  };

  struct Failures {
    std::string text;
    std::vector<std::uint64_t> replicates;
    std::string message;
    std::vector<Suspect> suspects;
    RECOIL_FIELDS(text, replicates, message, suspects)
  };

  struct Bootstrap {
    Scheme scheme = Scheme::parametric;
    std::string scheme_why;
    int replicates = 0, failed = 0;
    std::optional<Failures> failures;
    std::optional<double> mc_error_of_width;
    std::uint64_t seed = 0;
    std::size_t usable = 0;
    int two_point_replicates = 0;
    Named<int> two_point_failed;
    RECOIL_FIELDS(scheme, scheme_why, replicates, failed, failures, mc_error_of_width, seed, usable,
                  two_point_replicates, two_point_failed)
  };

  struct Marginal {
    std::optional<double> mean, sd, r_hat, effective_draws, effective_tail_draws;
    RECOIL_FIELDS(mean, sd, r_hat, effective_draws, effective_tail_draws)
  };

  struct LeaveOneOut {
    double elpd = 0.0, se = 0.0, p_loo = 0.0;
    std::vector<std::optional<double>> elpd_of_points, pareto_k;
    RECOIL_FIELDS(elpd, se, p_loo, elpd_of_points, pareto_k)
  };

  struct Posterior {
    int steps = 0;
    std::size_t chains = 0;
    std::optional<double> acceptance;
    std::size_t draws = 0;
    std::optional<std::string> missing;
    Named<Marginal> parameters;
    OrReason<LeaveOneOut> loo;
    RECOIL_FIELDS(steps, chains, acceptance, draws, missing, parameters, loo)
  };

  struct PaperPoint {
    std::optional<double> incident_velocity, restitution, diameter_um;
    RECOIL_FIELDS(incident_velocity, restitution, diameter_um)
  };

  struct TwoPointParameter {
    OrReason<double> value;
    std::string unit;
    OrReason<double> spread;
    RECOIL_FIELDS(value, unit, spread)
  };

  struct TwoPoint {
    TwoPointStatus status = TwoPointStatus::converged;
    std::string text;
    int iterations = 0;
    std::optional<double> diameter_um;
    std::optional<PaperPoint> low_point, high_point;
    Named<TwoPointParameter> parameters;
    OrReason<double> rmse, held_out_rmse;
    int failed = 0;
    RECOIL_FIELDS(status, text, iterations, diameter_um, low_point, high_point, parameters, rmse,
                  held_out_rmse, failed)
  };

  /// The full fit, for comparison with two points.
  struct Full {
    OrReason<double> rmse, held_out_rmse;
    OrAbsent<Named<std::optional<double>>> spread;
    RECOIL_FIELDS(rmse, held_out_rmse, spread)
  };

  /// One method of estimating the three parameters of the paper's model; f0 at the reference
  /// diameter.
  struct Compared {
    std::string dataset;
    ComparisonWay id = ComparisonWay::two_point;
    OrReason<double> f0, C_H, C_A, C_H_standard_error, C_A_standard_error, rmse, held_out_rmse;
    RECOIL_FIELDS(dataset, id, f0, C_H, C_A, C_H_standard_error, C_A_standard_error, rmse,
                  held_out_rmse)
  };

  struct Start {
    std::vector<double> start, end;
    std::optional<double> chi2;
    bool converged = false;
    DescentEnd ended = DescentEnd::minimum;
    std::string message;
    RECOIL_FIELDS(start, end, chi2, converged, ended, message)
  };

  struct CurvePoint {
    std::string dataset, series;
    std::optional<double> diameter_um, incident_velocity, restitution;
    std::optional<Ends> band;
    std::optional<double> two_point;
    RECOIL_FIELDS(dataset, series, diameter_um, incident_velocity, restitution, band, two_point)
  };

  /// One point of the data with its residual.
  struct Residual {
    std::string dataset, series;
    std::optional<double> diameter_um, incident_velocity, restitution, restitution_sd, sd_used,
        sd_of_e2_from_inputs;
    bool captured = false;
    int captured_count = 0, events = 0;
    std::optional<double> predicted, weighted_residual, leverage;
    RECOIL_FIELDS(dataset, series, diameter_um, incident_velocity, restitution, restitution_sd,
                  sd_used, sd_of_e2_from_inputs, captured, captured_count, events, predicted,
                  weighted_residual, leverage)
  };

  struct OwnDesign {
    struct Coverage {
      std::string quantity, method;
      double share = 0.0;
      int datasets = 0;
      RECOIL_FIELDS(quantity, method, share, datasets)
    };
    std::vector<Coverage> coverage;
    RECOIL_FIELDS(coverage)
  };

  int format_version = recoil::format_version;
  std::string recoil_version;
  Source fit;
  std::string provenance_sentence;
  DatasetEntry dataset;  ///< several datasets combined into one, with the weakest provenance
  std::vector<DatasetEntry> datasets;
  std::vector<RestitutionMeanEntry> restitution_summary;
  VelocityDependenceEntry velocity_dependence;
  SeriesDifferEntry series_differ;
  std::vector<LossLawEntry> loss_laws;  ///< the best first; empty if no choice was made
  Options options;
  Model model;
  Named<Parameter> parameters;
  Named<Constant> constants;
  std::optional<Matrix> covariance, correlation;
  Derived derived;
  SolverUse solver;
  Goodness goodness;
  Noise noise;
  Identifiable identifiability;
  std::vector<ValidityEntry> validity;
  Bootstrap bootstrap;
  OrAbsent<OwnDesign> own_design;
  std::optional<Posterior> posterior;
  std::vector<Compared> comparison;
  OrReason<TwoPoint> two_point;  ///< of the first dataset
  Full full;                     ///< of the first dataset
  Named<TwoPoint> two_point_by_dataset;
  Named<Full> full_by_dataset;
  std::vector<Start> starts;
  std::vector<std::string> warnings;
  std::vector<CurvePoint> curve;
  std::vector<Residual> residuals;
  RECOIL_FIELDS(format_version, recoil_version, fit, provenance_sentence, dataset, datasets,
                restitution_summary, velocity_dependence, series_differ, loss_laws, options, model,
                parameters, constants, covariance, correlation, derived, solver, goodness, noise,
                identifiability, validity, bootstrap, own_design, posterior, comparison, two_point,
                full, two_point_by_dataset, full_by_dataset, starts, warnings, curve, residuals)
};

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

/// Replaces the fit file's initial values by the values of a fit.json, and returns them [slots].
/// @param datasets the datasets of the fit file; the values must have been fitted to the same files
/// @param path the file's name in messages
/// @throws InputError if the values belong to another fit
std::vector<FittedValue> take_fitted_values(ImpactModel& model,
                                            const std::vector<Dataset>& datasets,
                                            const FitFile& fit, const std::string& path);

}  // namespace recoil
