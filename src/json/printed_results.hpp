#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coverage/coverage.hpp"
#include "coverage/posterior_check.hpp"
#include "json/fit_file.hpp"
#include "plan/experiment_plan.hpp"
#include "predict/polydisperse.hpp"

/// The results that commands print with --json and that no other command reads. SI units unless the
/// name of a member says otherwise.
namespace recoil {

// One member per line.
// clang-format off

/// `recoil coverage`.
struct CoverageFile {
  struct Data { RECOIL_RESULT(
      (std::string, id, "name of the dataset"),
      (Provenance, provenance, "origin of the data"),
      (std::string, sha256, "SHA-256 of datapackage.json and the points", "", sha256_schema)) };

  struct Share { RECOIL_RESULT(
      (int, held, "number of intervals that contain the truth"),
      (int, offered, "number of data sets with such an interval"),
      (OrNull<double>, share, "their quotient", "1"),
      (OrNull<Ends>, limits, "95 % limits of the share (Wilson)", "1")) };

  struct Cell { RECOIL_RESULT(
      (int, held, "number of intervals that contain the truth"),
      (int, offered, "number of data sets with such an interval"),
      (OrNull<double>, share, "their quotient", "1"),
      (OrNull<Ends>, limits, "95 % limits of the share (Wilson)", "1"),
      (Share, where_identifiable, "the same where the parameter is called identifiable"),
      (OrNull<double>, median_width, "median width of the intervals", "its unit")) };

  struct Row { RECOIL_RESULT(
      (std::string, parameter, "a parameter, or V*(diameter)"),
      (std::string, unit, "its unit"),
      (OrNull<double>, truth, "true value", "its unit"),
      (int, identifiable, "number of data sets in which it is called identifiable"),
      (double, actual_error, "distance of the estimate from the truth that 68.27 % of the data "
       "sets keep, over the scale of the verdict", "1"),
      (Named<Cell>, intervals, "by kind of interval")) };

  struct Ranked { RECOIL_RESULT(
      (OrNull<double>, p_value, "probability that uniform ranks are as uneven anywhere", "1"),
      (OrNull<double>, error_ratio, "standard deviation of the truth about the posterior, over that "
       "of the posterior; above 1 its intervals are too narrow", "1"),
      (OrNull<Ends>, error_ratio_limits, "95 % limits of this ratio", "1"),
      (OrNull<double>, shift, "mean of truth minus posterior, in standard deviations", "1"),
      (OrNull<double>, shift_sd, "its standard error", "1"),
      (int, held, "number of central 90 % intervals of the posterior that contain the truth")) };

  struct PosteriorSbc { RECOIL_RESULT(
      (std::string, text, "the verdict in words"),
      (PosteriorVerdict, verdict, "can the posterior be believed"),
      (NoVerdict, because, "why there is no verdict"),
      (int, sets, "number of data sets with ranks"),
      (double, p_value, "smallest of the parameters times their number, at most 1", "1"),
      (Named<Ranked>, parameters, "ranks of every free parameter")) };

  RECOIL_RESULT(
    (FormatVersion, format_version, about_format_version),
    (std::string, recoil_version, about_recoil_version),
    (FitFile::Source, fit, "the fit file"),
    (std::vector<Data>, datasets, "each dataset"),
    (int, simulated, "number of simulated data sets"),
    (TruthOrigin, truth, "origin of the true parameters"),
    (double, level, "level of the intervals", "1"),
    (Json, replicates, "bootstrap replicates of every data set", "", number_or_auto),
    (std::uint64_t, seed, "seed of all random numbers"),
    (int, failed, "number of data sets whose fit, or posterior, failed"),
    (int, refits_failed, "number of failed bootstrap refits"),
    (std::vector<Row>, rows, "every free parameter and capture velocity; empty with --posterior"),
    (OrAbsent<PosteriorSbc>, posterior, "with --posterior: posterior SBC")) };

/// `recoil simulate`.
struct SimulationFile {
  struct Parameter { RECOIL_RESULT(
      (OrNull<double>, value, "value", "its unit"),
      (std::string, unit, "unit of the parameter")) };

