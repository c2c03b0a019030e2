#include "validation/synthetic/effects.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/synthetic/runge_kutta.hpp"
#include "validation/truth/elastoplastic_truth.hpp"

namespace recoil::hidden {
namespace {

using std::numbers::pi;

constexpr double permittivity = 8.854e-12;  // of vacuum [F/m]
constexpr double surface_tension = 0.0728;  // of water at 20 C [N/m]
constexpr double viscosity = 1.81e-5;       // of air at 20 C [Pa s]
constexpr double gas_density = 1.204;       // of air at 20 C and 1 bar [kg/m3]
constexpr double free_path = 66e-9;         // there [m]
constexpr double bar = 101325.0;            // [Pa]

/// A jump: how long it lasts, and the speed at its end.
struct Jump {
  double time = 0.0;     ///< [s]
  double landing = 0.0;  ///< [m/s]
};

/// A dropped sphere in air.
class Flight {
 public:
  /// @param pressure of the air [Pa] @param density of the sphere [kg/m3]
  Flight(double pressure, double density, double diameter)
      : share_(pressure / bar), density_(density), diameter_(diameter) {}

  /// Speed after a fall from rest over `height`; y = height that is left, speed.
  double fallen(double height) const {
    State<2> y = {height, 0.0};
    const double speed = std::sqrt(2.0 * gravity * height);
    const auto field = [&](const State<2>& at) -> State<2> {
      return {-at[1], gravity - drag(std::max(at[1], 0.0))};
    };
    return reaches_zero<2>(field, 0, y, speed, {height, speed}) ? y[1] : 0.0;
  }

  /// Height that it reaches; y = speed, height.
  double risen(double speed) const {
    State<2> y = {speed, 0.0};
    const auto field = [&](const State<2>& at) -> State<2> {
      return {-gravity - drag(std::max(at[0], 0.0)), at[0]};
    };
    return reaches_zero<2>(field, 0, y, speed, {speed, speed * speed / gravity}) ? y[1] : 0.0;
  }

  /// Speed at the end of a jump that lasts as long as one without air that lands at `speed`.
  double landed(double speed) const {
    const double time = 2.0 * speed / gravity;
    double from = speed;
    Jump found;
    for (int round = 0; round < 12; ++round) {  // the time is about proportional to the speed
      found = jump(from);
      if (!(found.time > 0.0)) return 0.0;
      from *= time / found.time;
    }
    return std::abs(found.time - time) < 1e-6 * time ? found.landing : 0.0;
  }

  /// Speed at which a jump without air would last as long as one that begins at `speed`.
  double lasted(double speed) const { return 0.5 * gravity * jump(speed).time; }

 private:
  /// Deceleration by the air [m/s2]: Schiller & Naumann (1933) up to Re = 1000, C_d = 0.44 beyond.
  double drag(double speed) const {
    const double reynolds = gas_density * share_ * diameter_ * speed / viscosity;
    const double knudsen = 2.0 * free_path / (share_ * diameter_);
    const double slip = 1.0 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen));
    const double stokes = 18.0 * viscosity * speed / (density_ * diameter_ * diameter_ * slip);
    return stokes *
           (reynolds < 1000.0 ? 1.0 + 0.15 * std::pow(reynolds, 0.687) : 0.44 / 24.0 * reynolds);
  }

  /// Moves `y` to where its component falls to zero. @param speed of the flight @param size of y
  template <std::size_t N, class Field>
  static bool reaches_zero(const Field& field, std::size_t component, State<N>& y, double speed,
                           const State<N>& size) {
    const auto event = [component](const State<N>& at) { return at[component]; };
    return integrate_until<N>(field, event, y, 1e-3 * speed / gravity, size, 1e-8);
  }

