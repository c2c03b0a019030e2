#include "export/approximation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/roots.hpp"

namespace recoil {
namespace {

constexpr double least_loss = 1e-6;  // of the groups C_H V and kappa, in the search for the best
constexpr double most_loss = 1e3;
constexpr double found_to = 1e-4;  // relative, of the value

std::vector<double> answers(const Approximation& approximation, const ExportedImpact& impact) {
  if (approximation.model == StockModel::constant_restitution) {
    return std::vector<double>(impact.velocity.size(), approximation.value);
  }
  return restitution_under(force_of(approximation, impact), impact.velocity);
}

}  // namespace

RestitutionError restitution_error(const ExportedImpact& impact, std::span<const double> other) {
  assert(other.size() == impact.restitution.size());
  RestitutionError error;
  double sum = 0.0;
  for (std::size_t k = 0; k < other.size(); ++k) {
    const double miss = std::abs(other[k] - impact.restitution[k]);
    if (miss > error.largest) {
      error.largest = miss;
      error.at = impact.velocity[k];
    }
    if (impact.restitution[k] > 0.0) error.rebounding = std::max(error.rebounding, miss);
    sum += miss * miss;
  }
  error.rms = std::sqrt(sum / static_cast<double>(other.size()));
  return error;
}

ContactForce force_of(const Approximation& approximation, const ExportedImpact& impact) {
  ContactForce force = impact.force;
  force.adhesion = AdhesionLaw::ring;
  force.adhesion_force = force.adhesion_energy = force.adhesion_damping = 0.0;
  force.hertz_damping = force.dashpot = 0.0;
  if (approximation.model == StockModel::hertz_dashpot) force.dashpot = approximation.value;
  if (approximation.model == StockModel::hunt_crossley) force.hertz_damping = approximation.value;
  return force;
}

Approximation nearest(StockModel model, const ExportedImpact& impact) {
  Approximation out;
  out.model = model;
  const std::vector<double>& e = impact.restitution;
  if (model == StockModel::constant_restitution) {
    out.value = std::accumulate(e.begin(), e.end(), 0.0) / static_cast<double>(e.size());
  } else {
    const double velocity = std::sqrt(impact.request.slowest * impact.request.fastest);
    double unit = 1.0 / velocity;  // C_H V = 1
    if (model == StockModel::hertz_dashpot) {
      // kappa = D n_c^(3/2) / (m V) = 1, with n_c^(5/2) = m V^2 / (K r^(1/2))
      const ContactForce& f = impact.force;
      const double mass = f.mass();
      const double length =
          std::pow(mass * velocity * velocity / (f.stiffness * std::sqrt(f.radius)), 0.4);
      unit = mass * velocity / std::pow(length, 1.5);
    }
    const auto rms = [&](double logarithm) {
      const Approximation tried = {model, unit * std::exp(logarithm), {}};
      return restitution_error(impact, answers(tried, impact)).rms;
    };
    out.value =
        unit * std::exp(find_minimum(rms, std::log(least_loss), std::log(most_loss), found_to));
  }
  out.error = restitution_error(impact, answers(out, impact));
  return out;
}

ExportForm form_for(ExportTarget target, const ExportedImpact& impact) {
  switch (target) {
    case ExportTarget::lammps:
    case ExportTarget::yade:
    case ExportTarget::simbody:
      return impact.force_is_all ? ExportForm::force : ExportForm::approximation;
    case ExportTarget::liggghts:
      return ExportForm::approximation;
    case ExportTarget::openfoam:
    case ExportTarget::fluent:
    case ExportTarget::table:
      break;
  }
  return ExportForm::lookup;
}

StockModel stock_model(ExportTarget target) {
  if (target == ExportTarget::lammps) return StockModel::hertz_dashpot;
  if (target == ExportTarget::simbody) return StockModel::hunt_crossley;
  return StockModel::constant_restitution;
}

}  // namespace recoil
