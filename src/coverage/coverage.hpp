#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/json.hpp"
#include "core/names.hpp"
#include "data/dataset.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// How often one kind of interval of one parameter contained the truth.
struct CoverageCell {
  std::string interval;          ///< "wald", "profile", ..., "recommended"
  int offered = 0;               ///< data sets in which there was such an interval
  int held = 0;                  ///< of those, how many contained the truth
  int offered_identifiable = 0;  ///< the same where the verdict called it identifiable
  int held_identifiable = 0;
  double median_width = 0.0;  ///< [parameter's unit]
  RECOIL_FIELDS(interval, offered, held, offered_identifiable, held_identifiable, median_width)
};

struct CoverageRow {
  std::string parameter;  ///< slot label, or "V*(d)" of a capture velocity
  std::string unit;
  double truth = 0.0;
  int identifiable = 0;  ///< data sets in which the verdict called the parameter identifiable
  /// Of the estimate over its scale, as the verdict on it counts it: the distance from the truth
  /// that 68.27 % of the data sets keep [1].
  double actual_error = 0.0;
  std::vector<CoverageCell> cells;
  RECOIL_FIELDS(parameter, unit, truth, identifiable, actual_error, cells)
};

/// Where the true parameters, and with them the simulated data, come from.
enum class TruthOrigin {
  recipe,   ///< the recipe of a reconstruction: its parameters, simulator and noise
  estimate  ///< the fit's own estimate, simulated independently of the fitter
};
template <>
struct NamesOf<TruthOrigin> {
  static constexpr std::array<std::string_view, 2> names = {"recipe", "estimate"};
};

struct CoverageResult {
  int datasets = 0;
  int failed = 0;         ///< data sets whose fit gave no answer
  int refits_failed = 0;  ///< bootstrap refits that failed, over all data sets
  TruthOrigin truth_origin = TruthOrigin::estimate;
  std::vector<CoverageRow> rows;
  RECOIL_FIELDS(datasets, failed, refits_failed, truth_origin, rows)
};

struct CoverageOptions {
  int datasets = 100;
  UncertaintyOptions uncertainty;
};

/// What the study is about: true parameters, true capture velocities and a source of data sets.
struct CoverageTruth {
  struct Capture {
    double diameter = 0.0;  ///< [m]
    double velocity = 0.0;  ///< V* [m/s]
  };
  struct At {
    std::vector<double> theta;     ///< [slots]
    std::vector<Capture> capture;  ///< in the order of `capture_estimates`
  };
  TruthOrigin origin = TruthOrigin::estimate;
  std::vector<double> theta;     ///< [slots]; the constants of the materials as stated
  std::vector<Capture> capture;  ///< in the order of `capture_estimates`
  /// Where constants of the materials are uncertain every simulation has a truth of its own, drawn
  /// from their errors: that of simulation number `index`. Empty: all have the one above.
  std::function<At(std::uint64_t index)> at;
  /// The data sets of simulation number `index`; called from any thread.
  std::function<std::vector<Dataset>(std::uint64_t index)> simulate;
};

/// What one simulated data set says about the intervals.
struct CoverageTrial {
  /// One kind of interval of one parameter.
  struct Cell {
    bool held = false;
    double width = 0.0;  ///< [parameter's unit]
    RECOIL_FIELDS(held, width)
  };
  struct Row {
    bool identifiable = false;
    double deviation = 0.0;                  ///< of the estimate from the truth over its scale [1]
    std::vector<std::optional<Cell>> cells;  ///< [kinds]; none: no such interval
    RECOIL_FIELDS(identifiable, deviation, cells)
  };
  bool usable = false;  ///< else its fit gave no answer, or the scheme cannot draw from its points,
                        ///< and the rest is empty
  int refits_failed = 0;
  std::vector<Row> parameters;  ///< those that are free
  std::vector<Row> capture;     ///< in the order of `capture_estimates`
  RECOIL_FIELDS(usable, refits_failed, parameters, capture)
};

/// Simulation number `index`, fitted as a user would: a pure function of it.
CoverageTrial run_coverage_trial(const FitSpec& spec, const CoverageTruth& truth,
                                 const CoverageOptions& options, std::uint64_t index);

/// What comes of `options.datasets` trials, all of which are there.
CoverageResult count_coverage(const FitSpec& spec, const CoverageTruth& truth,
                              const CoverageOptions& options,
                              const std::vector<CoverageTrial>& trials);

/// What the trials begin with, to the last digit: parts with other digits here are no parts of one
/// study.
std::string digits_of(const CoverageTruth& truth);

/// Fits every simulated data set as a user would and counts how often each interval of each free
/// parameter contains the truth. Deterministic in (seed, number of data sets).
CoverageResult measure_coverage(const FitSpec& spec, const CoverageTruth& truth,
                                const CoverageOptions& options);

/// How often the interval of one quantity contains the truth in data sets like that of the fit.
struct OwnCoverage {
  std::string quantity;  ///< slot label, or "V*(d)" of a capture velocity
  std::string method;    ///< the kind of interval
  int datasets = 0;      ///< simulated ones that have such an interval
  int held = 0;          ///< of those, how many intervals contain the truth

  double share() const { return static_cast<double>(held) / datasets; }
};

/// How many data sets `own_design_coverage` simulates: those that the fit file asks for; by default
/// 200 where `replicates` are asked for, the model is not rejected by the points, and the cost by
/// the number of points and of fits that each data set takes is less than 10 s of one core. No
/// clock decides.
int own_design_datasets(const FitSpec& spec, const FitResult& fitted, int replicates);

/// Simulates the estimate `datasets` times by `coverage_truth`, with the fit's own points, noise
/// and captures, and counts the intervals that are quoted. Where that is one of the bootstrap the
/// interval without replicates stands for it: profile, or Wald without one; delta of V*.
/// @param sets [slots], and `captures`: of the fit
std::vector<OwnCoverage> own_design_coverage(const FitSpec& spec, const FitResult& fitted,
                                             const std::vector<Dataset>& data,
                                             const std::vector<IntervalSet>& sets,
                                             const std::vector<CaptureEstimate>& captures,
                                             const UncertaintyOptions& options, int datasets);

}  // namespace recoil
