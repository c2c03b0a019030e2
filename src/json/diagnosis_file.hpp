#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "diagnosis/diagnosis_result.hpp"
#include "json/fit_file.hpp"

namespace recoil {

/// `diagnosis.json`: the result of one diagnosis. SI units unless the name of a member says
/// otherwise. docs/diagnosis-json.md describes every key.
struct DiagnosisFile {
  struct Data {
    std::string id;
    Provenance provenance = Provenance::measured;
    std::size_t points = 0;
    std::string sha256;
    RECOIL_FIELDS(id, provenance, points, sha256)
  };

  struct Test {
    StructureQuestion id{};
    std::string asks;
    std::optional<double> statistic;
    double p_value = 1.0;
    RECOIL_FIELDS(id, asks, statistic, p_value)
  };

  struct Cell {
    std::string dataset;
    double diameter_um = 0.0;
    Ends incident_velocity = {};  ///< ends of the band [m/s]
    int points = 0;
    std::optional<double> restitution, energy_J, standardised;
    std::string model_is;  ///< "too low" or "too high"
    RECOIL_FIELDS(dataset, diameter_um, incident_velocity, points, restitution, energy_J,
                  standardised, model_is)
  };

  struct Misfit {
    double p_value = 1.0;
    int simulated = 0, failed = 0;
    std::vector<Test> tests;
    std::vector<Cell> where;
    double free_form_remaining_p = 1.0;
    RECOIL_FIELDS(p_value, simulated, failed, tests, where, free_form_remaining_p)
  };

  struct Outlying {
    std::string dataset;
    int row = 0;  ///< line in the dataset's file of points
    double diameter_um = 0.0, incident_velocity = 0.0, restitution = 0.0;
    std::optional<double> residual;
    RECOIL_FIELDS(dataset, row, diameter_um, incident_velocity, restitution, residual)
  };

  struct AnswerForAll {
    Verdict verdict = Verdict::adequate;
    std::vector<std::string> named, rivals, resembles;
    RECOIL_FIELDS(verdict, named, rivals, resembles)
  };

  struct FoundParameter {
    std::optional<double> value, sd;
    std::string unit;
    double null_value = 0.0;
    std::optional<Condition> stated_by;
    bool plausible = true;
    RECOIL_FIELDS(value, sd, unit, null_value, stated_by, plausible)
  };

  struct Candidate {
    std::string id;
    MechanismKind kind = MechanismKind::physics;
    Named<FoundParameter> parameters;
    std::optional<double> p_value, delta_aicc;
    double remaining_p = 0.0, remaining_part = 1.0;
    std::optional<double> held_out_gain, held_out_log_score;
    bool plausible = true;
    double cost_of_possible = 0.0;
    std::optional<std::string> aside;  ///< why it is not accepted as a cause
    RECOIL_FIELDS(id, kind, parameters, p_value, delta_aicc, remaining_p, remaining_part,
                  held_out_gain, held_out_log_score, plausible, cost_of_possible, aside)
  };

  struct FoldEntry {
    FoldKind kind = FoldKind::size;
    std::string name;
    std::size_t points = 0;
    std::optional<double> rmse_base, rmse_extended, log_score;
    bool counted = true, chosen = true;
    RECOIL_FIELDS(kind, name, points, rmse_base, rmse_extended, log_score, counted, chosen)
  };

  struct Gain {
    std::optional<double> held_out_rmse_base, held_out_rmse_extended, relative;
    std::optional<Ends> interval;
    std::optional<double> log_score;
    std::vector<FoldEntry> folds;
    RECOIL_FIELDS(held_out_rmse_base, held_out_rmse_extended, relative, interval, log_score, folds)
  };

  struct FittedParameter {
    std::optional<double> value;
    std::string unit;
    bool free = false;
    std::optional<double> std_error;
    OrAbsent<std::optional<Ends>> interval;
    RECOIL_FIELDS(value, unit, free, std_error, interval)
  };

  struct Fit {
    Named<FittedParameter> parameters;
    std::optional<double> chi2;
    int dof = 0;
    std::optional<double> rmse;
    RECOIL_FIELDS(parameters, chi2, dof, rmse)
  };

