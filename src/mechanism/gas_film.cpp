#include "mechanism/mechanism.hpp"
#include "mechanism/resisting_film.hpp"

namespace recoil {
namespace {

// Slip length of a gas on a wall with diffuse reflection, in free paths: 1 by Maxwell (1879), 1.146
// by the kinetic equation (Cercignani, Rarefied Gas Dynamics).
constexpr double slip_length = 1.15;

/// Integral of f* / h from contact to h = 6 b x: (1 + x)^2 ln(1 + 1 / x) - x + ln x, where
///   f* = (h / 3b) ((1 + h / 6b) ln(1 + 6b / h) - 1)
/// is the force of the film between walls that slip by b, over 6 pi mu r^2 v / h (Hocking 1973).
/// It tends to ln x + 3/2 for a thick film.
template <class T>
T slip_film(const T& x) {
  constexpr double least = 1e-9;  // keeps the slope finite without gas
  const T y = x + least;
  const T more = 1.0 + x;
  return more * more * logarithm_of_one_plus((1.0 - least) / y) - x + logarithm(y);
}

/// The loss on one way is the integral of the quasi-steady drag over the distance. It does not
/// depend on the velocity if Re is small:
///   dv = (9 mu / (2 rho r)) (film + (L / r + (1/8) ln(1 + 10 L / r)) / C).
/// The logarithm is the additional drag near a wall. Compared with the integral of the series of
/// Brenner (1961) and Maude (1961), with Hocking's film instead of 1 / h and Cunningham's C, dv has
/// an error of 0.1 % for L > 5 r and of 2 % for all L from r / 10 on, for diameters from 2.6 um to
/// 2 mm at 1 atm.
struct GasFilm : ResistingFilm<GasFilm> {
  /// Speed lost on one way.
  template <class T>
  static T lost_speed(const Encounter<T>& e, std::span<const T> own) {
    const T r = e.radius();
    const Air air = e.air();
    const T film = slip_film(own[0] * own[1] / (6.0 * slip_length * air.free_path()));
    const T wall = 0.125 * logarithm_of_one_plus(10.0 * own[1] / r);
    return 4.5 * air.viscosity() / e.density * (film + (own[1] / r + wall) * e.slip(own[0])) / r;
  }
};

}  // namespace

Mechanism gas_film() {
  return make_mechanism<GasFilm>({
      .id = "gas_film",
      .title = "gas between the measuring plane and the contact",
      .place = MechanismPlace::gas,
      .needs_flat = true,
      .formula =
          "on each way the sphere loses the speed (9 mu / (2 rho r)) (F(L / 6b) + (L / r + (1/8) "
          "ln(1 + 10 L / r)) / C). F(x) = (1 + x)^2 ln(1 + 1 / x) - x + ln x describes the film "
          "between walls with the slip length b = 1.15 mean free paths; L / r is the drag over the "
          "distance L with Cunningham's correction C, and the logarithm is the effect of the wall "
          "on it; viscosity and mean free path of air at the stated temperature, else at 293 K",
      .source =
          "Davis, R. H., Serayssol, J.-M. & Hinch, E. J. (1986), J. Fluid Mech. 163, "
          "479-497; Barnocky, G. & Davis, R. H. (1988), Phys. Fluids 31, 1324-1329; Hocking, "
          "L. M. (1973), J. Eng. Math. 7, 207-221 (film with slip); Brenner, H. (1961), "
          "Chem. Eng. Sci. 16, 242-251 (sphere and wall). The drag is that of Stokes; at Re "
          "= 10 the true drag is 1.72 times as large (Brown, P. P. & Lawler, D. F. (2003), J. "
          "Environ. Eng. 129, 222-231)",
      .fingerprint = "1 - e^2 ~ V^(-1) d^(-1) (d^(-2) if drag prevails), independent of the "
                     "target; vanishes in vacuum",
      .parameters =
          {{.name = "gas_pressure",
            .unit = "Pa",
            .meaning = "pressure of the air",
            .initial = 3e4,
            .upper = 1e7,
            .plausible = {0.0, 1.1e5,
                          "an experiment in open air has 1e5 Pa, one in vacuum almost none"},
            .starts = {3e3, 1e5},
            .stated_by = {StatedBy{Condition::ambient_pressure}}},
           {.name = "measuring_distance",
            .unit = "m",
            .meaning = "L, distance from the measuring plane to the surface",
            .initial = 2e-5,
            .upper = 1e-1,
            .plausible =
                {0.0, 1e-2,
                 "laser beams cross between a few sphere diameters and a few mm above the surface"},
            .free = false,
            .stated_by = {StatedBy{Condition::probe_height}}}},
      .taken_away = TakenAway{Condition::ambient_pressure, 10.0, "pump the chamber to below 10 Pa"},
  });
}

}  // namespace recoil