  struct Part { RECOIL_RESULT(
      (std::string, id, "the mechanism"),
      (OrNull<double>, on_the_way_in, "energy that it takes before the contact", "J"),
      (OrNull<double>, on_the_way_out, "energy that it takes after the contact", "J")) };

  struct WholeImpact { RECOIL_RESULT(
      (OrNull<double>, incident, "incident kinetic energy", "J"),
      (std::vector<Part>, mechanisms, "energy that every mechanism takes; below zero: gives"),
      (OrNull<double>, contact, "energy that the impact of the base model takes", "J"),
      (OrNull<double>, rebound, "energy of the rebound; below zero: what a captured sphere lacks",
       "J")) };

  struct Energy { RECOIL_RESULT(
      (OrNull<double>, incident, "incident kinetic energy", "J"),
      (OrNull<double>, rebound, "kinetic energy of the rebound", "J"),
      (OrNull<double>, hertz_damping, "dissipated by C_H", "J"),
      (OrNull<double>, adhesion_damping, "dissipated by C_A", "J"),
      (OrNull<double>, dashpot, "dissipated by a dashpot", "J"),
      (OrNull<double>, jumps, "lost in the jumps into and out of contact", "J"),
      (OrNull<double>, still_bound, "what a captured sphere still has", "J")) };

  struct Contact { RECOIL_RESULT(
      (double, incident_velocity, "incident velocity at the contact", "m/s"),
      (double, diameter_um, "diameter", "um"),
      (OrNull<double>, restitution, "e of the contact; 0 for a capture", "1"),
      (std::string, outcome, "outcome of the contact", "", rebound_or_captured),
      (OrNull<double>, stiffness_K_Pa, "stiffness K", "Pa"),
      (OrNull<double>, f0_N_per_m, "f0 at this diameter", "N/m"),
      (OrNull<double>, density_kg_per_m3, "density of the sphere", "kg/m3"),
      (OrNull<double>, contact_time_s, "contact time; null if the contact yields", "s"),
      (OrNull<double>, penetration_m, "largest penetration; null if the contact yields", "m"),
      (OrNull<double>, largest_push_N, "largest repulsion; null if the contact yields", "N"),
      (OrNull<double>, largest_pull_N, "largest attraction", "N"),
      (Energy, energy_J, "where the incident energy went")) };

  struct Limit { RECOIL_RESULT(
      (ValidityQuantity, quantity, "what is compared with its limit"),
      (OrNull<double>, value, "its value", "1"),
      (double, limit, "the largest or the least value at which the model holds", "1"),
      (std::string, limit_is, "whether the limit is the largest or the least valid value", "",
       largest_or_least),
      (bool, exceeded, "true: the value is beyond the limit, and the model does not hold"),
      (std::string, text, "the check in words")) };

  using Column = std::vector<OrNull<double>>;

  struct History { RECOIL_RESULT(
      (Column, time_ns, "time", "ns"),
      (Column, penetration_nm, "penetration", "nm"),
      (Column, approach_velocity_m_s, "velocity towards the surface", "m/s"),
      (Column, hertz_force_uN, "elastic force", "uN"),
      (Column, hertz_damping_force_uN, "force of C_H", "uN"),
      (Column, adhesion_force_uN, "adhesion force", "uN"),
      (Column, adhesion_damping_force_uN, "force of C_A", "uN"),
      (OrAbsent<Column>, dashpot_force_uN, "force of a dashpot", "uN")) };

  RECOIL_RESULT(
    (FormatVersion, format_version, about_format_version),
    (std::string, recoil_version, about_recoil_version),
    (std::string, fit, "name of the fit file without ending"),
    (DatasetReference, dataset, "the dataset"),
    (std::string, values_from, "origin of the parameters: a fit.json, or words"),
    (Named<Parameter>, parameters, "by name"),
    (double, incident_velocity, "incident velocity", "m/s"),
    (double, diameter_um, "diameter", "um"),
    (OrNull<double>, restitution, "e, rebound over incident velocity; 0 for a capture", "1"),
    (OrNull<double>, restitution_squared, "e²; below zero for a capture: 2 H / (m V²), with H the "
     "mechanical energy that is left", "1"),
    (std::string, outcome, "outcome of the impact", "", rebound_or_captured),
    (OrNull<double>, rebound_velocity, "rebound velocity", "m/s"),
    (OrAbsent<WholeImpact>, whole_impact_J, "with mechanisms: where the kinetic energy went"),
    (Contact, contact, "the impact of the base model, as the mechanisms leave the sphere there"),
    (std::vector<Limit>, validity, "limits of validity of the model"),
    (History, history, "forces against time; positive forces push the sphere away")) };

/// `recoil predict`.
struct PredictionFile {
  struct Bin { RECOIL_RESULT(
      (double, diameter_um, "mid-point", "um"),
      (double, width_um, "width", "um"),
      (double, weight, "weight", "1")) };

