#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "diagnosis/diagnosis_result.hpp"
#include "json/fit_file.hpp"

namespace recoil {

// One member per line.
// clang-format off

/// `diagnosis.json`: the result of one diagnosis. SI units unless the name of a member says
/// otherwise.
struct DiagnosisFile {
  struct Data { RECOIL_RESULT(
      (std::string, id, "name of the dataset"),
      (Provenance, provenance, "origin of the data"),
      (std::size_t, points, "number of points"),
      (std::string, sha256, "SHA-256 of datapackage.json and the points", "", sha256_schema)) };

  struct Test { RECOIL_RESULT(
      (StructureQuestion, id, "the test"),
      (std::string, asks, "the question that it examines"),
      (OrNull<double>, statistic, "its statistic", "1"),
      (double, p_value, "its p-value", "1")) };

  struct Cell { RECOIL_RESULT(
      (std::string, dataset, "dataset"),
      (double, diameter_um, "diameter", "um"),
      (Ends, incident_velocity, "ends of the range of velocities", "m/s"),
      (int, points, "number of points"),
      (OrNull<double>, restitution, "mean residual of e", "1"),
      (OrNull<double>, energy_J, "mean residual of the energy", "J"),
      (OrNull<double>, standardised, "mean residual of e, in standard errors", "1"),
      (std::string, model_is, "how the model lies to the points", "",
       R"({"enum": ["too high", "too low"]})")) };

  struct Misfit { RECOIL_RESULT(
      (double, p_value, "p-value of the structure in the residuals, from simulated data sets", "1"),
      (int, simulated, "number of simulated data sets"),
      (int, failed, "number of these whose fit failed"),
      (std::vector<Test>, tests, "the single tests"),
      (std::vector<Cell>, where, "mean residuals by size and range of velocities"),
      (OrNull<double>, free_form_remaining_p, "p-value of the structure that a free smooth "
       "function of velocity and size leaves", "1")) };

  struct Outlying { RECOIL_RESULT(
      (std::string, dataset, "dataset"),
      (int, row, "line in the file of points"),
      (double, diameter_um, "diameter", "um"),
      (double, incident_velocity, "incident velocity", "m/s"),
      (OrNull<double>, restitution, "e as measured", "1"),
      (OrNull<double>, residual, "distance from the prediction of the other points, in standard "
       "deviations", "1")) };

  struct AnswerForAll { RECOIL_RESULT(
      (Verdict, verdict, "as `verdict`"),
      (Strings, named, "as `named`"),
      (Strings, rivals, "as `rivals`"),
      (Strings, resembles, "as `resembles`")) };

  struct FoundParameter { RECOIL_RESULT(
      (OrNull<double>, value, "fitted value", "its unit"),
      (OrNull<double>, sd, "standard error that is compared with limits; null if there is none",
       "its unit"),
      (std::string, unit, "unit of the parameter"),
      (OrNull<double>, null_value, "value at which the mechanism vanishes", "its unit"),
      (OrNull<Condition>, stated_by, "the condition that states the value"),
      (bool, plausible, "whether this value is possible")) };

  struct Separable { RECOIL_RESULT(
      (std::string, rival, "the possible cause that is hardest to tell from it"),
      (double, lambda, "least chi-square of this rival on points of the cause without noise", "1"),
      (double, probability, "probability that such points would name the cause", "1")) };

  struct Candidate { RECOIL_RESULT(
      (std::string, id, "the mechanism, or two joined by +"),
      (MechanismKind, kind, "kind of the mechanism"),
      (Named<FoundParameter>, parameters, "its parameters"),
      (OrNull<double>, p_value, "p-value of its gain, compared with the best of all candidates on "
       "data simulated with the base model", "1"),
      (OrNull<double>, delta_aicc, "AICc minus that of the base model: negative is better", "1"),
      (OrNull<double>, remaining_p, "p-value of the structure that it leaves", "1"),
      (OrNull<double>, remaining_part, "share of the misfit that it leaves", "1"),
      (OrNull<double>, held_out_gain, "relative gain in rms error on held-out points; null for a "
       "cause that is set aside already, or fits less well than the best one by more than 4", "1"),
      (OrNull<double>, held_out_log_score, "gain in log score on held-out points", "1"),
      (bool, plausible, "whether its values are possible"),
      (double, cost_of_possible, "increase of `delta_aicc` if the values are kept within their "
       "limits; computed if one is beyond its limit by less than its error, else 0", "1"),
      (OrNull<std::string>, aside, "why it is no explanation; null if it is one"),
      (OrNull<Separable>, separation, "for the first possible causes: how well points like these "
       "tell it from its nearest rival, if it is the cause and laws are exact"),
      (OrNull<Separable>, separation_allowed, "the same if the law of a mechanism errs by 10 % and "
       "the base model by 3 %")) };

