#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "data/contact.hpp"
#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/law_error.hpp"
#include "estimate/material_constants.hpp"
#include "estimate/observation.hpp"
#include "impact/impact.hpp"
#include "mechanism/extended_impacts.hpp"
#include "mechanism/parameter.hpp"

namespace recoil {

/// The integrator: the fast fixed-order one, which hands impacts outside its certified region to
/// the reference, or CVODES for all impacts.
enum class Solver { fast, reference };

constexpr auto names_of_values(Solver) { return name_list("fast", "reference"); }

/// Numerical settings of the impact solver.
struct SolverSettings {
  Solver kind = Solver::fast;
  double tolerance_factor = 1.0;  ///< factor on the solver's default tolerance
};

/// One entry of the parameter vector theta: a parameter of the catalogue in this fit.
struct ParameterSlot {
  const Parameter* parameter = nullptr;
  std::string dataset;  ///< id if every dataset has its own slot, else empty
  std::string series;   ///< name if every series has its own slot, else empty
  double initial = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  bool free = true;
  bool log_scale = false;
  bool derived = false;  ///< its value comes from the materials; if it is not free, it changes with
                         ///< their constants
  std::optional<Condition> stated = {};  ///< the condition that states its value
  /// A constant that every fit moves within its error.
  bool adjusted = false;

  /// Is it one of ImpactModel::constants?
  bool is_constant() const {
    return parameter->role == ParameterRole::material_constant ||
           parameter->role == ParameterRole::law_error;
  }
  bool moves() const { return free || adjusted; }
  /// The mechanism of the parameter; null for the base model.
  const Mechanism* mechanism() const { return parameter->mechanism; }
  /// The name in messages and results: "C_A", "C_A[wall1990-mica]", "o[monday]",
  /// "o[wall1990-mica/monday]".
  std::string label() const;
};

/// The model applied to the datasets of one fit: the parameters, and how each dataset uses them.
struct ImpactModel {
  AdhesionLaw adhesion = AdhesionLaw::ring;
  double separation = equilibrium_separation;  ///< z_0 of `maugis` [m]
  AdhesionDampingPhase phase = AdhesionDampingPhase::rebound;
  SolverSettings solver;
  std::vector<ParameterSlot> slots;
  std::vector<ContactProperties> contacts;      ///< per dataset
  std::vector<std::size_t> slot_C_H, slot_C_A;  ///< per dataset: index into `slots`
  /// Per dataset: slot of f0, or of W under another law than the ring law.
  std::vector<std::size_t> slot_adhesion;

  std::vector<const Mechanism*> chain;     ///< the mechanisms, in the order in which they act
  std::vector<Surroundings> surroundings;  ///< per dataset
  /// [parameter of the chain][dataset]: indices into `slots`, one for all series or one per series.
  /// If series differ in a condition that states the parameter, an additional last entry is for
  /// spheres without series.
  std::vector<std::vector<std::vector<std::size_t>>> slot_own;

  /// The constants with a stated error: of the materials, then the coefficients of `law_error`.
  /// They occupy the last slots, in this order.
  std::vector<UncertainConstant> constants;
  std::shared_ptr<const LawError> law_error;  ///< null: the laws are exact
  std::vector<MaterialLaw> materials;         ///< per dataset

