#pragma once

#include <cmath>
#include <numbers>
#include <type_traits>

#include "impact/laws.hpp"
#include "mechanism/encounter.hpp"

namespace recoil {

/// The edge of a contact in the coordinate q of a law: a^2 in R n_c, and da/dn in (R / n_c)^(1/2).
template <class Law, class N>
struct Edge {  // a^2 = R n, n = q^2 n_c
  explicit Edge(const N&) {}
  N square(const N& q) const { return q * q; }
  N square_slope(const N& q) const { return 2.0 * q; }
  N rate(const N& q) const { return 0.5 / q; }
};
/// a = unit (q + 1)^2. From the greatest pull on, (q + 1)^3 = 3, the crack runs ahead of the
/// sphere: there da/dn is taken to stay.
template <class N>
struct Edge<JkrLaw, N> {
  N unit;
  explicit Edge(const N& strength) : unit(power(0.25 * strength, 0.2)) {}
  N square(const N& q) const {
    const N z2 = (q + 1.0) * (q + 1.0);
    return unit * unit * (z2 * z2);
  }
  N square_slope(const N& q) const {
    const N z = q + 1.0;
    return 4.0 * (unit * unit * (z * z * z));
  }
  N rate(const N& q) const {
    const double pull = std::cbrt(3.0);
    const N z = value_of(q) + 1.0 > pull ? q + 1.0 : N(pull);
    return 0.5 * z / (unit * (z * z * z - 1.0));
  }
};

/// An impact in which opening takes the work `opening` (da/dn |u|)^k per area, all scaled.
template <class Law, class N>
struct OpeningContact {
  N alpha, strength, gamma, kappa;  ///< groups of the base model
  N opening, exponent;              ///< the work of opening, and k

  /// e^2 with this work less e^2 without. On the way in the equation of motion of `Law` is solved
  /// by Runge and Kutta's method in its regularised time. On the way out the energy H = u^2 / 2 +
  /// U(q) falls by
  ///   dH = (damping(q) |u| + opening (da/dn |u|)^k d(a^2)/dq) dq,
  /// solved by the same method over t, q = q_d cos^2(t), from rest at the deepest point q_d. A
  /// sphere that turns back has 2 U there, below zero, as in the base impact.
  N change(const LawPath& path) const {
    const N deepest = deepest_point(path);
    return 2.0 * (left_over(deepest, true) - left_over(deepest, false));
  }

 private:
  static constexpr int steps = 32;

  N push(const N& q, const N& u, double acts) const {
    return N(Law::acceleration(q, u, acts, alpha, strength, gamma)) -
           N(Law::dashpot_weight(q, alpha, strength, gamma)) * (kappa * u);
  }
  N potential(const N& q) const { return N(Law::potential(q, alpha, strength, gamma)); }

  N deepest_point(const LawPath& path) const {
    N q(path.start), u(1.0), next_q, next_u;
    const auto step = [&](double h) {
      const N ka = push(q, u, 0.0);
      const N ub = u + 0.5 * h * ka;
      const N kb = push(q + 0.5 * h * u, ub, 0.0);
      const N uc = u + 0.5 * h * kb;
      const N kc = push(q + 0.5 * h * ub, uc, 0.0);
      const N ud = u + h * kc;
      const N kd = push(q + h * uc, ud, 0.0);
      next_q = q + h / 6.0 * (u + 2.0 * ub + 2.0 * uc + ud);
      next_u = u + h / 6.0 * (ka + 2.0 * kb + 2.0 * kc + kd);
      return value_of(next_u) > 0.0;
    };
    const double well = value_of(potential(q)) - value_of(potential(N(path.resting)));
    const double h = 1.5 * (path.deepest - path.start) / (std::sqrt(1.0 + 2.0 * well) * steps);
    for (int i = 0; i < 100 * steps && step(h); ++i) {
      q = next_q;
      u = next_u;
    }
    // The part of the last step that ends at u = 0, by Newton's rule. There q does not depend on
    // it.
    double part = 0.0;
    for (int i = 0; i < 6; ++i) {
      step(part);
      part -= value_of(next_u) / value_of(push(next_q, next_u, 0.0));
    }
    step(part);
    return next_q;
  }

