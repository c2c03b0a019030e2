#pragma once

#include <optional>

#include "export/exported_impact.hpp"

namespace recoil {

/// The contact models that other programs have, as far as they are used here. Each has one number
/// to choose, and none of them captures.
enum class StockModel {
  constant_restitution,  ///< e, whatever the velocity
  hertz_dashpot          ///< Hertz with a damping -D n^(1/2) n': 1 - e^2 ~ V^(1/5)
};

template <>
struct NamesOf<StockModel> {
  static constexpr std::array<std::string_view, 2> names = {"constant_restitution",
                                                            "hertz_dashpot"};
};

/// How far e(V) of an approximation is from the exported one over the range of velocities, a
/// captured sphere counting with e = 0.
struct RestitutionError {
  double largest = 0.0;     ///< max |delta e| [1]
  double at = 0.0;          ///< where [m/s]
  double rms = 0.0;         ///< over velocities evenly spaced in log V [1]
  double rebounding = 0.0;  ///< max |delta e| among spheres that rebound in the fit [1]
};
RestitutionError restitution_error(const ExportedImpact& impact, std::span<const double> other);

struct Approximation {
  StockModel model = StockModel::constant_restitution;
  double value = 0.0;  ///< e [1] or D [N s m^(-3/2)]
  RestitutionError error;
};

/// The value that makes `model` nearest: the smallest rms of delta e over velocities evenly spaced
/// in log V. A constant e is at least `least_restitution`.
/// @throws InputError where every sphere is captured: no stock model captures
Approximation nearest(StockModel model, const ExportedImpact& impact,
                      double least_restitution = 0.0);

/// The force of an approximation that has one.
ContactForce force_of(const Approximation& approximation, const ExportedImpact& impact);

/// The ring law with other values of C_H, C_A and f0, for what is no force in the equation of
/// motion: for a program that can hold any force.
struct RefittedForce {
  ContactForce force;
  RestitutionError error;
  double capture_velocity = 0.0;  ///< [m/s]; 0: it captures nothing
};

/// The values with the least squares of (e^2 - e_fit^2) / (2 max(e_fit, 0.1)), which is delta e but
/// where e vanishes, over velocities evenly spaced in log V. Spheres that stay in both count
/// nothing.
RefittedForce refitted_force(const ExportedImpact& impact);

/// What a program is given for an impact.
enum class ExportForm {
  force,          ///< the law itself: exact but for the time step
  refitted,       ///< a RefittedForce
  approximation,  ///< a stock model
  lookup          ///< e(V, d) as a table, captures included
};

/// What `target` can hold of this impact.
/// @param stock wants a contact model that the program has, whatever else it could hold
ExportForm form_for(ExportTarget target, const ExportedImpact& impact, bool stock = false);

/// The stock model of `target`.
StockModel stock_model(ExportTarget target);

/// The smallest constant e that `target` takes: LIGGGHTS 3.8 refuses 0.05 and less.
double least_restitution(ExportTarget target);

}  // namespace recoil
