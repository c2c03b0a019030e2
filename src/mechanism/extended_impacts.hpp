#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "impact/impact.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {

/// How a batch of impacts is answered: `simulate_impacts_fast`, or anything that agrees with it.
using SimulateImpacts = long (*)(std::span<const ImpactGroups> groups, const ImpactOptions& options,
                                 std::span<ImpactResult> results);

/// One point: a sphere as the dataset has it.
struct ExtendedPoint {
  const Surroundings* at = nullptr;
  double diameter = 0.0;                              ///< [m]
  double velocity = 0.0;                              ///< [m/s]
  std::size_t series = static_cast<std::size_t>(-1);  ///< whose conditions hold; else the dataset's
};

/// What a point shows with mechanisms at work.
struct ExtendedAnswer {
  ImpactOutcome outcome = ImpactOutcome::integration_failure;
  double restitution_squared = 0.0;  ///< continued below zero for a capture
};

/// The base model with a chain of mechanisms at a fixed list of points. For one sphere:
///   on the way in every mechanism of the chain changes what arrives (`before`), outermost first;
///   the impact of the base model gives e_0^2, and v^2 = e_0^2 V^2 with V as it arrived;
///   on the way out the chain in reverse order changes v^2 (`after`);
///   e^2 = v^2 / V_measured^2.
/// Where spheres of one point differ (`vary`) this is done at nine of them, all in one batch, and
/// the mean of the survivors is taken (several such mechanisms: on the product of their nodes, the
/// last of the chain innermost). At last the chain changes what is seen (`observe`).
///
/// Derivatives are exact: those of the base impact come from the solver, those of the chain by dual
/// numbers. Nothing is allocated after the first evaluation with and without them.
class ExtendedImpacts {
 public:
  /// @param materials whether derivatives in the constants of the materials are wanted, too
  ExtendedImpacts(std::vector<const Mechanism*> chain, std::vector<ExtendedPoint> points,
                  bool materials = false);
  ~ExtendedImpacts();
  ExtendedImpacts(ExtendedImpacts&&) noexcept;
  ExtendedImpacts& operator=(ExtendedImpacts&&) noexcept;

  /// C_H, C_A, f0 at the reference diameter, then the mechanisms' parameters.
  std::size_t value_count() const { return base_directions - 2 + own_count_; }

  /// @param values [points x value_count()]
  /// @param options phase, gradient and tolerances; dashpot is set here
  /// @return what `simulate` returned: how many impacts were handed over
  long evaluate(std::span<const double> values, ImpactOptions options, SimulateImpacts simulate);

  std::size_t size() const { return points_.size(); }
  const ExtendedAnswer& at(std::size_t i) const { return answers_[i]; }
  /// d e^2 / d (V, D, values...) at point i, [2 + value_count()], and then with `materials` in the
  /// density, K, W_A and the mobility of its Surroundings; after an evaluation with gradient.
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
  template <class T>
  void keep_slopes(std::size_t i, const T& square);

  std::vector<const Mechanism*> chain_;
  std::vector<const Mechanism*> spreads_;  // those of the chain that make spheres of a point differ
  std::vector<ExtendedPoint> points_;
  std::size_t own_count_ = 0;  // parameters of the mechanisms in the chain
  bool materials_ = false;
  std::size_t nodes_ = 1;  ///< impacts per point
  bool dashpot_ = false;
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

/// One encounter with one sphere, for those who want to look: the conditions at the contact and the
/// groups of the base impact there. @param values C_H, C_A, f0, then the parameters of the chain
struct ContactView {
  Encounter<double> encounter;  ///< as it arrives at the contact
  ImpactGroups groups;
  ImpactScales scales;
};
ContactView view_contact(std::span<const Mechanism* const> chain, const ExtendedPoint& point,
                         std::span<const double> values);

/// Where the kinetic energy of one sphere goes, the middle one where spheres of a point differ [J].
/// An error of the measurement counts as energy between what is read and what moves.
struct WholeImpactEnergy {
  double incident = 0.0;   ///< m V^2 / 2 as measured
  std::vector<double> in;  ///< what each mechanism of the chain takes on the way in; below 0: gives
  double contact = 0.0;    ///< what the impact of the base model takes
  std::vector<double> out;  ///< what each takes on the way out
  double rebound = 0.0;     ///< what is left; below 0: what a captured sphere lacks
};
/// @param impact of the base model at the contact, see `view_contact`
WholeImpactEnergy whole_impact_energy(std::span<const Mechanism* const> chain,
                                      const ExtendedPoint& point, std::span<const double> values,
                                      const ImpactResult& impact);

}  // namespace recoil
