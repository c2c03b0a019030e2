#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "coverage/coverage.hpp"
#include "data/dataset.hpp"
#include "validation/studies/coverage_grid.hpp"
#include "validation/studies/study.hpp"

namespace recoil {

/// How often one kind of interval of one parameter in one design contained the truth.
struct IntervalCoverage {
  int offered = 0;               ///< data sets in which there was such an interval
  int contained = 0;             ///< of those
  int offered_identifiable = 0;  ///< the same where the verdict called it identifiable
  int contained_identifiable = 0;
  std::optional<double> relative_width = {};  ///< median width over the truth
  RECOIL_FIELDS(offered, contained, offered_identifiable, contained_identifiable, relative_width)

  /// Of the data sets with such an interval; empty where there is none.
  std::optional<double> share() const;
  std::optional<double> share_identifiable() const;
};

/// One row of the study: one parameter in one design.
struct ParameterCoverage {
  std::string design;     ///< "n20 equal stated f0-fixed captures", or the id of a fit
  std::string parameter;  ///< "C_A", "V*(4.9 um)"
  std::string unit;
  std::optional<double> truth;           ///< [unit]
  int usable = 0;                        ///< data sets whose fit gave an answer
  int identifiable = 0;                  ///< of those, where the verdict called it identifiable
  std::optional<double> relative_width;  ///< median width of the recommended interval over truth
  std::optional<double> actual_error;    ///< of the estimate over its scale, see CoverageRow
  Named<IntervalCoverage> intervals;     ///< by kind: "recommended", "profile", ...
  RECOIL_FIELDS(design, parameter, unit, truth, usable, identifiable, relative_width, actual_error,
                intervals)

  const IntervalCoverage* find(std::string_view interval) const;
  /// @pre there is one, as in every row that a study makes
  const IntervalCoverage& recommended() const;
  double share_identifiable() const;  ///< of the usable data sets
  std::string family() const { return parameter.substr(0, parameter.find('(')); }  ///< "V*"
};

/// How a row stands to what a 95 % interval promises, over all data sets.
enum class CoverageVerdict {
  nominal,         ///< within `least_nominal` and `most_nominal`
  nominal_warned,  ///< so, and the verdict warned in most data sets
  warned,          ///< not so, but the verdict warned in most data sets
  too_narrow,
  too_wide
};
constexpr auto names_of_values(CoverageVerdict) {
  return name_list("nominal", "nominal, warned", "warned", "too narrow", "too wide");
}
inline constexpr double least_nominal = 0.93, most_nominal = 0.97;
inline constexpr double least_warned = 0.90;  ///< share of the data sets

CoverageVerdict verdict_of(const ParameterCoverage& row);

/// Do the estimates of a parameter scatter by more than those of an identifiable one may
/// (`widest_error`)? Not asked of a capture velocity, which has no such verdict.
bool scatters_too_much(const ParameterCoverage& row);

/// Is such a parameter called well determined in more than `most_misled` of the data sets?
bool misleads(const ParameterCoverage& row);
inline constexpr double most_misled = 0.05;

/// Many designs, of the grid or of fits.
struct CoverageStudy {
  struct Design {
    std::string id;
    TruthOrigin truth = TruthOrigin::estimate;
    int fits_failed = 0;
    int refits_failed = 0;
    RECOIL_FIELDS(id, truth, fits_failed, refits_failed)
  };
  struct Source {
    std::string id;
    Provenance provenance = Provenance::reconstruction;
    RECOIL_FIELDS(id, provenance)
  };
  StudyStamp stamp;
  OrAbsent<std::string>
      grid_of;  ///< the fit whose system a grid has; else the designs are those of fits
  /// Are the constants of the materials those that are stated, for the truth and for the fits?
  /// Otherwise every data set has its own, drawn from their errors, and the fits know the errors.
  bool exact_materials = false;
  int datasets = 0;  ///< per design
  int replicates = 0;
  std::uint64_t seed = 0;
  double level = 0.0;
  std::vector<Design> designs;
  std::vector<Source> sources;  ///< datasets that the designs are made from
  std::vector<ParameterCoverage> rows;
  RECOIL_FIELDS(grid_of, exact_materials, datasets, replicates, seed, level, designs, sources, rows)
};

/// @throws InputError when `file` is not the JSON of such a study
CoverageStudy read_coverage_study(const std::filesystem::path& file);

/// Measures every design in turn. A finished one is kept as a file in `kept` (unless that is empty)
/// and taken from there by the next run, so that a stopped study goes on.
CoverageStudy measure_grid(const FitSpec& spec, const Dataset& base,
                           const std::vector<GridDesign>& designs, const CoverageOptions& options,
                           const std::filesystem::path& kept);

/// Adds to `study` what `measure` finds of a design, or what is kept of it in `kept` under `key`.
void add_measured(CoverageStudy& study, const std::string& design, const CoverageOptions& options,
                  const std::filesystem::path& kept, const std::string& key,
                  const std::function<CoverageResult()>& measure);

/// The design of one fit, with which a study of several begins or goes on; kept as those of a grid.
void add_design(CoverageStudy& study, const FitSpec& spec, const std::vector<Dataset>& datasets,
                const CoverageOptions& options, const std::filesystem::path& kept);

}  // namespace recoil