  /// From a surface at `speed` up and down again; y = speed upwards, height, time.
  Jump jump(double speed) const {
    State<3> y = {speed, 0.0, 0.0};
    const auto field = [&](const State<3>& at) -> State<3> {
      return {-gravity - std::copysign(drag(std::abs(at[0])), at[0]), at[0], 1.0};
    };
    const State<3> size = {speed, speed * speed / gravity, speed / gravity};
    if (!reaches_zero<3>(field, 0, y, speed, size)) return {};
    y[0] = std::min(y[0], 0.0);
    return reaches_zero<3>(field, 1, y, speed, size) ? Jump{y[2], -y[0]} : Jump{};
  }

  double share_, density_, diameter_;
};

/// Speed of a sphere after crossing the gas between the measuring plane and the surface (inward:
/// the gap closes). Drag of Stokes with Schiller & Naumann's inertia and Cunningham's slip far from
/// the wall, plus the film between slipping walls near it (Hocking 1973), and between them what
/// Bevan & Prieve (2000), J. Chem. Phys. 113, 1228-1236, add for the wall; dv/dx by the classical
/// Runge-Kutta method in ln(x + lambda).
double through_gas(const Effects& effects, double mass, double radius, double speed, bool inward) {
  const double share = effects.gas_pressure / bar;
  const double path = free_path / share;
  const double knudsen = path / radius;
  const double slip = 1.0 + knudsen * (1.257 + 0.4 * std::exp(-1.1 / knudsen));
  const double from = std::log(effects.gas_distance + path);
  const double to = std::log(path);
  const auto loss = [&](double at, double v) {  // dv / d ln(x + path), per step towards the wall
    if (!(v > 0.0)) return 0.0;
    const double x = std::exp(at);
    const double gap = std::max(x - path, 1e-6 * path);
    const double thickness = gap / (6.0 * 1.15 * path);
    const double film =
        radius / (3.0 * 1.15 * path) * ((1.0 + thickness) * std::log1p(1.0 / thickness) - 1.0);
    const double reynolds = gas_density * share * 2.0 * radius * v / viscosity;
    const double wall = 0.5 / (1.0 + 3.0 * gap / radius);
    const double drag = (1.0 + 0.15 * std::pow(reynolds, 0.687) + wall) / slip + film;
    return -6.0 * pi * viscosity * radius / mass * drag * x;
  };
  constexpr int steps = 200;
  const double h = (from - to) / steps;
  double v = speed;
  for (int i = 0; i < steps; ++i) {
    const double at = inward ? from - i * h : to + i * h;
    const double way = inward ? -h : h;
    const double k1 = loss(at, v);
    const double k2 = loss(at + 0.5 * way, v + 0.5 * h * k1);
    const double k3 = loss(at + 0.5 * way, v + 0.5 * h * k2);
    const double k4 = loss(at + way, v + h * k3);
    v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return v;
}

/// Work of the force A r / 6 x^2 between 1 mm and 0.4 nm, per half mass.
double van_der_waals_work(double hamaker_constant, double mass, double diameter) {
  return hamaker_constant * diameter / 6.0 * (1.0 / 0.4e-9 - 1.0 / 1e-3) / mass;
}

/// Work of the image force q^2 / (16 pi eps0 (r + x)^2) between 1 mm and contact, per half mass.
double image_work(const Base& base, const Effects& effects, double mass, double diameter) {
  const double reference = 0.5 * base.reference_diameter;
  const double charge = 4.0 * pi * permittivity * reference * reference * effects.surface_field *
                        std::pow(diameter / base.reference_diameter, effects.charge_exponent);
  const double r = 0.5 * diameter;
  const double energy = charge * charge / (16.0 * pi * permittivity) * (1.0 / r - 1.0 / (r + 1e-3));
  return 2.0 * energy / mass;
}

/// Speed after the gas on the way in or out.
double after_gas(const Effects& effects, const Sphere& sphere, double speed, bool inward) {
  if (!effects.other_laws) {
    return through_gas(effects, sphere.mass, sphere.radius, speed, inward);
  }
  const double path = free_path * bar / effects.gas_pressure;
  return speed - speed_lost_in_film(viscosity, sphere, effects.gas_distance, path);
}

/// Takes from the contact what second published laws say of it, and returns v^2 with which the rest
/// of it begins; below zero: the energy that is missing. These laws are of dry spheres. As in
/// Dahneke's (1975) balance of energies, adhesion has the contact struck at a higher speed, and
/// takes back what it gave: e^2 (v^2 + w) - w, w the depth of the well.
double left_by_other_laws(const Sphere& sphere, ContactExtras& extras, double speed) {
  const double depth = well_depth(sphere);
  const double struck = std::sqrt(speed * speed + depth);
  double e = 1.0;
  if (extras.yield_pressure > 0.0) e *= jackson_restitution(sphere, extras.yield_pressure, struck);
  if (extras.bulk_relaxation > 0.0) {
    e *= ramirez_restitution(sphere, extras.bulk_relaxation, struck);
  }
  if (extras.plate_mobility > 0.0) {
    e *= boettcher_restitution(sphere, extras.plate_mobility, struck);
  }
  extras.yield_pressure = extras.bulk_relaxation = extras.plate_mobility = 0.0;
  return e * e * struck * struck - depth;
}

/// By exact laws, or other ones.
double exact_square(const Base& base, const Effects& effects, double velocity, double diameter,
                    double size_factor, double adhesion_factor) {
  const double d = diameter * (1.0 + effects.diameter_error) * size_factor;
  Sphere sphere = sphere_of(base, d);
  sphere.adhesion_force =
      base.adhesion_force * std::cbrt(d / base.reference_diameter) * adhesion_factor;
  sphere.C_H = base.C_H;
  sphere.C_A = base.C_A;

  // in: instrument, fall, gas, charge
  double v = velocity - effects.velocity_error;
  double square = v * v + 2.0 * gravity * effects.plane_height;
  if (!(v > 0.0) || !(square > 0.0)) return -1.0;
  const Flight air(effects.flight_pressure, base.density, d);
  if (effects.flight_pressure > 0.0) {
    v = effects.flights_timed ? air.landed(std::sqrt(square)) : air.fallen(0.5 * square / gravity);
    if (!(v > 0.0)) return -1.0;
    square = v * v;
  }
  if (effects.gas_pressure > 0.0) {
    v = after_gas(effects, sphere, std::sqrt(square), true);
    if (!(v > 0.0)) return -1.0;
    square = v * v;
  }
  const double image =
      effects.surface_field == 0.0 ? 0.0 : image_work(base, effects, sphere.mass, d);
  const double attraction = van_der_waals_work(effects.hamaker_constant, sphere.mass, d);
  square += image + attraction;

  // contact
  v = std::sqrt(square);
  ContactExtras extras = effects.contact;
  if (effects.other_laws) {
    square = left_by_other_laws(sphere, extras, v);
    if (!(square > 0.0)) return square / (velocity * velocity);
    v = std::sqrt(square);
  }
  if (extras.yield_pressure > 0.0) {
    const PlasticResult plastic = plastic_contact(sphere.mass, sphere.radius, sphere.stiffness,
                                                  extras.yield_pressure, v, work_at_rest(sphere));
    if (!(plastic.square > 0.0)) return plastic.square / (velocity * velocity);
    sphere.adhesion_force *= std::cbrt(plastic.radius / sphere.radius);
    sphere.radius = plastic.radius;
    v = std::sqrt(plastic.square);
  }
  square = contact(sphere, extras, base, v).square;
  double work = effects.asperity_energy;
  work += 4.0 * pi * 0.5 * d * surface_tension * effects.bridge_length;
  if (effects.jkr_work > 0.0) {
    work += jkr_parting_work(effects.jkr_work, sphere.radius, 0.75 * sphere.stiffness);
  }
  square -= 2.0 * work / sphere.mass;

  // out
  square -= image + attraction;
  if (effects.gas_pressure > 0.0 && square > 0.0) {
    v = after_gas(effects, sphere, std::sqrt(square), false);
    square = v > 0.0 ? v * v : -1e-6;
  }
  if (effects.flight_pressure > 0.0 && square > 0.0) {
    v = std::sqrt(square);
    const double by_time = effects.flights_timed ? air.lasted(v) : 0.0;
    square = effects.flights_timed ? by_time * by_time : 2.0 * gravity * air.risen(v);
  }
  square -= 2.0 * gravity * effects.plane_height;
  if (square > 0.0 && effects.height_error != 0.0) {
    square += 2.0 * gravity * effects.height_error;
    if (!(square > 0.0)) square = -1e-6;
  }
  if (square > 0.0 && effects.velocity_error != 0.0) {
    v = std::sqrt(square) + effects.rebound_error_sign * effects.velocity_error;
    square = v > 0.0 ? v * v : -1e-6;
  }
  return square / (velocity * velocity);
}

/// exp of what the oddity adds to ln e at this velocity.
double oddity_factor(const Effects& effects, double velocity) {
  const double x = std::log(velocity / effects.oddity_centre) / effects.oddity_width;
  switch (effects.oddity) {
    case Oddity::none:
      return 1.0;
    case Oddity::dip:  // as of a resonance
      return std::exp(-effects.oddity_size * std::exp(-0.5 * x * x));
    case Oddity::kink:  // e falls no more, but rises, from here on
      return std::exp(effects.oddity_size * std::max(x, 0.0));
    case Oddity::wave:
      return std::exp(effects.oddity_size * (std::sin(2.0 * pi * x) - 1.0));
  }
  return 1.0;
}

}  // namespace

