#include "export/approximation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

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

void require_rebounds(const ExportedImpact& impact) {
  if (std::ranges::any_of(impact.restitution, [](double e) { return e > 0.0; })) return;
  throw InputError({},
                   fmt::format("every sphere from {:.4g} to {:.4g} m/s is captured",
                               impact.request.slowest, impact.request.fastest),
                   "only rebounds determine a contact model of the program itself",
                   "state a faster range: --velocity MIN,MAX");
}

/// The parameters, all positive, with the least squares of (e^2 - e_fit^2) / (2 max(e_fit, 0.1)).
/// @param squares_for e^2 at the velocities of the impact, continued below zero for captures
std::vector<double> least_squares(
    const ExportedImpact& impact, std::vector<double> lower, std::vector<double> upper,
    std::vector<double> start,
    const std::function<std::vector<double>(std::span<const double>)>& squares_for) {
  constexpr double smallest = 0.1;  // of e, in the weights
  constexpr double step = 1e-5;     // of the logarithms, for the derivatives
  const auto residuals_at = [&](std::span<const double> theta, std::span<double> residuals) {
    const std::vector<double> squares = squares_for(theta);
    for (std::size_t k = 0; k < squares.size(); ++k) {
      const double e = impact.restitution[k];
      const double square = e > 0.0 ? squares[k] : std::max(squares[k], 0.0);
      residuals[k] = (square - e * e) / (2.0 * std::max(e, smallest));
    }
  };
  LeastSquaresProblem problem;
  problem.residual_count = impact.velocity.size();
  for (std::size_t j = 0; j < start.size(); ++j) {
    start[j] = std::clamp(start[j], 10.0 * lower[j], 0.1 * upper[j]);
  }
  problem.lower = std::move(lower);
  problem.upper = std::move(upper);
  problem.log_scale.assign(start.size(), true);
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
  LeastSquaresOptions options;
  options.finish = false;
  options.max_iterations = 200;
  const LeastSquaresResult found = minimise(problem, start, options);
  return found.theta.empty() ? start : found.theta;
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
  require_rebounds(impact);
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
      Approximation tried;
      tried.model = model;
      tried.value = unit * std::exp(logarithm);
      return restitution_error(impact, answers(tried, impact)).rms;
    };
    out.value =
        unit * std::exp(find_minimum(rms, std::log(least_loss), std::log(most_loss), found_to));
  }
  out.error = restitution_error(impact, answers(out, impact));
  return out;
}

StockJkr jkr_of(const Approximation& approximation, const ExportedImpact& impact) {
  const ContactForce& f = impact.force;
  return {f.radius, f.mass(), f.stiffness, approximation.value, approximation.energy};
}

Approximation nearest_jkr(const ExportedImpact& impact) {
  constexpr double apart = 1e3;  // of the bounds from the start
  require_rebounds(impact);
  const ContactForce& f = impact.force;
  Approximation out;
  out.model = StockModel::jkr;
  const auto at = [&](double velocity) { return impact_under(jkr_of(out, impact), velocity); };
  const double dashpot = nearest(StockModel::hertz_dashpot, impact).value;
  const double damping = dashpot / (f.mass() * std::sqrt(f.radius));
  const double energy = 0.5 * f.adhesion_energy;
  const std::vector<double> found =
      least_squares(impact, {damping / apart, energy / apart}, {damping * apart, energy * apart},
                    {damping, energy}, [&](std::span<const double> theta) {
                      out.value = theta[0];
                      out.energy = theta[1];
                      std::vector<double> squares;
                      for (const double v : impact.velocity)
                        squares.push_back(at(v).restitution_squared);
                      return squares;
                    });
  out.value = found[0];
  out.energy = found[1];
  std::vector<double> e;
  for (const double v : impact.velocity) {
    const StockImpact one = at(v);
    e.push_back(std::sqrt(std::max(one.restitution_squared, 0.0)));
    out.longest_contact = std::max(out.longest_contact, one.time);
  }
  out.error = restitution_error(impact, e);
  out.capture_velocity = capture_velocity_of([&](double v) { return at(v).restitution_squared; },
                                             impact.request.fastest);
  return out;
}

Approximation nearest_stock(ExportTarget target, const ExportedImpact& impact) {
  if (target != ExportTarget::lammps) {
    // LIGGGHTS 3.8 rejects 0.05 and less
    const double least = target == ExportTarget::liggghts ? std::nextafter(0.05, 1.0) : 0.0;
    return nearest(StockModel::constant_restitution, impact, least);
  }
  const Approximation hertz = nearest(StockModel::hertz_dashpot, impact);
  if (impact.force.adhesion_energy == 0.0) return hertz;
  const Approximation jkr = nearest_jkr(impact);
  return jkr.error.rms < hertz.error.rms ? jkr : hertz;
}

RefittedForce refitted_force(const ExportedImpact& impact) {
  RefittedForce out;
  const auto force_for = [&](std::span<const double> theta) {
    ContactForce force = impact.force;
    force.adhesion = AdhesionLaw::ring;
    force.hertz_damping = theta[0];
    force.adhesion_damping = theta[1];
    force.adhesion_force = theta[2];
    return force;
  };
  const ContactForce& f = impact.force;
  const double slow = 1.0 / impact.request.fastest;
  out.force = force_for(least_squares(impact, {1e-5 * slow, 1e-5 * slow, 1e-3 * f.adhesion_force},
                                      {1e2 * slow, 1e4 * slow, 1e3 * f.adhesion_force},
                                      {f.hertz_damping, f.adhesion_damping, f.adhesion_force},
                                      [&](std::span<const double> theta) {
                                        return squares_under(force_for(theta), impact.velocity);
                                      }));
  out.error = restitution_error(impact, restitution_under(out.force, impact.velocity));
  out.capture_velocity = capture_velocity_of(
      [&](double v) { return squares_under(out.force, {{v}}).front(); }, impact.request.fastest);
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

}  // namespace recoil