  /// Do fits move the constants (true), or keep their stated values?
  bool adjusts_constants() const { return !constants.empty() && slots.back().adjusted; }
  std::size_t adjusted_count() const { return adjusts_constants() ? constants.size() : 0; }
  /// The slot of constants[0], which is the number of slots without the constants.
  std::size_t first_constant() const { return slots.size() - constants.size(); }
  std::span<const double> constants_of(std::span<const double> theta) const {
    return theta.subspan(first_constant());
  }
  /// The number of constants of the materials, which come first.
  std::size_t material_count() const {
    return constants.size() - (law_error ? law_error->count() : 0);
  }
  std::size_t first_law_slot() const { return first_constant() + material_count(); }
  std::vector<double> initial() const;
  int free_count() const;  ///< number of free slots, without the material constants
  /// The solver options for its impacts.
  ImpactOptions impact_options(bool gradient) const;
  /// The solver for its impacts.
  SimulateImpacts simulator() const;
};

/// The slot of parameter number `k` of the chain for a sphere; nullopt if every series has its own
/// slot and the sphere has no series.
std::optional<std::size_t> own_slot(const ImpactModel& model, std::size_t k,
                                    const Parameter& parameter, const PointConditions& at);

/// The adhesion parameter that follows from the materials of `dataset`: f0 [N/m] or W [J/m2].
double derived_adhesion(const ImpactModel& model, std::size_t dataset);

/// f0 at the reference diameter of `dataset` [N/m]; from W by eqs 9 and 10 if W is the parameter.
/// If it is derived and not free, it changes with the material constants.
double adhesion_force_under(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset);

/// Is `dataset` without adhesion: none stated, none fitted, and none added by a mechanism? A
/// capture velocity would then only reflect the smallest f0 that the solver accepts.
bool without_adhesion(const ImpactModel& model, std::size_t dataset);

/// Do the points of a dataset average over sphere sizes that the dataset states?
bool averages_over_sizes(const ImpactModel& model, std::size_t dataset);
bool averages_over_sizes(const ImpactModel& model);  ///< of any dataset

/// Does the adhesion of `dataset` change with its uncertain material constants?
bool follows_materials(const ImpactModel& model, std::size_t dataset);

/// The first dataset in which the slot is an adhesion that changes with the materials; nullopt
/// without one.
std::optional<std::size_t> followed_in(const ImpactModel& model, std::size_t slot);

/// The effective value of a slot: an adhesion that changes with the materials is evaluated at their
/// constants in the first dataset that uses it.
double acting_value(const ImpactModel& model, std::span<const double> theta, std::size_t slot);

/// The effective adhesion parameter at the reference diameter: f0 [N/m] or W [J/m2].
double adhesion_value_under(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset);

/// The model whose fits move the material constants within their errors.
ImpactModel with_adjusted_materials(ImpactModel model);

/// The model with all material constants exact, at their stated values.
ImpactModel with_exact_materials(ImpactModel model);

/// The model with an error of the laws. @pre it has none
ImpactModel with_law_error(ImpactModel model, const LawErrorPrior& prior,
                           std::span<const PointConditions> points);

/// The model without an error of the laws.
ImpactModel with_exact_laws(ImpactModel model);

/// d f0 / d (adhesion parameter): 1, or (2/3) f0 / W.
double adhesion_force_slope(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset);

/// The materials of `dataset` under `theta`.
MaterialState materials_under(const ImpactModel& model, std::span<const double> theta,
                              std::size_t dataset);

/// Logarithmic slopes of the materials in the constants; `adhesion_force` is the slope of
/// `adhesion_force_under`. Empty if the materials are exact.
std::vector<MaterialSlope> material_slopes(const ImpactModel& model, std::span<const double> theta,
                                           std::size_t dataset);

/// The surroundings of `dataset` under `theta`.
Surroundings surroundings_under(const ImpactModel& model, std::span<const double> theta,
                                std::size_t dataset);

/// theta with every mechanism at its null value: the base model.
std::vector<double> without_mechanisms(const ImpactModel& model, std::vector<double> theta);
/// theta with this mechanism at its null value.
std::vector<double> without_mechanism(const ImpactModel& model, std::vector<double> theta,
                                      const Mechanism& mechanism);

/// Builds the model and the slots of theta for `spec`. An adhesion without a stated initial value
/// gets the value of `derived_adhesion` for its dataset.
ImpactModel make_model(const FitSpec& spec, const std::vector<Dataset>& datasets);

/// Conditions of an impact under `theta`, in SI units. @pre theta.size() == model.slots.size()
ImpactConditions conditions_at(const ImpactModel& model, std::span<const double> theta,
                               std::size_t dataset, double diameter, double velocity);

}  // namespace recoil