double Bend::factor(double velocity, double diameter) const {
  if (size == 0.0) return 1.0;
  double sum = 0.0;
  for (const Wave& wave : waves) {
    sum += std::cos(wave.per_log_velocity * std::log(velocity) +
                    wave.per_log_diameter * std::log(diameter) + wave.phase);
  }
  return 1.0 + size * std::sqrt(2.0 / static_cast<double>(waves.size())) * sum;
}

Bend draw_bend(double size, std::uint64_t seed, std::uint64_t which) {
  constexpr std::uint64_t first_bend = 1000;
  constexpr double longest = 20.0, shortest = 5.0;
  RandomStream random(seed, hidden_purpose, first_bend + which);
  Bend bend;
  bend.size = size;
  for (Bend::Wave& wave : bend.waves) {
    const double turn = 2.0 * pi;
    const double number = turn / (longest * std::pow(shortest / longest, random.uniform()));
    const double direction = turn * random.uniform();
    wave = {number * std::cos(direction), number * std::sin(direction), turn * random.uniform()};
  }
  return bend;
}

double size_of_offsets(const Effects& effects) {
  if (effects.series_offset.empty()) return 0.0;
  double square = 0.0;
  for (const double offset : effects.series_offset) square += offset * offset;
  return std::sqrt(square / static_cast<double>(effects.series_offset.size()));
}