  struct Sizes { RECOIL_RESULT(
      (std::string, file, "file of the sizes"),
      (std::string, provenance, "origin of the sizes"),
      (std::string, description, "the sizes in words"),
      (std::string, sha256, "SHA-256 of the file", "", sha256_schema),
      (OrNull<double>, d10_um, "mean diameter d10", "um"),
      (std::size_t, simulated, "number of simulated sizes"),
      (std::vector<Bin>, bins, "the bins")) };

  struct Miss { RECOIL_RESULT(
      (OrNull<double>, rmse, "root mean square of e - e_predicted at the points", "1"),
      (std::size_t, points, "number of points with a prediction")) };

  struct Convention { RECOIL_RESULT(
      (std::string, means, "the convention in words"),
      (Miss, miss, "deviation of the points")) };

  struct Conventions { RECOIL_RESULT(
      (Convention, captured_as_zero, "a captured sphere has e = 0"),
      (Convention, captured_left_out, "the mean is over the spheres that rebound"),
      (Convention, unseen_left_out, "the mean is over the spheres that reach the plane again")) };

  struct OneSize { RECOIL_RESULT(
      (Miss, miss, "deviation of the points")) };

  struct SizeCurve { RECOIL_RESULT(
      (std::string, name, "which size", "", R"({"enum": ["smallest", "d10", "largest"]})"),
      (double, diameter_um, "diameter", "um"),
      (OrNull<double>, capture_velocity, "capture velocity", "m/s"),
      (std::vector<OrNull<double>>, restitution, "e at the velocities of `curve`", "1")) };

  struct Banded { RECOIL_RESULT(
      (OrNull<double>, value, "value of the fit", "1"),
      (OrNull<Ends>, band, "its pointwise band", "1")) };

  struct CurvePoint { RECOIL_RESULT(
      (double, incident_velocity, "incident velocity", "m/s"),
      (Banded, captured_as_zero, "mean e, captured spheres with e = 0"),
      (Banded, captured_left_out, "mean e of the spheres that rebound"),
      (Banded, unseen_left_out, "mean e of the spheres that reach the plane again"),
      (Banded, captured_fraction, "fraction of captured spheres"),
      (Banded, unseen_fraction, "fraction that does not reach the plane again")) };

  RECOIL_RESULT(
    (FormatVersion, format_version, about_format_version),
    (std::string, recoil, about_recoil_version),
    (std::string, fit, "name of the fit file without ending"),
    (DatasetReference, dataset, "the dataset"),
    (Sizes, sizes, "the mixture"),
    (double, probe_height_m, "height of the measuring plane", "m"),
    (double, slowest_seen_m_s, "slowest rebound that reaches the plane", "m/s"),
    (double, level, "level of the bands", "1"),
    (std::size_t, replicates, "number of bootstrap replicates for the bands"),
    (std::uint64_t, seed, "seed of all random numbers"),
    (Conventions, conventions, "ways to average with captured spheres"),
    (OneSize, d10_alone, "spheres of the mean diameter alone"),
    (std::vector<SizeCurve>, size_curves, "e(V) of single sizes"),
    (std::vector<CurvePoint>, curve, "averages of the mixture")) };

/// `recoil compare`.
struct ComparisonFile {
  struct Fit { RECOIL_RESULT(
      (std::string, id, "name of the fit file without ending"),
      (AdhesionLaw, adhesion, "law of adhesion"),
      (Strings, mechanisms, "ids of the mechanisms"),
      (int, free_parameters, "number of free parameters"),
      (int, points, "number of points"),
      (OrNull<double>, chi2, "sum of the squared weighted residuals", "1"),
      (OrNull<double>, aicc, "Akaike's criterion; null if no standard deviations are stated", "1"),
      (OrNull<double>, aicc_above_best, "AICc minus the least AICc", "1"),
      (OrNull<double>, rmse, "root mean square of e - e_model", "1"),
      (OrNull<double>, held_out_rmse, "the same at held-out diameters", "1"),
      (OrNull<LawErrorFound>, law_error, "how wrong the laws are; null: taken as exact")) };