  struct FoldEntry { RECOIL_RESULT(
      (FoldKind, kind, "what is held out"),
      (std::string, name, "which size, target or range of velocities"),
      (std::size_t, points, "number of held-out points"),
      (OrNull<double>, rmse_base, "root mean square of e - e_base", "1"),
      (OrNull<double>, rmse_extended, "root mean square of e - e_extended", "1"),
      (OrNull<double>, log_score, "gain in log score", "1"),
      (bool, counted, "whether it counts in the gain"),
      (bool, chosen, "whether the other points choose the extended model; if not, both predictions "
       "are those of the base model")) };

  struct Gain { RECOIL_RESULT(
      (OrNull<double>, held_out_rmse_base, "root mean square of e - e_base", "1"),
      (OrNull<double>, held_out_rmse_extended, "root mean square of e - e_extended", "1"),
      (OrNull<double>, relative, "relative gain", "1"),
      (OrNull<Ends>, interval, "its interval", "1"),
      (OrNull<double>, log_score, "gain in log score", "1"),
      (std::vector<FoldEntry>, folds, "the groups of held-out points")) };

  struct FittedParameter { RECOIL_RESULT(
      (OrNull<double>, value, "estimate", "its unit"),
      (std::string, unit, "unit of the parameter"),
      (bool, free, "whether it was fitted"),
      (OrNull<double>, std_error, "standard error", "its unit"),
      (OrAbsent<OrNull<Ends>>, interval, "recommended interval", "its unit")) };

  struct Fit { RECOIL_RESULT(
      (Named<FittedParameter>, parameters, "parameters by name"),
      (OrNull<double>, chi2, "sum of the squared weighted residuals", "1"),
      (int, dof, "degrees of freedom", "", R"({"minimum": null})"),
      (OrNull<double>, rmse, "root mean square of e - e_model", "1")) };

  struct Capture { RECOIL_RESULT(
      (std::string, dataset, "dataset"),
      (double, diameter_um, "diameter", "um"),
      (OrNull<double>, base, "capture velocity in the base model", "m/s"),
      (OrNull<double>, extended, "capture velocity in the extended model", "m/s")) };

  using Pair = std::array<std::string, 2>;

  struct Experiment { RECOIL_RESULT(
      (ExperimentKind, kind, "more impacts, or impacts after a change"),
      (OrAbsent<Condition>, condition, "for a change: what to change"),
      (OrAbsent<double>, value, "for a change: its new value", "SI"),
      (OrAbsent<std::string>, doing, "for a change: how to do it in a laboratory"),
      (std::string, dataset, "dataset"),
      (std::string, series, "series with the most similar impacts"),
      (double, diameter_um, "diameter", "um"),
      (double, incident_velocity, "incident velocity", "m/s"),
      (int, events, "number of impacts that gives expected odds of 99 to 1 between the two causes, "
       "whichever is right, as far as their parameters and laws are known"),
      (bool, expensive, "whether it takes more than 2,000 impacts"),
      (Pair, separates, "the two causes; law_error: an error of the base model's laws"),
      (OrNull<double>, expected_difference, "expected difference of their e", "1"),
      (OrNull<double>, expected_log_odds, "expected ln of the odds for the right one, averaged over "
       "which of the two it is", "1"),
      (OrNull<double>, worst_log_odds, "the same for the less favourable of the two", "1")) };

  struct Inseparable { RECOIL_RESULT(
      (Pair, rivals, "two causes"),
      (OrNull<double>, largest_difference, "largest difference of their e within reach", "1")) };

  struct Expected { RECOIL_RESULT(
      (std::string, id, "the mechanism"),
      (std::string, dataset, "dataset"),
      (Condition, condition, "the condition that fixes it"),
      (OrNull<double>, value, "stated value of the condition", "SI"),
      (double, diameter_um, "diameter of the point with the largest effect", "um"),
      (double, incident_velocity, "incident velocity of this point", "m/s"),
      (OrNull<double>, change, "change of e at this point", "1")) };

  struct Unstated { RECOIL_RESULT(
      (UnstatedSource, id, "the error"),
      (OrNull<double>, value, "its size: `velocity_errors` relative, `larger_deviations` a factor, "
       "`shared_setting` of e, `height_readings` in m, `time_readings` in s", "SI"),
      (OrNull<double>, delta_aicc, "AICc minus that of the base model", "1"),
      (OrNull<double>, remaining_p, "p-value of the structure that it leaves", "1"),
      (bool, leave_nothing, "whether it leaves no structure"),
      (bool, rival, "whether it explains the data instead of the answer, or as well")) };

