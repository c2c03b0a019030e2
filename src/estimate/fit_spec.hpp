#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/names.hpp"
#include "estimate/noise.hpp"
#include "impact/impact.hpp"
#include "mechanism/parameter.hpp"

namespace recoil {

/// A key of a fit file, as the manual describes it.
struct FitKey {
  std::string_view table;  ///< "noise"; empty for a key outside of all tables
  std::string_view name;   ///< "variance"
  std::string standard;    ///< its default as written in the file; empty if the key is required
  std::string_view meaning;
};

/// Every key of a fit file; `parameter` is the table of any single parameter. The reader accepts
/// these keys only.
const std::vector<FitKey>& fit_keys();

/// The names of the keys of one table, in order.
std::vector<std::string> fit_keys_of(std::string_view table);

/// How the bootstrap makes a new data set from the fit and the points.
enum class Scheme {
  automatic,   ///< "auto": chosen by the rule of `plan_resampling`
  parametric,  ///< simulated noise of the estimated size about the fitted curve
  residual,    ///< residuals, scaled for leverage and centred, drawn with replacement
  wild,        ///< each point keeps its own residual, with a random sign
  cases,       ///< "case": whole points drawn with replacement
  cluster,     ///< whole series drawn with replacement
};

/// The names in fit files, on the command line and in fit.json.
constexpr auto names_of_values(Scheme) {
  return name_list("auto", "parametric", "residual", "wild", "case", "cluster");
}

/// What a fit file states about one parameter.
struct ParameterSpec {
  const Parameter* parameter = nullptr;
  double initial = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  bool free = true;
  bool per_dataset = false;     ///< `per = "dataset"`: one value for each dataset of the fit
  bool initial_stated = false;  ///< false: the materials give f0 or W
  /// False: the upper bound of C_H depends on the velocities, see make_model.
  bool bounds_stated = false;
  bool mentioned = false;  ///< the file has an entry for the parameter, so no condition of a
                           ///< dataset overrides it

  /// Does the start (or the value, if it is fixed) come from the materials of the datasets?
  bool is_derived() const { return parameter->is_adhesion() && !initial_stated; }
};

/// The statement that holds if a fit file does not mention `parameter`.
ParameterSpec default_of(const Parameter& parameter);

/// How a fit treats the stated errors of material constants.
enum class Materials {
  exact,       ///< errors are ignored
  propagated,  ///< the estimate uses the stated constants; their errors widen every interval
  adjusted,    ///< the fit moves the constants; each stated value is one more observation
  averaged,    ///< adjusted, and averaged over the error of the laws (`fit_over_laws`)
};

/// The `[uncertainty]` table.
struct UncertaintySpec {
  int replicates = 1999;  ///< 0 (no bootstrap) or at least 19: fewer have no 5 % tails
  /// `replicates = "auto"`: as many as the intervals need, see UncertaintyOptions; `replicates` is
  /// not used.
  bool replicates_auto = false;
  Scheme scheme = Scheme::automatic;
  double level = 0.95;  ///< of every interval, in (0, 1)
  std::uint64_t seed = 20260101;
  bool posterior = false;  ///< also sample the posterior
  /// Number of simulated data sets of `own_design_coverage`; 0: none. Empty: the number that
  /// `own_design_datasets` gives.
  std::optional<int> own_design;
  Materials materials = Materials::averaged;
};

/// A fit file, validated: one member for each key. Every key but `dataset` has its default here or
/// in the catalogue.
struct FitSpec {
  std::string id;  ///< the file's name without its extension
  std::filesystem::path file;
  std::vector<std::filesystem::path> datasets;  ///< folders, relative to the working directory
  AdhesionLaw adhesion = AdhesionLaw::ring;
  double separation = equilibrium_separation;  ///< z_0 of `maugis` [m]
  AdhesionDampingPhase phase = AdhesionDampingPhase::rebound;
  /// The loss of the dry contact: `hunt_crossley` (C_H), the `dry_loss` of a mechanism in
  /// `mechanisms` that replaces C_H, or `auto`: the points select it, see `choose_loss`. Empty:
  /// auto without adhesion, else hunt_crossley.
  std::string loss;
  std::vector<std::string> mechanisms;  ///< ids from the catalogue of mechanisms
  bool mixed_sizes = true;  ///< points average over the sizes that their dataset states; false: all
                            ///< spheres of a point have its diameter
  /// All of `parameters_with(mechanisms, adhesion)`, in that order.
  std::vector<ParameterSpec> parameters;
  NoiseSpec noise;
  Location variance_place;  ///< place of the variance function in the file, for messages
  UncertaintySpec uncertainty;
  /// `[diagnosis]`: relative, smooth error of the law of a mechanism [1]; empty: averaged over.
  std::optional<double> law_error;
  std::string text;    ///< the file's text
  std::string sha256;  ///< its SHA-256

  /// The entry of `parameters`, or `default_of` if there is none.
  ParameterSpec statement_of(const Parameter& parameter) const;
};

/// C_H of equation 5, as `[model] loss` names it.
inline constexpr std::string_view hunt_crossley = "hunt_crossley";

/// The names allowed for `[model] loss`, except `auto`: `hunt_crossley` and every
/// `MechanismInfo::dry_loss`.
std::vector<std::string> dry_losses();

/// The mechanism whose loss has this name; null for `hunt_crossley`.
const Mechanism* dry_loss_mechanism(std::string_view loss);

/// `spec` with this loss of the dry contact: a mechanism is added, and C_H is fixed at 0.
FitSpec with_loss(FitSpec spec, const std::string& loss);

/// Reads and validates a fit file. Unknown keys are errors that name the nearest known one.
///
/// Rules for `[parameters]`: values are finite and not negative (damping only removes energy);
/// bounds are [lower, upper] with lower < upper, and above zero for a parameter on a log scale; the
/// initial value of a free parameter lies within its bounds, and that of a fixed one within bounds
/// that the file states. Parameters of mechanisms stay within the bounds of the catalogue, where
/// their formulas hold, and may be negative there. `dataset` paths are relative to the file's
/// folder.
/// @throws InputError with file, line and column.
FitSpec load_fit(const std::filesystem::path& file);

/// Reads the same from a text instead of a file; does not check that the dataset folders exist.
/// @throws InputError as `load_fit` does.
FitSpec parse_fit(const std::string& text, const std::filesystem::path& file);

}  // namespace recoil
