#pragma once

#include <cmath>
#include <complex>

/// A second integrator that shares nothing with the library: classical Runge-Kutta 4 with a small
/// fixed step, over any scalar (complex numbers give derivatives without differencing).
namespace independent {

inline double real_part(double x) { return x; }
inline double real_part(const std::complex<double>& x) { return x.real(); }

template <class T>
struct Groups {
  T alpha, beta, gamma;
  T kappa = T(0.0);
  bool never_pulls = false;  ///< elastic force and dashpot together push or are 0
};

/// Twice the mechanical energy at release or at the first outer turning point, in units of m V^2.
template <class T>
T twice_energy_left(const Groups<T>& g, bool damps_in_both_phases, double step = 1e-3) {
  bool rebound_phase = false;
  const auto slope = [&](const T& q, const T& u) -> T {
    const T damping = (rebound_phase || damps_in_both_phases) ? T(1.0) - g.gamma * u : T(1.0);
    T push = q * q * (1.0 + g.alpha * u) + g.kappa * u;
    if (g.never_pulls && real_part(push) < 0.0) push = T(0.0);
    return 2.0 * q * q * (g.beta * damping - push);
  };
  // mode 0: steps of sigma; 1: steps of u (dq/du = u/f); 2: steps of q (du/dq = f/u)
  const auto advance = [&](T& q, T& u, const T& h, int mode) {
    const auto rates = [&](const T& a, const T& b, T& da, T& db) {
      const T f = slope(a, b);
      da = mode == 0 ? b : mode == 1 ? T(b / f) : T(1.0);
      db = mode == 0 ? f : mode == 1 ? T(1.0) : T(f / b);
    };
    T qa, ua, qb, ub, qc, uc, qd, ud;
    rates(q, u, qa, ua);
    rates(q + 0.5 * h * qa, u + 0.5 * h * ua, qb, ub);
    rates(q + 0.5 * h * qb, u + 0.5 * h * ub, qc, uc);
    rates(q + h * qc, u + h * uc, qd, ud);
    q += h / 6.0 * (qa + 2.0 * qb + 2.0 * qc + qd);
    u += h / 6.0 * (ua + 2.0 * ub + 2.0 * uc + ud);
  };
  T q(0.0);
  T u(1.0);
  for (;;) {
    T next_q = q;
    T next_u = u;
    advance(next_q, next_u, T(step), 0);
    const bool turns = rebound_phase ? real_part(next_u) >= 0.0 : real_part(next_u) <= 0.0;
    const bool leaves = rebound_phase && real_part(next_q) <= 0.0;
    if (leaves) {
      for (int i = 4; i > 0; --i) advance(q, u, T(-q / static_cast<double>(i)), 2);
      break;
    }
    if (turns) {
      for (int i = 4; i > 0; --i) advance(q, u, T(-u / static_cast<double>(i)), 1);
      if (rebound_phase) break;
      rebound_phase = true;
      continue;
    }
    q = next_q;
    u = next_u;
  }
  return u * u + 0.8 * q * q * q * q * q - 4.0 / 3.0 * g.beta * q * q * q;
}

}  // namespace independent