  struct Capture {
    std::string dataset;
    double diameter_um = 0.0;
    std::optional<double> base, extended;  ///< [m/s]
    RECOIL_FIELDS(dataset, diameter_um, base, extended)
  };

  struct Experiment {
    ExperimentKind kind = ExperimentKind::points;
    OrAbsent<Condition> condition;  ///< only of kind `condition`, like the next two
    OrAbsent<double> value;
    OrAbsent<std::string> doing;
    std::string dataset, series;
    double diameter_um = 0.0, incident_velocity = 0.0;
    int events = 0;
    std::array<std::string, 2> separates;
    std::optional<double> expected_difference, expected_log_odds;
    RECOIL_FIELDS(kind, condition, value, doing, dataset, series, diameter_um, incident_velocity,
                  events, separates, expected_difference, expected_log_odds)
  };

  struct Expected {
    std::string id, dataset;
    Condition condition = Condition::ambient_pressure;
    double value = 0.0, diameter_um = 0.0, incident_velocity = 0.0;
    std::optional<double> change;
    RECOIL_FIELDS(id, dataset, condition, value, diameter_um, incident_velocity, change)
  };

  struct Unstated {
    UnstatedSource id = UnstatedSource::velocity_errors;
    double value = 0.0, delta_aicc = 0.0, remaining_p = 0.0;
    bool leave_nothing = false;
    bool rival = false;  ///< explains the data instead of the answer, or as well
    RECOIL_FIELDS(id, value, delta_aicc, remaining_p, leave_nothing, rival)
  };

  struct Settings {
    double level = 0.0, chance = 0.0, apart = 0.0, apart_in_pairs = 0.0;
    int compared = 0;
    std::uint64_t seed = 0;
    RECOIL_FIELDS(level, chance, apart, apart_in_pairs, compared, seed)
  };

  struct Exact {
    double p_value = 1.0;
    std::vector<std::string> listed;
    RECOIL_FIELDS(p_value, listed)
  };

  struct DetectionEntry {
    std::string id;
    double strength = 1.0;
    int datasets = 0, named = 0, listed = 0, wrong = 0;
    RECOIL_FIELDS(id, strength, datasets, named, listed, wrong)
  };

  struct FalseAlarms {
    int datasets = 0;
    double share = 0.0;
    RECOIL_FIELDS(datasets, share)
  };

  struct OwnDesignEntry {
    std::vector<DetectionEntry> detection;
    FalseAlarms false_alarms;
    RECOIL_FIELDS(detection, false_alarms)
  };

  int format_version = recoil::format_version;
  std::string fit;
  std::vector<Data> datasets;
  std::vector<RestitutionMeanEntry> restitution_summary;
  VelocityDependenceEntry velocity_dependence;
  SeriesDifferEntry series_differ;
  Verdict verdict = Verdict::adequate;
  std::string headline, text;
  Misfit misfit;
  std::vector<Outlying> outlying_points;
  std::optional<AnswerForAll> with_outlying_points;
  double law_error = 0.0;
  std::optional<Exact> if_exact;
  std::vector<std::string> named, rivals, resembles, in_every_explanation;
  std::optional<std::string> shared_cause;
  std::vector<Candidate> candidates, pairs;
  std::optional<Gain> gain;
  Fit base;
  std::optional<Fit> extended;
  std::vector<Capture> capture_velocity;
  std::vector<Experiment> next_experiment;
  std::vector<Expected> expected_effects;
  std::vector<Unstated> unstated_errors;
  OrAbsent<OwnDesignEntry> own_design;
  Settings settings;
  std::vector<std::string> warnings, remarks;
  RECOIL_FIELDS(format_version, fit, datasets, restitution_summary, velocity_dependence,
                series_differ, verdict, headline, text, misfit, outlying_points,
                with_outlying_points, law_error, if_exact, named, rivals, resembles,
                in_every_explanation, shared_cause, candidates, pairs, gain, base, extended,
                capture_velocity, next_experiment, expected_effects, unstated_errors, own_design,
                settings, warnings, remarks)
};

}  // namespace recoil
