#include <vector>

#include "core/numerics.hpp"
#include "core/units.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

constexpr double no_drag_below = 10.0;  // [Pa]

/// Drag of a sphere at the speed v divided by m g v, 3 rho_a C_d v / (4 rho d g) [s/m], with the
/// C_d of `AirFlight`.
template <class T>
class Flight {
 public:
  Flight(const Encounter<T>& e, const T& pressure) {
    const Air air = e.air();
    reynolds_ = pressure * e.diameter * (air.density() / air.viscosity());
    stokes_ = e.slip(pressure) / (e.diameter * e.diameter) *
              (18.0 * air.viscosity() / (e.density * standard_gravity));
  }
  T drag(const T& speed) const {
    constexpr double still = 1e-9;  // keeps slopes finite without gas
    const T re = reynolds_ * speed + still;
    const auto [over_stokes, slope] = sphere_drag(value_of(re));
    return stokes_ * compose(re, over_stokes, slope);
  }

 private:
  T reynolds_;  ///< at 1 m/s
  T stokes_;    ///< [s/m]
};

/// v^2 after a fall from rest over the height `fall` / 2g. With k = drag / v, y = v^2 and u = 2 g
/// h, y' = 1 - k y; a step uses the k of its middle. Steps are equal in h^(1/2), which is roughly
/// equal in time.
template <class T>
T fallen(const Flight<T>& flight, const T& fall) {
  constexpr int steps = 40;
  T y = fall * (1.0 / (steps * steps));  // the first step without drag
  {
    const T speed = sqrt(y * 0.5);
    const T k = flight.drag(speed) / speed;
    y = -1.0 * exponential_less_one(-1.0 * k * y) / k;  // the same with drag
  }
  for (int i = 1; i < steps; ++i) {
    const T step = fall * ((2.0 * i + 1.0) / (steps * steps));
    const T here = sqrt(y);
    const T k = flight.drag(here) / here;
    const T half = exponential_less_one(-0.5 * k * step);
    const T middle = sqrt(y + half * (y - 1.0 / k));
    const T q = flight.drag(middle) / middle;
    y += exponential_less_one(-1.0 * q * step) * (y - 1.0 / q);
  }
  return y;
}

/// 2 g times the height that a sphere of the speed v reaches: the integral of dy / (1 + drag v).
template <class T>
T risen(const Flight<T>& flight, const T& square) {
  static const std::vector<QuadratureNode> nodes = gauss_legendre(8);
  const T speed = sqrt(square);
  T sum(0.0);
  for (const auto& [at, weight] : nodes) {
    const T v = at * speed;
    sum += (2.0 * at * weight) / (1.0 + flight.drag(v) * v);
  }
  return square * sum;
}

struct FlightDrag {
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    const Flight<T> flight(e, own[0]);
    const T v = e.velocity;
    if (value_of(own[0]) == 0.0) {
      // The lost speed to first order in the pressure: (1 - v^2 / V^2) / 2 is the integral of the
      // drag over the fall, (1/3) drag V for a constant drag per speed.
      e.velocity -= flight.drag(v) * v * v * (1.0 / 3.0);
      return;
    }
    e.velocity = sqrt(fallen(flight, T(v * v)));
  }
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    if (!(value_of(e.square) > 0.0)) return;
    e.square = risen(Flight<T>(e, own[0]), e.square);
  }
};

}  // namespace

Mechanism flight_drag() {
  return make_mechanism<FlightDrag>({
      .id = "flight_drag",
      .title = "air drag on spheres that fall and rise freely",
      .place = MechanismPlace::gas,
      .needs_flat = true,
      .formula = "velocities are computed from heights h = V^2 / 2g. The sphere falls from h with "
                 "d(v^2) / dx = 2 g - D, D = (3/2) (rho_a / rho) (C_d / d) v^2, and rises after "
                 "the contact with -2 g - D to the height that is read. C_d = (24 / Re) (1 + 0.150 "
                 "Re^0.681) + 0.407 / (1 + 8710 / Re), with Cunningham's slip correction; density, "
                 "viscosity and mean free path of air at the stated temperature, else at 293 K",
      .source = "Brown, P. P. & Lawler, D. F. (2003), J. Environ. Eng. 129, 222-231 (C_d of a "
                "sphere, Re < 2e5), the same drag as in recoil import. Buoyancy does not change "
                "the ratio of the heights and is neglected; so is the added mass, rho_a / 2 rho",
      .fingerprint = "1 - e^2 ~ V^2 d^(-1) at Re > 1000, V d^(-2) at Re < 1, independent of the "
                     "target; resembles C_H if velocities come from heights; vanishes in vacuum",
      .parameters = {{.name = "flight_pressure",
                      .unit = "Pa",
                      .meaning = "pressure of the air",
                      .initial = 3e4,
                      .upper = 1e6,
                      .plausible = {0.0, 1.1e5, "an experiment in open air has 1e5 Pa"},
                      .starts = {3e3, 1e5},
                      .limit = {.quantity = "height V^2 / 2g of the highest drop, over 20 m,",
                                .upper = 1.0,
                                .why = "faster impacts are not those of spheres that were dropped",
                                .of =
                                    [](const Encounter<double>& sphere, std::span<const double>) {
                                      const double v = sphere.velocity;
                                      return v * v / (2.0 * standard_gravity) / 20.0;
                                    }},
                      // An import may have corrected flights through air of a stated pressure.
                      .stated_by = {{.condition = Condition::ambient_pressure,
                                     .zero_up_to = no_drag_below}}}},
      .methods = {Method::drop_heights, Method::bounce_intervals},
      .taken_away =
          TakenAway{Condition::ambient_pressure, no_drag_below, "pump the chamber to below 10 Pa"},
  });
}

}  // namespace recoil
