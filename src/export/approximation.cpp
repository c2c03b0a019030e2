#include "export/approximation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/numerics.hpp"
#include "estimate/least_squares.hpp"

namespace recoil {
namespace {

constexpr double least_loss = 1e-6;  // bounds of kappa in the search for the best value
constexpr double most_loss = 1e3;
constexpr double found_to = 1e-4;  // relative error of the value

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
  force.never_pulls = false;
  if (approximation.model == StockModel::hertz_dashpot) force.dashpot = approximation.value;
  return force;
}

Approximation nearest(StockModel model, const ExportedImpact& impact, double least_restitution) {
  if (std::ranges::all_of(impact.restitution, [](double e) { return e == 0.0; })) {
    throw InputError({},
                     fmt::format("every sphere from {:.4g} to {:.4g} m/s is captured",
                                 impact.request.slowest, impact.request.fastest),
                     "the contact models of the program itself capture none",
                     "state a faster range: --velocity MIN,MAX");
  }
  Approximation out;
  out.model = model;
  const std::vector<double>& e = impact.restitution;
  if (model == StockModel::constant_restitution) {
    const double mean = std::accumulate(e.begin(), e.end(), 0.0) / static_cast<double>(e.size());
    out.value = std::max(mean, least_restitution);
  } else {
    const double velocity = std::sqrt(impact.request.slowest * impact.request.fastest);
    // kappa = D n_c^(3/2) / (m V) = 1, with n_c^(5/2) = m V^2 / (K r^(1/2))
    const ContactForce& f = impact.force;
    const double mass = f.mass();
    const double length =
        std::pow(mass * velocity * velocity / (f.stiffness * std::sqrt(f.radius)), 0.4);
    const double unit = mass * velocity / std::pow(length, 1.5);
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

RefittedForce refitted_force(const ExportedImpact& impact) {
  constexpr double smallest = 0.1;  // of e, in the weights
  constexpr double step = 1e-5;     // of the logarithms, for the derivatives
  RefittedForce out;
  const auto force_for = [&](std::span<const double> theta) {
    ContactForce force = impact.force;
    force.adhesion = AdhesionLaw::ring;
    force.hertz_damping = theta[0];
    force.adhesion_damping = theta[1];
    force.adhesion_force = theta[2];
    return force;
  };
  const auto residuals_at = [&](std::span<const double> theta, std::span<double> residuals) {
    const std::vector<double> squares = squares_under(force_for(theta), impact.velocity);
    for (std::size_t k = 0; k < squares.size(); ++k) {
      const double e = impact.restitution[k];
      const double square = e > 0.0 ? squares[k] : std::max(squares[k], 0.0);
      residuals[k] = (square - e * e) / (2.0 * std::max(e, smallest));
    }
  };
  LeastSquaresProblem problem;
  problem.residual_count = impact.velocity.size();
  const double slow = 1.0 / impact.request.fastest;
  problem.lower = {1e-5 * slow, 1e-5 * slow, 1e-3 * impact.force.adhesion_force};
  problem.upper = {1e2 * slow, 1e4 * slow, 1e3 * impact.force.adhesion_force};
  problem.log_scale = {true, true, true};
  problem.evaluate = [&](std::span<const double> theta, std::span<double> residuals,
                         std::span<double> jacobian) {
    residuals_at(theta, residuals);
    if (jacobian.empty()) return true;
    std::vector<double> moved(residuals.size());
    for (std::size_t j = 0; j < theta.size(); ++j) {
      std::vector<double> there(theta.begin(), theta.end());
      there[j] *= 1.0 + step;
      residuals_at(there, moved);
      for (std::size_t k = 0; k < residuals.size(); ++k) {
        jacobian[k * theta.size() + j] = (moved[k] - residuals[k]) / (step * theta[j]);
      }
    }
    return true;
  };
  std::vector<double> start = {impact.force.hertz_damping, impact.force.adhesion_damping,
                               impact.force.adhesion_force};
  for (std::size_t j = 0; j < start.size(); ++j) {
    start[j] = std::clamp(start[j], 10.0 * problem.lower[j], 0.1 * problem.upper[j]);
  }
  LeastSquaresOptions options;
  options.finish = false;
  options.max_iterations = 200;
  const LeastSquaresResult found = minimise(problem, start, options);
  out.force = force_for(found.theta.empty() ? start : found.theta);
  out.error = restitution_error(impact, restitution_under(out.force, impact.velocity));
  out.capture_velocity = capture_velocity_under(out.force, impact.request.fastest);
  return out;
}

ExportForm form_for(ExportTarget target, const ExportedImpact& impact, bool stock) {
  switch (target) {
    case ExportTarget::lammps:
    case ExportTarget::yade:
      if (stock) return ExportForm::approximation;
      if (impact.force_is_all) return ExportForm::force;
      // the refitted force starts from the adhesion of the fit
      return impact.force.adhesion_force > 0.0 ? ExportForm::refitted : ExportForm::approximation;
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
  return StockModel::constant_restitution;
}

double least_restitution(ExportTarget target) {
  return target == ExportTarget::liggghts ? std::nextafter(0.05, 1.0) : 0.0;
}

}  // namespace recoil
