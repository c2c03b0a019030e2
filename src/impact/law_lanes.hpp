#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "impact/impact.hpp"
#include "impact/partial.hpp"
#include "impact/with_dashpot.hpp"

namespace recoil {

/// The index of ImpactGroups::range among the groups of `Law`.
template <class Law>
inline constexpr unsigned group_of_range = [] {
  unsigned k = 0;
  while (Law::places[k] != place_of_range) ++k;
  return k;
}();

/// A law of adhesion with its groups and constants, for one impact in each lane of `Pack`.
template <class Law, class Pack>
struct LawLanes {
  static constexpr unsigned parameters = Law::groups;

  std::array<Pack, Law::groups> groups = {};
  std::array<Pack, Law::constants> constants = {};

  void set(std::size_t lane, const ImpactGroups& impact) {
    const std::array<double, Law::groups> values = Law::groups_of(impact);
    for (unsigned k = 0; k < Law::groups; ++k) groups[k][lane] = values[k];
    const std::array<double, Law::constants> fixed = Law::constants_of(impact);
    for (unsigned c = 0; c < Law::constants; ++c) constants[c][lane] = fixed[c];
  }

  /// du/dsigma.
  [[gnu::always_inline]] Pack field(const Pack& q, const Pack& u, const Pack& acts) const {
    return with_all([&]<unsigned... k>(std::integer_sequence<unsigned, k...>, const auto&... c) {
      return Law::acceleration(q, u, acts, groups[k]..., c...);
    });
  }

  /// The elastic force and the dashpot of du/dsigma.
  [[gnu::always_inline]] Pack push(const Pack& q, const Pack& u) const {
    return with_all([&]<unsigned... k>(std::integer_sequence<unsigned, k...>, const auto&... c) {
      return Law::push(q, u, groups[k]..., c...);
    });
  }

  /// du/dsigma with its derivatives: variable 0 is u, variable k + 1 is group k.
  [[gnu::always_inline]] auto field_with_slopes(const Pack& q, const Pack& u,
                                                const Pack& acts) const {
    return with_all([&]<unsigned... k>(std::integer_sequence<unsigned, k...>, const auto&... c) {
      return Law::acceleration(q, variable<0>(u), acts, variable<k + 1>(groups[k])..., c...);
    });
  }

  /// -d(du/dsigma)/du, which does not depend on u: the damping.
  [[gnu::always_inline]] Pack damping(const Pack& q, const Pack& acts) const {
    return with_all([&]<unsigned... k>(std::integer_sequence<unsigned, k...>, const auto&... c) {
      return -Law::acceleration(q, variable<0>(Pack(0.0)), acts, groups[k]..., c...)
                  .template derivative<0>();
    });
  }

  /// The slope of the potential energy in q, which is -du/dsigma at rest.
  [[gnu::always_inline]] Pack slope(const Pack& q) const { return -field(q, Pack(0.0), Pack(0.0)); }

  [[gnu::always_inline]] Pack potential(const Pack& q) const {
    return with_all([&]<unsigned... k>(std::integer_sequence<unsigned, k...>, const auto&... c) {
      return Law::potential(q, groups[k]..., c...);
    });
  }

  /// The potential energy with its derivatives: variable k + 1 is group k.
  [[gnu::always_inline]] auto potential_with_slopes(const Pack& q) const {
    return with_all([&]<unsigned... k>(std::integer_sequence<unsigned, k...>, const auto&... c) {
      return Law::potential(q, variable<k + 1>(groups[k])..., c...);
    });
  }

  /// Writes e^2 and its gradient for the end of the impact in `lane` at q and u. area(k) is the D
  /// of group k (see StepSolver).
  template <class Area>
  void write(std::size_t lane, const ImpactGroups& impact, double q, double u, bool gradient,
             const Area& area, ImpactResult& result) const {
    [&]<unsigned... k, unsigned... c>(std::integer_sequence<unsigned, k...>,
                                      std::integer_sequence<unsigned, c...>) {
      const Partial<double, (1U << parameters) - 1U> none{};
      const auto potential = Law::potential(q, variable<k>(double(groups[k][lane]))...,
                                            double(constants[c][lane])...) +
                             none;
      result.restitution_squared = u * u + 2.0 * potential.value;
      if (gradient) {
        result.gradient =
            impact_gradient<Law>(impact, {2.0 * (area(k) + potential.template derivative<k>())...});
      }
    }
    (std::make_integer_sequence<unsigned, parameters>{},
     std::make_integer_sequence<unsigned, Law::constants>{});
    result.outcome =
        result.restitution_squared > 0.0 ? ImpactOutcome::rebound : ImpactOutcome::captured;
  }

 private:
  template <class Act>
  [[gnu::always_inline]] auto with_all(const Act& act) const {
    return [&]<unsigned... c>(std::integer_sequence<unsigned, c...>) {
      return act(std::make_integer_sequence<unsigned, parameters>{}, constants[c]...);
    }
    (std::make_integer_sequence<unsigned, Law::constants>{});
  }
};

}  // namespace recoil