  struct Value { RECOIL_RESULT(
      (OrNull<double>, value, "estimate", "its unit"),
      (bool, free, "whether it was fitted"),
      (OrNull<Ends>, interval, "recommended interval", "its unit")) };

  struct Quantity { RECOIL_RESULT(
      (std::string, name, "a parameter, or V* at a diameter"),
      (std::string, unit, "its unit"),
      (std::vector<OrNull<Value>>, fits, "in the order of `fits`; null: the fit has none"),
      (OrNull<bool>, depends_on_choice, "whether the intervals do not overlap; null for fewer than "
       "two")) };

  RECOIL_RESULT(
    (FormatVersion, format_version, about_format_version),
    (std::string, recoil_version, about_recoil_version),
    (Strings, data, "id and SHA-256 of every dataset"),
    (std::vector<Fit>, fits, "the fits"),
    (std::vector<Quantity>, quantities, "parameters, then capture velocities")) };

/// `recoil pair`.
struct PairingFile {
  struct Passages { RECOIL_RESULT(
      (std::string, file, "file of the passages"),
      (std::size_t, rows, "rows below the header"),
      (std::size_t, passages, "passages that were read"),
      (std::size_t, damaged, "rows left out: missing, non-numeric or impossible cells"),
      (std::size_t, repeated, "rows left out: repetitions of another row"),
      (std::size_t, out_of_order, "rows out of order in time, which were sorted"),
      (Strings, columns_not_used, "names of columns that are not used"),
      (OrNull<Provenance>, provenance, "origin of the data")) };

  struct Plane { RECOIL_RESULT(
      (OrNull<double>, height_m, "height of the measuring plane", "m"),
      (OrNull<double>, height_sd_m, "its standard error; null if it is not refined", "m"),
      (bool, refined, "whether the passages refine the height")) };

  struct Impacts { RECOIL_RESULT(
      (std::size_t, down, "passages towards the surface"),
      (std::size_t, up, "passages away from it"),
      (std::size_t, pairs, "pairs of a passage down and one up"),
      (std::size_t, used, "pairs in use"),
      (std::size_t, later, "second and further impacts of a sphere"),
      (OrNull<double>, purity, "expected share of true pairs", "1"),
      (std::size_t, returns, "rebounds that were detected when they came down again"),
      (OrNull<double>, expected_returns, "such returns by chance", "1")) };

  struct WithoutRebound { RECOIL_RESULT(
      (std::size_t, passages, "passages down without a rebound"),
      (OrNull<double>, lost, "expected number whose rebound was not detected", "1"),
      (OrNull<double>, too_slow, "expected number that did not reach the plane", "1"),
      (std::size_t, captured, "number that is called captured"),
      (OrNull<double>, not_assigned, "number of the others", "1"),
      (OrNull<double>, lost_share, "share of rebounds that are not detected", "1")) };

  struct Point { RECOIL_RESULT(
      (std::string, series, "series, with the size class if there are several"),
      (double, diameter_um, "mean diameter", "um"),
      (double, incident_velocity, "mean incident velocity at the surface", "m/s"),
      (OrNull<double>, velocity_sd, "its standard error", "m/s"),
      (OrNull<double>, restitution, "mean e of the rebounds", "1"),
      (OrNull<double>, restitution_sd, "its standard error", "1"),
      (std::size_t, rebounds, "number of rebounds"),
      (std::size_t, unpaired, "number of passages down without a rebound"),
      (std::size_t, captured, "number of captures"),
      (std::size_t, events, "rebounds and captures")) };

