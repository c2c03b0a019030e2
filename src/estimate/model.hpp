#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"
#include "data/contact.hpp"
#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/material_constants.hpp"
#include "estimate/observation.hpp"
#include "impact/impact.hpp"
#include "mechanism/extended_impacts.hpp"
#include "mechanism/parameter.hpp"

namespace recoil {

/// Which integrator answers: the fast fixed-order one (which hands over to the reference by itself
/// outside the region where it is certified) or CVODES throughout.
enum class Solver { fast, reference };

template <>
struct NamesOf<Solver> {
  static constexpr std::array<std::string_view, 2> names = {"fast", "reference"};
};

/// How the impacts of a model are solved; nothing of it is physics.
struct SolverSettings {
  Solver kind = Solver::fast;
  double tolerance_factor = 1.0;  ///< the solver's tolerance is its own times this
};

/// One entry of the parameter vector theta: a parameter of the catalogue, as this fit moves it.
struct ParameterSlot {
  const Parameter* parameter = nullptr;
  std::string dataset;  ///< id when every dataset has its own, else empty
  std::string series;   ///< name when every series has its own, else empty
  double initial = 0.0;
  double lower = 0.0;
  double upper = 0.0;
  bool free = true;
  bool log_scale = false;
  bool derived = false;  ///< its value is what the materials give; while it is not free it follows
                         ///< their constants
  std::optional<Condition> stated = {};  ///< the condition from which its value follows
  bool adjusted = false;  ///< a constant of the materials that every fit moves as far as its error
                          ///< allows (Materials::adjusted)

  /// A constant of the materials that is known with an error.
  bool is_constant() const { return parameter->role == ParameterRole::material_constant; }
  bool moves() const { return free || adjusted; }
  /// That to which the parameter belongs; null for the base model.
  const Mechanism* mechanism() const { return parameter->mechanism; }
  /// "C_A", "C_A[wall1990-mica]", "o[monday]", "o[wall1990-mica/monday]".
  std::string label() const;
};

/// The model applied to the datasets of one fit: what the parameters are and how they enter.
struct ImpactModel {
  AdhesionLaw adhesion = AdhesionLaw::ring;
  double separation = equilibrium_separation;  ///< z_0 of `maugis` [m]
  AdhesionDampingPhase phase = AdhesionDampingPhase::rebound;
  SolverSettings solver;
  std::vector<ParameterSlot> slots;
  std::vector<ContactProperties> contacts;      ///< per dataset
  std::vector<std::size_t> slot_C_H, slot_C_A;  ///< per dataset: index into `slots`
  std::vector<std::size_t> slot_adhesion;  ///< of f0, or of W under another law than the ring's

  std::vector<const Mechanism*> chain;     ///< in the order in which they act
  std::vector<Surroundings> surroundings;  ///< per dataset
  /// [parameter of the chain][dataset]: index into `slots`: one, or one per series. Where series
  /// differ in a condition that states the parameter, a last one holds for spheres of no series.
  std::vector<std::vector<std::vector<std::size_t>>> slot_own;

  /// The constants that are known with an error. They are the last slots, in this order.
  std::vector<UncertainConstant> constants;
  std::vector<MaterialLaw> materials;  ///< per dataset

  /// Do fits move the constants, or keep them where they are stated?
  bool adjusts_constants() const { return !constants.empty() && slots.back().adjusted; }
  std::size_t adjusted_count() const { return adjusts_constants() ? constants.size() : 0; }
  /// The slot of constants[0]; how many slots there are without the constants.
  std::size_t first_constant() const { return slots.size() - constants.size(); }
  std::span<const double> constants_of(std::span<const double> theta) const {
    return theta.subspan(first_constant());
  }
  std::vector<double> initial() const;
  int free_count() const;  ///< without the constants of the materials
  /// The options of its impacts.
  ImpactOptions impact_options(bool gradient) const;
  /// What solves them.
  SimulateImpacts simulator() const;
};

/// The slot of parameter number `k` of the chain for a sphere; none where every series has its own
/// and the sphere is of no series.
std::optional<std::size_t> own_slot(const ImpactModel& model, std::size_t k,
                                    const Parameter& parameter, const PointConditions& at);

/// What the materials of `dataset` say of its parameter of adhesion: f0 [N/m] or W [J/m2].
double derived_adhesion(const ImpactModel& model, std::size_t dataset);

/// f0 at the reference diameter of `dataset` [N/m]; from W by eqs 9 and 10 where W is the
/// parameter. Where it is derived and not free it follows the constants of the materials.
double adhesion_force_under(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset);

/// Nothing holds the spheres of `dataset`: no adhesion is stated, none is fitted, no mechanism adds
/// one. A capture velocity is then nothing but the smallest f0 that the solver takes.
bool without_adhesion(const ImpactModel& model, std::size_t dataset);

/// Do the points of a dataset average over sizes that it states?
bool averages_over_sizes(const ImpactModel& model, std::size_t dataset);
bool averages_over_sizes(const ImpactModel& model);  ///< those of any dataset

/// Does the adhesion of `dataset` follow the constants of its materials?
bool follows_materials(const ImpactModel& model, std::size_t dataset);

/// The dataset in which the slot is an adhesion that follows the materials, if there is one.
std::optional<std::size_t> followed_in(const ImpactModel& model, std::size_t slot);

/// The value of a slot as it acts: an adhesion that follows the materials moves with their
/// constants, those of the first dataset that has it.
double acting_value(const ImpactModel& model, std::span<const double> theta, std::size_t slot);

/// The parameter of adhesion at the reference diameter, f0 [N/m] or W [J/m2], as it acts.
double adhesion_value_under(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset);

/// The model whose fits move the constants of the materials as far as their errors allow.
ImpactModel with_adjusted_materials(ImpactModel model);

/// The model with all constants of the materials exact, as stated.
ImpactModel with_exact_materials(ImpactModel model);

/// d f0 / d (its parameter): 1, or (2/3) f0 / W.
double adhesion_force_slope(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset);

/// The materials of `dataset` under `theta`.
MaterialState materials_under(const ImpactModel& model, std::span<const double> theta,
                              std::size_t dataset);

/// Their slopes in the constants; `adhesion_force` is that of `adhesion_force_under`. Empty where
/// they are exact.
std::vector<MaterialSlope> material_slopes(const ImpactModel& model, std::span<const double> theta,
                                           std::size_t dataset);

/// The surroundings of `dataset` under `theta`.
Surroundings surroundings_under(const ImpactModel& model, std::span<const double> theta,
                                std::size_t dataset);

/// theta with every mechanism at its null value: the base model.
std::vector<double> without_mechanisms(const ImpactModel& model, std::vector<double> theta);
/// theta with this one at its null value.
std::vector<double> without_mechanism(const ImpactModel& model, std::vector<double> theta,
                                      const Mechanism& mechanism);

/// Lays out theta for `spec`. f0 that is not free, or has no stated start, takes the value of eq.
/// 12 for its dataset.
ImpactModel make_model(const FitSpec& spec, const std::vector<Dataset>& datasets);

/// SI conditions of an impact under `theta`. @pre theta.size() == model.slots.size()
ImpactConditions conditions_at(const ImpactModel& model, std::span<const double> theta,
                               std::size_t dataset, double diameter, double velocity);

}  // namespace recoil
