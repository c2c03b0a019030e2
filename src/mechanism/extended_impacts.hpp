#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "impact/impact.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {

/// A solver of a batch of impacts: `simulate_impacts_fast`, or one that agrees with it.
using SimulateImpacts = long (*)(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                                 std::span<ImpactResult> results);

/// One point of a dataset.
struct ExtendedPoint {
  const Surroundings* at = nullptr;
  double diameter = 0.0;                              ///< [m]
  double velocity = 0.0;                              ///< [m/s]
  std::size_t series = static_cast<std::size_t>(-1);  ///< it has the conditions; -1: the dataset
};

/// The result of a point with mechanisms.
struct ExtendedAnswer {
  ImpactOutcome outcome = ImpactOutcome::integration_failure;
  double restitution_squared = 0.0;  ///< continued below zero for a capture
};

/// The base model with a chain of mechanisms at a fixed list of points. For one sphere:
///   on the way in, every mechanism of the chain changes the state (`before`), outermost first;
///   the impact of the base model with the velocity V at the contact gives v^2 = e_0^2 V^2;
///   on the way out, the chain in reverse order changes v^2 (`after`);
///   e^2 = v^2 / V_measured^2.
/// If the spheres of one point differ (`vary`), this is done for nine of them, all in one batch,
/// and the rebounds are averaged. Several such mechanisms use the product of their nodes, with the
/// last one of the chain innermost. Finally the chain changes the average (`observe`).
///
/// Derivatives are exact: those of the base impact come from the solver, those of the chain from
/// dual numbers. No memory is allocated after the first evaluation with and without derivatives;
/// its many private members are this memory.
class ExtendedImpacts {
 public:
  /// @param materials also computes derivatives in the constants of the materials
  ExtendedImpacts(std::vector<const Mechanism*> chain, std::vector<ExtendedPoint> points,
                  bool materials = false);
  ~ExtendedImpacts();
  ExtendedImpacts(ExtendedImpacts&&) noexcept;
  ExtendedImpacts& operator=(ExtendedImpacts&&) noexcept;

  /// C_H, C_A, f0 at the reference diameter, then the mechanisms' parameters.
  std::size_t value_count() const { return base_directions - 2 + own_count_; }

  /// @param values [points x value_count()]
  /// @param options phase, gradient and tolerances; dashpot and never_pulls are set here
  /// @return the result of `simulate`: the number of impacts solved by the reference
  long evaluate(std::span<const double> values, ImpactOptions options, SimulateImpacts simulate);

  std::size_t size() const { return points_.size(); }
  const ExtendedAnswer& at(std::size_t i) const { return answers_[i]; }
  /// d e^2 / d (V, D, values...) at point i, [2 + value_count()], after an evaluation with
  /// gradient; with `materials` followed by those in density, K, W_A and mobility of its
  /// Surroundings.
  std::span<const double> slopes(std::size_t i) const;

 private:
  std::size_t directions() const {
    return base_directions + own_count_ + (materials_ ? material_directions : 0);
  }
  template <class T>
  struct Workspace;
  template <class T>
  long evaluate_with(Workspace<T>& work, std::span<const double> values,
                     const ImpactOptions& options, SimulateImpacts simulate);

  std::vector<const Mechanism*> chain_;
  std::vector<const Mechanism*> spreads_;  // mechanisms of the chain with `vary`
  std::vector<ExtendedPoint> points_;
  std::size_t own_count_ = 0;  // parameters of the mechanisms in the chain
  bool materials_ = false;
  std::size_t nodes_ = 1;  ///< impacts per point
  bool dashpot_ = false, never_pulls_ = false;
  std::vector<ImpactGroups> groups_;
  std::vector<ImpactResult> results_;
  std::vector<ExtendedAnswer> answers_;
  std::vector<double> slopes_;
  std::unique_ptr<Workspace<double>> plain_;
  std::unique_ptr<Workspace<FewDirections>> few_;
  std::unique_ptr<Workspace<SomeDirections>> some_;
  std::unique_ptr<Workspace<SeveralDirections>> several_;
  std::unique_ptr<Workspace<ManyDirections>> many_;
};

/// The state of one sphere at the contact, for display, and the groups of the base impact. If the
/// spheres of a point differ, it is the sphere of the stated diameter and f0: the mean one for
/// sizes, the median one for adhesion.
/// @param values C_H, C_A, f0, then the parameters of the chain
struct ContactView {
  Encounter<double> encounter;  ///< at the beginning of the contact
  ImpactGroups groups;
  ImpactScales scales;
  bool dashpot = false, never_pulls = false;  ///< see ImpactOptions
};
ContactView view_contact(std::span<const Mechanism* const> chain, const ExtendedPoint& point,
                         std::span<const double> values);

/// The energy budget of the sphere of `view_contact` [J]. For an error of measurement it is the
/// energy of the reading less the true energy.
struct WholeImpactEnergy {
  double incident = 0.0;    ///< m V^2 / 2 with the measured V
  std::vector<double> in;   ///< loss by each mechanism of the chain on the way in; negative: gain
  double contact = 0.0;     ///< loss in the impact of the base model
  std::vector<double> out;  ///< loss by each mechanism on the way out
  double rebound = 0.0;     ///< the remaining energy; negative: missing for a rebound
};
/// @param impact of the base model at the contact, see `view_contact`
WholeImpactEnergy whole_impact_energy(std::span<const Mechanism* const> chain,
                                      const ExtendedPoint& point, std::span<const double> values,
                                      const ImpactResult& impact);

}  // namespace recoil
