#include "impact/deepest_contact.hpp"

#include <algorithm>
#include <cmath>

#include "core/roots.hpp"
#include "impact/admissible.hpp"
#include "impact/maugis_contact.hpp"
#include "impact/maugis_law.hpp"
#include "impact/maugis_path.hpp"
#include "impact/partial.hpp"

namespace recoil {
namespace {

/// In the units of Maugis: energies in pi W r (pi^2 W^2 r / K^2)^(1/3), a in (pi W r^2 / K)^(1/3).
/// With them m V^2 is 1 / Lambda, and (a^2 / r) / n_c is a^2 Lambda^(2/5).
struct Deepest {
  double square, square_by_strength, square_by_range;
  double stored, stored_by_strength, stored_by_range;
};

DeepestContact in_units_of_impact(const Deepest& d, const ImpactGroups& g) {
  const double strength = MaugisLaw::strength(g);
  const double by_beta = MaugisLaw::strength_slope(g);
  const double unit = std::pow(strength, 0.4);
  DeepestContact contact;
  contact.square = {d.square * unit,
                    by_beta * unit * (d.square_by_strength + 0.4 * d.square / strength),
                    d.square_by_range * unit};
  contact.stored = {d.stored * strength, by_beta * (d.stored_by_strength * strength + d.stored),
                    d.stored_by_range * strength};
  return contact;
}

/// What a law says along its path, over a coordinate (variable 0) and lambda (variable 1).
using Along = Partial<double, 3U>;
struct Place {
  Along energy, square, stored;
};

/// d energy / d lambda at the start of the impact, which itself moves with lambda.
struct Start {
  double energy, energy_slope;
};

template <class PlaceAt>
Deepest deepest_of(const PlaceAt& place_at, const Start& start, double strength, double from,
                   double to) {
  const double incident = start.energy + 0.5 / strength;
  const double deepest =
      find_root([&](double x) { return place_at(x).energy.value - incident; }, from, to);
  const Place place = place_at(deepest);
  const double per_energy = 1.0 / place.energy.derivative<0>();
  const double by_strength = -0.5 / (strength * strength) * per_energy;
  const double by_range = (start.energy_slope - place.energy.derivative<1>()) * per_energy;
  const auto along = [&](const Along& x) { return x.derivative<0>() * by_strength; };
  const auto across = [&](const Along& x) {
    return x.derivative<0>() * by_range + x.derivative<1>();
  };
  return {place.square.value, along(place.square), across(place.square),
          place.stored.value, along(place.stored), across(place.stored)};
}

Along coordinate(double x) { return variable<0>(x) + Along{}; }

/// P = a^3 - (6 a^3)^(1/2), n = a^2 - (2/3) (6 a)^(1/2). As in MaugisContact, 3 E = P n - a^2 + M,
/// M half of a^2 times the mean squares 2/5 (Hertz) and 2/3 (a flat punch); E - M is half of what
/// the bodies store.
Place jkr_at(double radius) {
  const double root6 = std::sqrt(6.0);
  const Along a = coordinate(radius);
  const Along root = sqrt(a);
  const Along square = a * a;
  const Along hertz = square * a;
  const Along pull = root6 * (a * root);
  const Along n = square + -((2.0 / 3.0 * root6) * root);
  const Along moment = (0.5 * square) * (0.4 * hertz + -(2.0 / 3.0 * pull));
  const Along energy = (1.0 / 3.0) * (n * (hertz + -pull) + -square + moment);
  return {energy, square, 2.0 * (energy + -moment)};
}

/// P = a^3 - 2, n = a^2.
Place dmt_at(double radius) {
  const Along a = coordinate(radius);
  const Along square = a * a;
  const Along stored = 0.4 * (square * square * a);
  return {stored + -2.0 * square, square, stored};
}

Place maugis_at(double s, double lambda) {
  const double gap = s < 0.0 ? 1.0 : 0.0;
  const MaugisContact<Along, Along> contact(coordinate(s), variable<1>(lambda) + Along{}, gap);
  const Along radius = contact.outer * contact.share;
  const Along energy = contact.energy();
  const Along outer = contact.outer * contact.outer;
  const Along moment =
      3.0 * energy + outer + -(contact.approach() * (contact.elastic() + -contact.adhesive()));
  return {energy, radius * radius, 2.0 * (energy + -moment)};
}

Deepest under_maugis(double strength, double lambda) {
  const MaugisPath path = maugis_path(lambda);
  const auto at = [&](double s) { return maugis_at(s, lambda); };
  const Along energy = at(path.start).energy;
  const Start start{energy.value,
                    energy.derivative<1>() + energy.derivative<0>() * path.start_slope};
  // Far in, a = (5 / (4 Lambda))^(1/5), and s is below (1 + lambda) (1 + a).
  const double radius = 2.0 + std::pow(1.25 / strength, 0.2) + std::cbrt(2.0 / lambda);
  const double far = 4.0 * (1.0 + lambda) * radius;
  return deepest_of(at, start, strength, std::max(path.start, path.resting), far);
}

Deepest deepest_under(AdhesionLaw law, double strength, double range) {
  if (law == AdhesionLaw::maugis) return under_maugis(strength, range);
  const double far = 4.0 + std::pow(1.25 / strength, 0.2) * 2.0;
  if (law == AdhesionLaw::dmt) {
    return deepest_of(dmt_at, {0.0, 0.0}, strength, std::cbrt(2.0), far);
  }
  const double touch = std::cbrt(8.0 / 3.0);
  return deepest_of(jkr_at, {jkr_at(touch).energy.value, 0.0}, strength, std::cbrt(6.0), far);
}

/// Hertz's contact: x_m = (5/4)^(2/5).
DeepestContact without_any() { return {{std::pow(1.25, 0.4), 0.0, 0.0}, {0.5, 0.0, 0.0}}; }

}  // namespace

DeepestContact deepest_contact(AdhesionLaw law, double beta, double range) {
  const ImpactGroups groups{0.0, beta, 0.0, 0.0, range};
  ImpactOptions options;
  options.adhesion = law;
  // Below the first, adhesion is less than 1e-12 of the incident energy.
  if (beta < 1e-5 || without_adhesion(groups, options)) return without_any();
  return in_units_of_impact(deepest_under(law, MaugisLaw::strength(groups), range), groups);
}

}  // namespace recoil
