#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

// Air at 293 K: viscosity [Pa s], mean free path [m] at 101325 Pa (Hinds, Aerosol Technology).
constexpr double viscosity = 1.81e-5;
constexpr double free_path_times_pressure = 66e-9 * 101325.0;

/// max(y, 0) for a sphere that the gas stops, rounded off over `width`.
template <class T>
T positive_part(const T& y, const T& width) {
  return 0.5 * (y + sqrt(y * y + width * width));
}

/// sign(x) sqrt(|x|), rounded off where |x| < width^2.
template <class T>
T signed_root(const T& x, const T& width) {
  const T w2 = width * width;
  return x / sqrt(sqrt(x * x + w2 * w2));
}

struct GasFilm {
  /// Speed lost on one way.
  template <class T>
  static T lost_speed(const Encounter<T>& e, std::span<const T> own) {
    const T r = e.radius();
    const T inverse_knudsen = own[0] * r / free_path_times_pressure;
    const T lubrication = logarithm_of_one_plus(inverse_knudsen) / r;
    // Stokes drag with the slip correction 1 + Kn (1.257 + 0.4 exp(-1.1 / Kn)), small Re.
    const T slip =
        inverse_knudsen / (inverse_knudsen + 1.257 + 0.4 * exponential(-1.1 * inverse_knudsen));
    return 4.5 * viscosity / e.at->density * (lubrication + own[1] * slip / (r * r));
  }

  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    const T lost = lost_speed(e, own);
    if (value_of(own[0]) == 0.0) {
      e.velocity -= lost;
      return;
    }
    e.velocity = positive_part(e.velocity - lost, 0.05 * lost);
  }

  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const T lost = lost_speed(e, own);
    if (value_of(own[0]) == 0.0) {
      add_slopes(e.square, -2.0 * std::sqrt(std::abs(value_of(e.square))), lost);
      return;
    }
    const T rest = signed_root(e.square, 0.25 * lost) - lost;
    e.square = rest * sqrt(rest * rest + 0.01 * lost * lost);
  }
};

}  // namespace

Mechanism gas_film() {
  return make_mechanism<GasFilm>({
      .id = "gas_film",
      .title = "gas between the measuring plane and the contact",
      .kind = MechanismKind::physics,
      .place = MechanismPlace::gas,
      .formula =
          "each way the sphere loses the speed (9 mu / (2 rho r)) (ln(1 + r / lambda) + L / (r "
          "C)): lubrication up to slip at the mean free path, and drag over the distance L",
      .source = "Davis, R. H., Serayssol, J.-M. & Hinch, E. J. (1986), J. Fluid Mech. 163, "
                "479-497; Barnocky, G. & Davis, R. H. (1988), Phys. Fluids 31, 1324-1329. Drag is "
                "that of Stokes: at Re = 10 it is half as large again",
      .fingerprint = "1 - e^2 ~ V^(-1) d^(-1) (d^(-2) where drag prevails), no dependence on the "
                     "target; gone in vacuum",
      .parameters =
          {{.name = "gas_pressure",
            .unit = "Pa",
            .meaning = "pressure of the air",
            .null_value = 0.0,
            .initial = 3e4,
            .lower = 0.0,
            .upper = 1e7,
            .plausible = {0.0, 1.1e5,
                          "an experiment in open air has 1e5 Pa, one in vacuum almost none"},
            .starts = {3e3, 1e5}},
           {.name = "measuring_distance",
            .unit = "m",
            .meaning = "L, from the measuring plane to the surface",
            .null_value = 0.0,
            .initial = 2e-5,
            .lower = 0.0,
            .upper = 1e-1,
            .plausible = {0.0, 1e-2,
                          "laser beams cross some sphere diameters to some mm above the surface"},
            .free = false}},
  });
}

}  // namespace recoil