  /// H at the end.
  N left_over(const N& deepest, bool opens) const {
    const Edge<Law, N> edge(strength);
    const double dt = 0.5 * std::numbers::pi / steps;
    const auto loss = [&](double t, const N& energy) {  // - dH / dt
      const N q = deepest * (std::cos(t) * std::cos(t));
      const N square = 2.0 * (energy - potential(q));
      if (!(value_of(square) > 0.0)) return N(0.0);
      const N speed = sqrt(square);
      N rate = (push(q, N(-1.0), 1.0) - push(q, N(0.0), 1.0)) * speed;
      if (opens) {
        rate += opening * exponential(exponent * logarithm(edge.rate(q) * speed)) *
                edge.square_slope(q);
      }
      return rate * deepest * std::sin(2.0 * t);
    };
    N energy = potential(deepest);
    for (int i = 0; i < steps; ++i) {
      const double t = i * dt;
      const N ka = loss(t, energy);
      const N kb = loss(t + 0.5 * dt, energy - 0.5 * dt * ka);
      const N kc = loss(t + 0.5 * dt, energy - 0.5 * dt * kb);
      const double end = i + 1 == steps ? 0.0 : std::cos(t + dt);
      const N kd = end > 0.0 ? loss(t + dt, energy - dt * kc) : N(0.0);
      energy -= dt / 6.0 * (ka + 2.0 * kb + 2.0 * kc + kd);
      const N q = deepest * (end * end);
      const N lacks = potential(q) - energy;
      if (!(value_of(lacks) > 0.0)) continue;
      // The force at rest: that of the opening holds only where it does not depend on the speed.
      const bool holds = opens && value_of(exponent) == 0.0;
      N force = push(q, N(0.0), 1.0);
      if (holds) force += opening * edge.square_slope(q);
      if (value_of(force) < 0.0) {  // it creeps on
        energy += lacks;
        continue;
      }
      // It turned back, and lacks the work that opens the rest.
      if (holds) energy -= opening * (edge.square(q) - edge.square(N(0.0)));
      break;
    }
    return energy;
  }
};

/// What e.square loses because opening the contact takes the work w (v_c / (1 m/s))^k per area on
/// the way out, v_c = |da/dt|, beside what the base model has [m2/s2]. The loss slows the sphere
/// while it acts, so that the base model's damping and the opening itself take less. The base
/// model's adhesion damping is taken to act on the way out.
/// @pre the law of adhesion is not maugis
template <class T>
T opening_loss(const Encounter<T>& e, const T& work, const T& exponent) {
  using N = std::conditional_t<std::is_same_v<T, double>, double, Dual<6>>;
  constexpr double most_kappa = 12.0;  // of a sphere that its dashpot stops altogether
  const T scale = e.scale();
  const T beta = e.beta();
  const T alpha = e.hertz_damping * e.velocity;
  const T gamma = e.adhesion_damping * e.velocity;
  const T kappa = 1.5 * e.relaxation * e.velocity / scale;
  if (value_of(kappa) > most_kappa) return T(0.0);
  const T opening = std::numbers::pi * e.contact_radius * scale /
                    (e.mass() * e.velocity * e.velocity) * work *
                    exponential(exponent * logarithm(e.velocity * sqrt(e.contact_radius / scale)));
  const ImpactGroups groups{value_of(alpha), value_of(beta), value_of(gamma), value_of(kappa), 0.0};
  const auto under = [&]<class Law>() {
    const double unit = Law::dashpot_unit(groups);
    const auto variable = [](double at, [[maybe_unused]] std::size_t k) {
      if constexpr (std::is_same_v<N, double>) {
        return at;
      } else {
        return N(at, k);
      }
    };
    const OpeningContact<Law, N> contact{
        variable(groups.alpha, 0),      variable(Law::strength(groups), 1),
        variable(groups.gamma, 2),      variable(groups.kappa * unit, 3),
        variable(value_of(opening), 4), variable(value_of(exponent), 5)};
    const N found = contact.change(Law::path_of(groups));
    T change(value_of(found));
    if constexpr (!std::is_same_v<N, double>) {
      double by_beta = found.slope[1] * Law::strength_slope(groups);
      if (groups.beta > 0.0) {
        by_beta += found.slope[3] * groups.kappa * unit * Law::dashpot_power / groups.beta;
      }
      add_slopes(change, found.slope[0], alpha);
      add_slopes(change, by_beta, beta);
      add_slopes(change, found.slope[2], gamma);
      add_slopes(change, found.slope[3] * unit, kappa);
      add_slopes(change, found.slope[4], opening);
      add_slopes(change, found.slope[5], exponent);
    }
    return change;
  };
  T change(0.0);
  switch (e.at->adhesion) {
    case AdhesionLaw::ring:
      change = under.template operator()<RingAdhesionLaw>();
      break;
    case AdhesionLaw::jkr:
      change = under.template operator()<JkrLaw>();
      break;
    case AdhesionLaw::dmt:
      change = under.template operator()<DmtLaw>();
      break;
    case AdhesionLaw::maugis:
      break;
  }
  return -1.0 * change * (e.velocity * e.velocity);
}

}  // namespace recoil
