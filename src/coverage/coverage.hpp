#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/names.hpp"
#include "data/dataset.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/capture_estimate.hpp"
#include "uncertainty/interval.hpp"
#include "uncertainty/uncertainty_options.hpp"

namespace recoil {

/// The coverage of one kind of interval of one parameter.
struct CoverageCell {
  std::string interval;  ///< "wald", "profile", ..., "recommended"
  int offered = 0;       ///< number of data sets with such an interval
  int held = 0;          ///< number of these in which it contained the truth
  /// The same for data sets in which the parameter was called identifiable.
  int offered_identifiable = 0;
  int held_identifiable = 0;
  double median_width = 0.0;  ///< [parameter's unit]
  RECOIL_FIELDS(interval, offered, held, offered_identifiable, held_identifiable, median_width)
};

struct CoverageRow {
  std::string parameter;  ///< slot label, or "V*(d)" of a capture velocity
  std::string unit;
  double truth = 0.0;
  int identifiable = 0;  ///< number of data sets in which the parameter was called identifiable
  /// The 68.27 % quantile of the deviation of the estimate from the truth, over the scale that the
  /// verdict uses [1].
  double actual_error = 0.0;
  std::vector<CoverageCell> cells;
  RECOIL_FIELDS(parameter, unit, truth, identifiable, actual_error, cells)
};

/// The origin of the true parameters and of the simulated data.
enum class TruthOrigin {
  recipe,    ///< the recipe of a reconstruction: its parameters, simulator and noise
  estimate,  ///< the fit's own estimate, simulated independently of the fitter
  posterior  ///< draws of the posterior, see PosteriorStudy
};
constexpr auto names_of_values(TruthOrigin) { return name_list("recipe", "estimate", "posterior"); }

struct CoverageResult {
  int datasets = 0;
  int failed = 0;         ///< number of data sets whose fit failed
  int refits_failed = 0;  ///< number of failed bootstrap refits over all data sets
  TruthOrigin truth_origin = TruthOrigin::estimate;
  std::vector<CoverageRow> rows;  ///< free parameters, then capture velocities
  RECOIL_FIELDS(datasets, failed, refits_failed, truth_origin, rows)
};

struct CoverageOptions {
  int datasets = 100;
  UncertaintyOptions uncertainty;
};

/// The truth of a coverage study: true parameters, true capture velocities and a simulator of data
/// sets.
struct CoverageTruth {
  struct Capture {
    double diameter = 0.0;  ///< [m]
    double velocity = 0.0;  ///< V* [m/s]; 0 without adhesion

    /// Without adhesion there is no capture velocity to estimate.
    bool captures() const { return velocity > 0.0; }
  };
  struct At {
    std::vector<double> theta;     ///< [slots]
    std::vector<Capture> capture;  ///< in the order of `capture_estimates`
  };
  TruthOrigin origin = TruthOrigin::estimate;
  std::vector<double> theta;     ///< [slots]; material constants at their stated values
  std::vector<Capture> capture;  ///< in the order of `capture_estimates`
  /// The truth of simulation number `index`, with material constants drawn from their errors, if
  /// constants are uncertain. Empty: all simulations have the truth above.
  std::function<At(std::uint64_t index)> at;
  /// The data sets of simulation number `index`. Thread-safe.
  std::function<std::vector<Dataset>(std::uint64_t index)> simulate;
};

/// The intervals of one simulated data set, compared with the truth.
struct CoverageTrial {
  /// One kind of interval of one parameter.
  struct Cell {
    bool held = false;
    double width = 0.0;  ///< [parameter's unit]
    RECOIL_FIELDS(held, width)
  };
  struct Row {
    bool identifiable = false;
    double deviation = 0.0;  ///< deviation of the estimate from the truth over its scale [1]
    std::vector<std::optional<Cell>> cells;  ///< [kinds]; nullopt: no such interval
    RECOIL_FIELDS(identifiable, deviation, cells)
  };
  bool usable = false;  ///< false: its fit failed, or the scheme cannot be used on its points; the
                        ///< other members are then empty
  int refits_failed = 0;
  std::vector<Row> parameters;  ///< the free parameters
  std::vector<Row> capture;     ///< in the order of `capture_estimates`
  RECOIL_FIELDS(usable, refits_failed, parameters, capture)
};

/// Simulates and fits data set number `index` as a user would; a pure function of `index`.
CoverageTrial run_coverage_trial(const FitSpec& spec, const CoverageTruth& truth,
                                 const CoverageOptions& options, std::uint64_t index);

/// The result of `options.datasets` finished trials.
CoverageResult count_coverage(const FitSpec& spec, const CoverageTruth& truth,
                              const CoverageOptions& options,
                              const std::vector<CoverageTrial>& trials);

/// The numbers on which the trials depend, with all digits: parts of a study can be merged only if
/// these agree.
std::string digits_of(const CoverageTruth& truth);

/// Fits every simulated data set as a user would and counts how often each interval of each free
/// parameter contains the truth. Deterministic in (seed, number of data sets).
CoverageResult measure_coverage(const FitSpec& spec, const CoverageTruth& truth,
                                const CoverageOptions& options);

/// The coverage of the interval of one quantity in simulated data sets like that of the fit.
struct OwnCoverage {
  std::string quantity;  ///< slot label, or "V*(d)" of a capture velocity
  std::string method;    ///< the kind of interval
  int datasets = 0;      ///< number of simulated data sets with such an interval
  int held = 0;          ///< number of these intervals that contain the truth

  double share() const { return static_cast<double>(held) / datasets; }
};

/// The number of data sets of `own_design_coverage`: that of the fit file; by default 200 if
/// `replicates` > 0, if the points do not reject the model and if the estimated cost is below 10 s
/// on one core. The estimate uses the number of points and the kind of fit, no clock. 0 if the
/// noise is unknown or in doubt (`noise_doubts`): then a simulation says nothing about the
/// intervals.
int own_design_datasets(const FitSpec& spec, const FitResult& fitted, int replicates);

/// Simulates the estimate `datasets` times by `coverage_truth`, with the fit's own points, noise
/// and captures, and counts the quoted intervals that contain the truth. A quoted bootstrap
/// interval is replaced by one without replicates: profile, or else Wald; delta for V*.
/// @param sets intervals of the fit [slots]
/// @param captures capture velocities of the fit
std::vector<OwnCoverage> own_design_coverage(const FitSpec& spec, const FitResult& fitted,
                                             const std::vector<Dataset>& data,
                                             const std::vector<IntervalSet>& sets,
                                             const std::vector<CaptureEstimate>& captures,
                                             const UncertaintyOptions& options, int datasets);

}  // namespace recoil
