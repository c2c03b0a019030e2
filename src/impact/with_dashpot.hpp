#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <utility>

#include "impact/force_law.hpp"

namespace recoil {

/// A law of adhesion with a dashpot on its elastic part in both phases. If a^2 = r n, its force is
/// -kappa x^(1/2) u, and two mechanisms have exactly this form. A viscoelastic bulk (Kuwabara &
/// Kono 1987; Brilliantov et al. 1996): the force -(3/2) A K sqrt(r n) n' gives kappa = (3/2) A V /
/// n_c. A thin plate that yields with the velocity F / Z (Zener 1941): n'' = -F / m - F' / Z with F
/// = K sqrt(r) n^(3/2) gives kappa = (3/2) m V / (Z n_c).
///
/// If adhesion widens the contact, both are the time derivative of the elastic force, -A d(K a^3 /
/// r) / dt (JkrLaw::dashpot_weight), which always dissipates energy. Brilliantov et al. (2007),
/// Phys. Rev. E 76, 051302, use the derivative of the whole JKR force including adhesion, which
/// would supply energy between the largest pull and the end of the contact.
///
/// The bulk cannot pull: with ImpactOptions::never_pulls, elastic force and dashpot together are 0
/// from where they would (Schwager, T. & Poeschel, T. (2008), Phys. Rev. E 78, 051304), while the
/// adhesion still pulls. The plate moves away instead; its contact ends with the elastic force.
template <class Law>
struct WithDashpot {
  static constexpr unsigned groups = Law::groups + 1;  ///< those of Law, then kappa
  static_assert(Law::constants == 0);
  /// 1 while the elastic force and the dashpot act, 0 while they would pull and do not.
  static constexpr unsigned constants = 1;
  static constexpr std::array<std::size_t, groups> places = [] {
    std::array<std::size_t, groups> all = {};
    for (std::size_t k = 0; k < Law::groups; ++k) all[k] = Law::places[k];
    all[Law::groups] = place_of_kappa;
    return all;
  }();
  static constexpr double tolerance_share = Law::tolerance_share;

  static double strength(const ImpactGroups& g) { return Law::strength(g); }
  static double strength_slope(const ImpactGroups& g) { return Law::strength_slope(g); }
  static std::array<double, groups> groups_of(const ImpactGroups& g) {
    std::array<double, groups> all = {};
    const std::array<double, Law::groups> own = Law::groups_of(g);
    for (std::size_t k = 0; k < Law::groups; ++k) all[k] = own[k];
    all[Law::groups] = g.kappa * Law::dashpot_unit(g);
    return all;
  }
  static std::array<double, constants> constants_of(const ImpactGroups&) { return {1.0}; }
  static LawPath path_of(const ImpactGroups& g) { return Law::path_of(g); }

  template <class Q, class U, class Acts, class... Values>
  [[gnu::always_inline]] static constexpr auto acceleration(const Q& q, const U& u,
                                                            const Acts& acts,
                                                            const Values&... values) {
    return without_kappa(
        [&](const auto&, const auto&... own) {
          return std::get<groups>(std::tie(values...)) * push(q, u, values...) +
                 Law::pull(q, u, acts, own...);
        },
        values...);
  }
  /// The elastic force and the dashpot alone.
  template <class Q, class U, class... Values>
  [[gnu::always_inline]] static constexpr auto push(const Q& q, const U& u,
                                                    const Values&... values) {
    return without_kappa(
        [&](const auto& kappa, const auto&... own) {
          return Law::push(q, u, own...) + -(Law::dashpot_weight(q, own...) * (kappa * u));
        },
        values...);
  }
  template <class Q, class... Values>
  [[gnu::always_inline]] static constexpr auto potential(const Q& q, const Values&... values) {
    return without_kappa([&](const auto&, const auto&... own) { return Law::potential(q, own...); },
                         values...);
  }
  static double depth(const ImpactGroups& g) { return Law::depth(g); }

  static constexpr double dashpot_power = Law::dashpot_power;
  static double dashpot_unit(const ImpactGroups& g) { return Law::dashpot_unit(g); }
  template <class Q, class... Values>
  static constexpr auto dashpot_weight(const Q& q, const Values&... values) {
    return without_kappa(
        [&](const auto&, const auto&... own) { return Law::dashpot_weight(q, own...); }, values...);
  }

  template <class... Values>
  static double penetration(double q, const Values&... values) {
    return without_kappa([&](double, auto... own) { return Law::penetration(q, own...); },
                         values...);
  }
  template <class... Values>
  static double clock(double q, const Values&... values) {
    return without_kappa([&](double, auto... own) { return Law::clock(q, own...); }, values...);
  }
  template <class... Values>
  static auto forces(double q, double u, double acts, const Values&... values) {
    return without_kappa([&](double, auto... own) { return Law::forces(q, u, acts, own...); },
                         values...);
  }
  template <class... Values>
  static double largest_energy(double q, const Values&... values) {
    return without_kappa([&](double, auto... own) { return Law::largest_energy(q, own...); },
                         values...);
  }
  static double cusp_radius(const ImpactGroups& g, double energy) {
    return Law::cusp_radius(g, energy);
  }

 private:
  /// Calls act(kappa, the values that Law takes...).
  template <class Act, class... Values>
  [[gnu::always_inline]] static constexpr auto without_kappa(Act&& act, const Values&... values) {
    const auto all = std::forward_as_tuple(values...);
    return [&]<std::size_t... g>(std::index_sequence<g...>) {
      return act(std::get<Law::groups>(all), std::get<g>(all)...);
    }
    (std::make_index_sequence<Law::groups>{});
  }
};

/// Converts derivatives of e^2 in the groups of `Law` to ImpactResult::gradient. It is always
/// inline, because kernels for different instruction sets must not share it.
template <class Law>
[[gnu::always_inline]] inline std::array<double, 5> impact_gradient(
    const ImpactGroups& g, const std::array<double, Law::groups>& by) {
  std::array<double, 5> gradient = {};
  for (std::size_t k = 0; k < Law::groups; ++k) gradient[Law::places[k]] = by[k];
  gradient[1] *= Law::strength_slope(g);
  if constexpr (Law::places.back() == place_of_kappa) {
    const double unit = Law::dashpot_unit(g);
    if (Law::dashpot_power != 0.0 && g.beta > 0.0) {
      gradient[1] += gradient[place_of_kappa] * g.kappa * unit * Law::dashpot_power / g.beta;
    }
    gradient[place_of_kappa] *= unit;
  }
  return gradient;
}

}  // namespace recoil
