#include "impact/maugis_law.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/numerics.hpp"

namespace recoil {
namespace {

using std::numbers::pi;
using Contact = MaugisContact<double, double>;
using VariedContact = MaugisContact<double, Partial<double, 1U>>;

constexpr double touching = 0.0;
constexpr double gap = 1.0;

double side_of(double s) { return s < 0.0 ? gap : touching; }

/// The s at which c is `outer` across a gap. c is linear in s^2 there.
double place_before_contact(const Contact& first_contact, double outer) {
  return -std::sqrt((first_contact.at_edge - outer) / first_contact.half_rate);
}

MaugisPath found(double lambda) {
  MaugisPath path;
  const auto at = [&](double s) { return Contact(s, lambda, touching); };
  const Contact touch = at(0.0);
  const double far = 2.0 * (1.0 + lambda);  // beyond all three places

  // Across a gap dn / dc = c - 8 lambda / (3 pi): the sphere parts where it is 0, and jumps in from
  // c = 0 to twice that c, which has the same n.
  const double parting = 8.0 * lambda / (3.0 * pi);
  path.release = parting <= touch.at_edge
                     ? place_before_contact(touch, parting)
                     : find_root([&](double s) { return at(s).rate_in_w(); }, 0.0, far);
  const double reach = 2.0 / (pi * lambda);
  path.start = 2.0 * parting <= touch.at_edge
                   ? place_before_contact(touch, 2.0 * parting)
                   : find_root([&](double s) { return at(s).approach() + reach; },
                               std::max(0.0, path.release), far);
  path.resting = find_root([&](double s) { return at(s).elastic() - at(s).adhesive(); },
                           std::max(0.0, path.release), far);
  path.scale = std::sqrt(1.0 + 2.0 / 3.0 * lambda * lambda);

  const auto varied = [&](double s) { return VariedContact(s, variable<0>(lambda), side_of(s)); };
  constexpr double smallest = 1e-9;  // a smaller start is first contact
  const double slope = 2.0 * std::max(std::abs(path.start), smallest) *
                       Contact(path.start, lambda, side_of(path.start)).rate_in_w();
  path.start_slope = (reach / lambda - varied(path.start).approach().derivative<0>()) / slope;
  const auto energy = varied(path.release).energy();
  path.energy_at_release = energy.value;
  path.energy_slope = energy.derivative<0>();
  path.energy_at_rest = at(path.resting).energy() - energy.value;
  const double side = side_of(path.release);
  const double step = 1e-4 * path.scale;
  const Contact parted(path.release, lambda, side);
  path.cusp = 0.5 * std::abs(parted.elastic() - parted.adhesive()) *
              std::abs(Contact(path.release + step, lambda, side).rate()) / step;
  return path;
}

}  // namespace

DeepestSearch MaugisLaw::deepest_search(double strength, double lambda) {
  const MaugisPath path = maugis_path(lambda);
  using OfBoth = Partial<double, 3U>;  // s and lambda
  const OfBoth energy =
      place_at(variable<0>(path.start) + OfBoth{}, variable<1>(lambda) + OfBoth{}).energy;
  // Far in, a = (5 / (4 Lambda))^(1/5), and s is below (1 + lambda) (1 + a).
  const double radius = 2.0 + std::pow(1.25 / strength, 0.2) + std::cbrt(2.0 / lambda);
  return {.start_energy = energy.value,
          .start_energy_slope = energy.derivative<1>() + energy.derivative<0>() * path.start_slope,
          .from = std::max(path.start, path.resting),
          .to = 4.0 * (1.0 + lambda) * radius};
}

MaugisPath maugis_path(double lambda) {
  // The points of a fit have few different lambda, and each is needed many times.
  struct Known {
    double lambda = 0.0;
    MaugisPath path;
  };
  constexpr std::size_t places = 64;
  thread_local std::array<Known, places> known;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(lambda) * 0x9e3779b97f4a7c15U;
  Known& place = known[bits >> 58U];
  if (place.lambda != lambda) place = {lambda, found(lambda)};
  return place.path;
}

}  // namespace recoil