  RECOIL_RESULT(
    (FormatVersion, format_version, about_format_version),
    (std::string, recoil_version, about_recoil_version),
    (Passages, passages, "what was read"),
    (Plane, plane, "the measuring plane"),
    (Impacts, impacts, "the pairs"),
    (WithoutRebound, without_rebound, "the passages down without a rebound"),
    (std::vector<Point>, points, "averages, as `--out` writes them")) };

/// `recoil plan`, and plan.json.
struct PlanFile {
  struct Data { RECOIL_RESULT(
      (std::string, id, "name of the dataset"),
      (std::string, particle, "material of the particle"),
      (std::string, surface, "material of the surface")) };

  struct Parameter { RECOIL_RESULT(
      (OrNull<double>, value, "assumed value", "its unit"),
      (std::string, unit, "unit of the parameter"),
      (bool, free, "whether it is to be fitted")) };

  struct Assumed { RECOIL_RESULT(
      (Named<Parameter>, parameters, "by name"),
      (int, draws, "number of draws about these values for which the plan is made"),
      (Ends, velocities, "slowest and fastest incident velocity", "m/s"),
      (double, scatter, "standard deviation of e of one impact, over e", "1"),
      (double, floor, "the part of it that does not depend on e", "1"),
      (double, spread, "relative sd of the capture velocity from impact to impact", "1")) };

  struct Setting { RECOIL_RESULT(
      (std::string, dataset, "dataset"),
      (double, diameter_um, "diameter", "um"),
      (double, incident_velocity, "incident velocity", "m/s"),
      (int, points, "number of points", "", at_least_one),
      (int, impacts, "number of impacts", "", at_least_one),
      (OrNull<double>, restitution, "expected mean e of the rebounds", "1"),
      (OrNull<double>, restitution_sd, "standard deviation of the mean of all impacts of the "
       "setting; null if hardly any sphere rebounds", "1"),
      (double, captured, "expected captured share of the impacts", "1")) };

  struct Place { RECOIL_RESULT(
      (std::string, dataset, "dataset"),
      (double, diameter_um, "diameter", "um"),
      (double, incident_velocity, "incident velocity", "m/s"),
      (double, share, "share of the impacts", "1")) };

  struct Quantity { RECOIL_RESULT(
      (std::string, kind, "kind of the quantity", "",
       R"({"enum": ["parameter", "capture_velocity"]})"),
      (OrAbsent<std::string>, parameter, "name of a parameter"),
      (OrAbsent<std::string>, dataset, "dataset of a capture velocity"),
      (OrAbsent<double>, diameter_um, "diameter of a capture velocity", "um"),
      (OrNull<double>, value, "assumed value, or what follows from them", "its unit"),
      (std::string, unit, "unit of the value"),
      (OrNull<double>, relative_error, "relative standard error under the plan: the median over "
       "the draws of the parameters", "1"),
      (OrNull<double>, relative_error_worst, "the 95 % quantile over the draws", "1"),
      (OrNull<double>, relative_error_even, "the median for as many points, evenly spaced in ln V",
       "1"),
      (OrNull<double>, impacts, "impacts for the wanted error, in the proportions of the plan; "
       "null: no number is enough", "1"),
      (OrNull<double>, impacts_even, "the same, evenly spaced in ln V", "1"),
      (OrNull<double>, impacts_alone, "the same, if this were the only quantity and the assumed "
       "values were right", "1"),
      (std::vector<Place>, learnt_at, "the best experiment for this quantity alone")) };

  RECOIL_RESULT(
    (FormatVersion, format_version, about_format_version),
    (std::string, recoil_version, about_recoil_version),
    (std::string, fit, "name of the fit file without ending"),
    (std::vector<Data>, datasets, "each dataset", "", R"({"minItems": 1})"),
    (Assumed, assumed, "the assumptions"),
    (double, wanted_error, "wanted relative standard error", "1"),
    (bool, reached, "whether all quantities have the wanted error, in half of the draws"),
    (double, checks, "share of the points that are evenly spaced", "1"),
    (int, points, "number of points"),
    (int, events_per_point, "impacts per point"),
    (int, impacts, "number of impacts"),
    (OrNull<double>, efficiency, "at least: the sum of the relative variances that no plan "
     "undercuts, over that of this plan; geometric mean over the draws", "1"),
    (std::vector<Setting>, settings, "the points to measure"),
    (std::vector<Quantity>, quantities, "what they determine")) };

// clang-format on

}  // namespace recoil
