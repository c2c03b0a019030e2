#pragma once

#include "export/exported_impact.hpp"
#include "export/stock_jkr.hpp"

namespace recoil {

/// Contact models of other programs. Only jkr captures.
enum class StockModel {
  constant_restitution,  ///< e at all velocities
  hertz_dashpot,         ///< Hertz with a damping -D n^(1/2) n': 1 - e^2 ~ V^(1/5)
  jkr                    ///< StockJkr
};

/// The error of e(V) of an approximation over the range of velocities. A captured sphere has e = 0.
struct RestitutionError {
  double largest = 0.0;     ///< max |delta e| [1]
  double at = 0.0;          ///< velocity of the largest error [m/s]
  double rms = 0.0;         ///< over velocities evenly spaced in log V [1]
  double rebounding = 0.0;  ///< max |delta e| among spheres that rebound in the fit [1]
};
RestitutionError restitution_error(const ExportedImpact& impact, std::span<const double> other);

struct Approximation {
  StockModel model = StockModel::constant_restitution;
  double value = 0.0;   ///< e [1], D [N s m^(-3/2)] or eta of StockJkr [1/(m s)]
  double energy = 0.0;  ///< gamma of StockJkr [J/m2]
  RestitutionError error;
  double capture_velocity = 0.0;  ///< [m/s]; 0: no capture
  double longest_contact = 0.0;   ///< of StockJkr, over the range [s]
};

/// The parameter of `model` with the smallest rms of delta e over velocities evenly spaced in log
/// V. A constant e is at least `least_restitution`.
/// @throws InputError if every sphere is captured
Approximation nearest(StockModel model, const ExportedImpact& impact,
                      double least_restitution = 0.0);

/// StockJkr with the two parameters of the least squares of `refitted_force`. E* stays that of the
/// fit, which contact times and forces depend on.
/// @throws InputError if every sphere is captured
Approximation nearest_jkr(const ExportedImpact& impact);

/// The contact of a jkr approximation.
StockJkr jkr_of(const Approximation& approximation, const ExportedImpact& impact);

/// The nearest of the contact models that `target` has: jkr only if the fit has adhesion and e is
/// nearer than that of the others.
/// @throws InputError if every sphere is captured
Approximation nearest_stock(ExportTarget target, const ExportedImpact& impact);

/// The force of a hertz_dashpot approximation.
ContactForce force_of(const Approximation& approximation, const ExportedImpact& impact);

/// The ring law with other values of C_H, C_A and f0. It approximates impacts whose mechanisms are
/// no force in the equation of motion, for programs that accept any force.
struct RefittedForce {
  ContactForce force;
  RestitutionError error;
  double capture_velocity = 0.0;  ///< [m/s]; 0: no capture
};

/// The values with the least squares of (e^2 - e_fit^2) / (2 max(e_fit, 0.1)), which is nearly
/// delta e if e is not small, over velocities evenly spaced in log V. Captures in both do not
/// contribute.
RefittedForce refitted_force(const ExportedImpact& impact);

/// The form in which an impact is exported.
enum class ExportForm {
  force,          ///< the force law: exact except for the time step
  refitted,       ///< a RefittedForce
  approximation,  ///< a stock model
  lookup          ///< e(V, d) as a table, captures included
};

/// The best form of this impact for `target`. @param stock requires a contact model of the program
ExportForm form_for(ExportTarget target, const ExportedImpact& impact, bool stock = false);

}  // namespace recoil