  struct Settings { RECOIL_RESULT(
      (double, level, "level of the test for structure", "1"),
      (double, chance, "level of a candidate's p-value", "1"),
      (double, apart, "least difference of AICc from the next cause", "1"),
      (double, apart_in_pairs, "the same for two causes at once", "1"),
      (int, compared, "number of simulated data sets that calibrate a candidate's p-value"),
      (std::uint64_t, seed, "seed")) };

  struct Exact { RECOIL_RESULT(
      (double, p_value, "p-value of the structure that the model would leave", "1"),
      (Strings, named, "the cause that would be named, if one would"),
      (Strings, listed, "causes that would fit best, if `p_value` is at most `settings.level`")) };

  struct DetectionEntry { RECOIL_RESULT(
      (std::string, id, "the cause"),
      (double, strength, "1: the effect as found; 0.5: half of it", "1"),
      (int, datasets, "number of simulated data sets", "", at_least_one),
      (int, named, "number of these in which it alone is named"),
      (int, listed, "number of these in which it is listed among others"),
      (int, wrong, "number of these in which another cause is named")) };

  struct FalseAlarms { RECOIL_RESULT(
      (int, datasets, "number of data sets that the base model simulated", "", at_least_one),
      (double, share, "share of these in which a cause is named", "1")) };

  struct OwnDesignEntry { RECOIL_RESULT(
      (std::vector<DetectionEntry>, detection, "every cause that is named or listed"),
      (FalseAlarms, false_alarms, "false alarms")) };

  RECOIL_RESULT(
    (FormatVersion, format_version, about_format_version),
    (std::string, fit, "name of the fit file without ending"),
    (std::vector<Data>, datasets, "each dataset"),
    (std::vector<RestitutionMeanEntry>, restitution_summary, about_restitution_summary),
    (std::vector<RestitutionRangeEntry>, restitution_range, about_restitution_range),
    (VelocityDependenceEntry, velocity_dependence, about_velocity_dependence),
    (SeriesDifferEntry, series_differ, about_series_differ),
    (OrNull<FitFile::ModelVerdictFound>, model_verdict, "whether the model describes the points: the same as "
     "in fit.json"),
    (Verdict, verdict, "what the diagnosis found: `adequate` (no structure in the residuals, or an "
     "error of the laws explains it better than any cause), `cause_named`, `not_separable` or `unexplained`"),
    (std::string, headline, "the verdict on the model and the cause, in one line"),
    (std::string, text, "the answer in one paragraph"),
    (Misfit, misfit, "what the base model leaves"),
    (std::vector<Outlying>, outlying_points, "points that were set aside"),
    (OrNull<AnswerForAll>, with_outlying_points, "the answer with these points; null if there are "
     "none"),
    (OrNull<double>, law_error, "allowed relative error of the laws of mechanisms; null: averaged "
     "over", "1"),
    (OrNull<Exact>, if_exact, "the answer for exact laws and single causes; null if a cause is named "
     "without them"),
    (Strings, named, "ids of the named mechanisms; two if both act at once"),
    (Strings, rivals, "ids that the data cannot distinguish from the named one; `law_error` if an "
     "error of the laws explains as much as they do; for an adequate model `materials_within_errors`, if exact materials would leave structure"),
    (Strings, resembles, "ids of the mechanisms that fit best but are impossible, or cannot be "
     "distinguished from an unknown law of size; then no cause is named"),
    (Strings, in_every_explanation, "if two causes act at once: those in every explanation"),
    (OrNull<std::string>, shared_cause, "the common cause, if all listed ones are laws of it"),
    (std::vector<Candidate>, candidates, "every single cause"),
    (std::vector<Candidate>, pairs, "the 20 best combinations of two causes"),
    (OrNull<Gain>, gain, "gain of the extended model on held-out points"),
    (Fit, base, "fit of the base model"),
    (OrNull<Fit>, extended, "fit of the extended model"),
    (std::vector<Capture>, capture_velocity, "capture velocities in both models"),
    (std::vector<Experiment>, next_experiment, "recommended experiments, the best first: the least "
     "effort for the probability that one of its two causes acts"),
    (std::vector<Inseparable>, inseparable, "causes that no experiment in reach separates: their e "
     "differs by less than the errors of their parameters and laws"),
    (std::vector<Expected>, expected_effects, "effects that the stated conditions fix completely"),
    (std::vector<Unstated>, unstated_errors, "errors that may explain the misfit without a cause"),
    (OrAbsent<OwnDesignEntry>, own_design, "with `--rates`: what these points could have shown"),
    (Settings, settings, "limits of the diagnosis"),
    (Strings, warnings, "warnings"),
    (Strings, remarks, "remarks; for a reconstruction, the effects that its recipe put there")) };

// clang-format on

}  // namespace recoil
