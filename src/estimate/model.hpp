#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "data/contact.hpp"
#include "data/dataset.hpp"
#include "estimate/fit_spec.hpp"
#include "estimate/solver_settings.hpp"
#include "impact/impact.hpp"
#include "mechanism/extended_impacts.hpp"
#include "mechanism/parameter.hpp"

namespace recoil {

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
  /// [parameter of the chain][dataset]: index into `slots`, one or one per series.
  std::vector<std::vector<std::vector<std::size_t>>> slot_own;

  std::vector<double> initial() const;
  int free_count() const;
  /// The options of its impacts.
  ImpactOptions impact_options(bool gradient) const;
  /// What solves them.
  SimulateImpacts simulator() const;
};

/// What the materials of `dataset` say of its parameter of adhesion: f0 [N/m] or W [J/m2].
double derived_adhesion(const ImpactModel& model, std::size_t dataset);

/// f0 at the reference diameter of `dataset` [N/m]; from W by eqs 9 and 10 where W is the
/// parameter.
double adhesion_force_under(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset);

/// d f0 / d (its parameter): 1, or (2/3) f0 / W.
double adhesion_force_slope(const ImpactModel& model, std::span<const double> theta,
                            std::size_t dataset);

/// theta with every mechanism at its null value: the base model.
std::vector<double> without_mechanisms(const ImpactModel& model, std::vector<double> theta);

/// Lays out theta for `spec`. f0 that is not free, or has no stated start, takes the value of eq.
/// 12 for its dataset.
ImpactModel make_model(const FitSpec& spec, const std::vector<Dataset>& datasets);

/// SI conditions of an impact under `theta`. @pre theta.size() == model.slots.size()
ImpactConditions conditions_at(const ImpactModel& model, std::span<const double> theta,
                               std::size_t dataset, double diameter, double velocity);

}  // namespace recoil