double square_of_restitution(const Base& base, const Effects& effects, double velocity,
                             double diameter, double size_factor, double adhesion_factor) {
  const double exact =
      exact_square(base, effects, velocity, diameter, size_factor, adhesion_factor);
  if (effects.bend_of_laws.size == 0.0 && effects.bend_of_base.size == 0.0) return exact;
  static const Effects nothing;
  const double plain =
      exact_square(base, nothing, velocity, diameter, size_factor, adhesion_factor);
  return 1.0 - effects.bend_of_base.factor(velocity, diameter) * (1.0 - plain) +
         effects.bend_of_laws.factor(velocity, diameter) * (exact - plain);
}

double size_of(double spread, double z) {
  return std::exp(spread * z) / std::exp(0.5 * spread * spread);
}

double Scatter::of(double e) const {
  const double steep = slope * std::max(1.0 - e * e, 0.0) / std::max(e, 0.05);
  return std::sqrt(relative * relative * e * e + floor * floor + steep * steep);
}

Expected expected_point(const Base& base, const Effects& effects, const Scatter& scatter,
                        double velocity, double diameter, std::size_t series) {
  const bool differ = effects.size_spread > 0.0 || effects.adhesion_spread > 0.0;
  const int nodes = differ ? 101 : 1;
  const double odd = oddity_factor(effects, velocity);
  double weight = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (int i = 0; i < nodes; ++i) {
    double size = 1.0;
    double adhesion = 1.0;
    if (differ) {
      // equal parts of both distributions, paired without order (golden section)
      const double u = (i + 0.5) / nodes;
      const double w = std::fmod(0.5 + i * (std::numbers::phi - 1.0), 1.0);
      size = size_of(effects.size_spread,
                     gsl_cdf_ugaussian_Pinv(effects.adhesion_spread > 0.0 ? w : u));
      adhesion = std::exp(effects.adhesion_spread * gsl_cdf_ugaussian_Pinv(u));
    }
    const double square = square_of_restitution(base, effects, velocity, diameter, size, adhesion);
    if (!(square > 0.0)) continue;
    const double e = std::sqrt(square) * odd;
    const double sd = scatter.of(e);
    double share = 1.0;
    double mean = e;
    double spread = sd * sd;
    if (effects.slowest_rebound > 0.0) {
      // normal, cut off below
      const double z = (e - effects.slowest_rebound / velocity) / sd;
      share = gsl_cdf_ugaussian_P(z);
      if (share < 1e-6) continue;
      const double hazard = gsl_ran_ugaussian_pdf(z) / share;
      mean = e + sd * hazard;
      spread = sd * sd * (1.0 - hazard * (hazard + z));
    }
    weight += share;
    first += share * mean;
    second += share * (spread + mean * mean);
  }
  if (!(weight > 0.002 * nodes)) return {};
  double mean = first / weight;
  double square = second / weight;
  const double q = effects.outlier_share;
  mean = (1.0 - q) * mean + 0.5 * q;
  square = (1.0 - q) * square + q / 3.0;
  const double sd = std::sqrt(std::max(square - mean * mean, 0.0));
  if (!effects.series_offset.empty()) mean += effects.series_offset[series];
  return {mean, sd};
}

