#include <cassert>
#include <cmath>
#include <type_traits>

#include "core/numerics.hpp"
#include "impact/impact.hpp"
#include "impact/laws.hpp"

namespace recoil {
namespace {

/// Numbers with derivatives in the coordinate of the law (variable 0) and in lambda (variable 1).
using Varied = Partial<double, 3U>;

/// m V^2 is 1 / Lambda in the units of Maugis, Lambda = MaugisLaw::strength. At the deepest point
/// all of the incident energy 1 / (2 Lambda) is potential energy.
template <class Law>
DeepestContact deepest_under(const ImpactGroups& g) {
  const double strength = MaugisLaw::strength(g);
  const DeepestSearch search = Law::deepest_search(strength, g.range);
  const auto place_at = [&](double x) {
    return Law::place_at(variable<0>(x) + Varied{}, variable<1>(g.range) + Varied{});
  };
  const double incident = search.start_energy + 0.5 / strength;
  const double deepest = find_root([&](double x) { return place_at(x).energy.value - incident; },
                                   search.from, search.to);
  const LawPlace<Varied> place = place_at(deepest);
  const double per_energy = 1.0 / place.energy.template derivative<0>();
  const double by_strength = -0.5 / (strength * strength) * per_energy;
  const double by_range =
      (search.start_energy_slope - place.energy.template derivative<1>()) * per_energy;
  const double by_beta = MaugisLaw::strength_slope(g);
  // (a^2 / r) / n_c is a^2 Lambda^(2/5).
  const double unit = std::pow(strength, 0.4);
  const auto along_strength = [&](const Varied& x) {
    return x.template derivative<0>() * by_strength;
  };
  const auto along_range = [&](const Varied& x) {
    return x.template derivative<0>() * by_range + x.template derivative<1>();
  };
  const Varied& square = place.square;
  const Varied& stored = place.stored;
  DeepestContact contact;
  contact.square = {square.value * unit,
                    by_beta * unit * (along_strength(square) + 0.4 * square.value / strength),
                    along_range(square) * unit};
  contact.stored = {stored.value * strength,
                    by_beta * (along_strength(stored) * strength + stored.value),
                    along_range(stored) * strength};
  return contact;
}

/// Hertz's contact: x_m = (5/4)^(2/5).
DeepestContact without_any() { return {{std::pow(1.25, 0.4), 0.0, 0.0}, {0.5, 0.0, 0.0}}; }

}  // namespace

DeepestContact deepest_contact(AdhesionLaw law, double beta, double range) {
  const ImpactGroups groups{0.0, beta, 0.0, 0.0, range};
  ImpactOptions options;
  options.adhesion = law;
  // Below this beta, adhesion is less than 1e-12 of the incident energy.
  if (beta < 1e-5 || without_adhesion(groups, options)) return without_any();
  return with_law(law, [&]<class Law>() {
    if constexpr (std::is_same_v<Law, RingAdhesionLaw>) {
      assert(false && "Encounter::deepest has it in closed form");
      return without_any();
    } else {
      return deepest_under<Law>(groups);
    }
  });
}

}  // namespace recoil