Reading read_impact(const Base& base, const Effects& effects, const Scatter& scatter,
                    double velocity, double diameter, std::optional<double> typical,
                    RandomStream& random) {
  double square = typical.value_or(0.0);
  if (!typical) {
    const double size = size_of(effects.size_spread, random.normal());
    const double adhesion = std::exp(effects.adhesion_spread * random.normal());
    square = square_of_restitution(base, effects, velocity, diameter, size, adhesion);
  }
  const double noise = random.normal();
  const double fate = random.uniform();
  const double chance = random.uniform();
  if (!(square > 0.0)) return {.captured = true};
  const double e = std::sqrt(square) * oddity_factor(effects, velocity);
  const double reading = e + scatter.of(e) * noise;
  if (reading * velocity < effects.slowest_rebound) return {};
  return {.seen = true, .restitution = fate < effects.outlier_share ? chance : reading};
}

std::optional<double> shared_square(const Base& base, const Effects& effects, double velocity,
                                    double diameter) {
  if (effects.size_spread > 0.0 || effects.adhesion_spread > 0.0) return std::nullopt;
  return square_of_restitution(base, effects, velocity, diameter);
}

double observed_mean(const Base& base, const Effects& effects, const Scatter& scatter,
                     double velocity, double diameter, std::size_t series, int events,
                     RandomStream& random) {
  const auto typical = shared_square(base, effects, velocity, diameter);
  double sum = 0.0;
  int seen = 0;
  for (int tries = 0; seen < events && tries < 1000 * events; ++tries) {
    const Reading one = read_impact(base, effects, scatter, velocity, diameter, typical, random);
    if (!one.seen) continue;
    sum += one.restitution;
    ++seen;
  }
  if (seen == 0) return 0.0;
  const double offset = effects.series_offset.empty() ? 0.0 : effects.series_offset[series];
  return sum / seen + offset;
}

}  // namespace recoil::hidden
