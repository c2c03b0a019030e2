#include "mechanism/mechanism.hpp"
#include "mechanism/resisting_film.hpp"

namespace recoil {
namespace {

/// The force of lubrication between a sphere and a wall at the gap x << r is 6 pi mu r^2 v / x.
/// From the thickness of the film to the tips of the asperities it takes the speed (6 pi mu r^2 /
/// m) ln(delta / h). A film that does not cover the asperities takes none: ln(delta / h) is written
/// as ln(1 + (delta / h)^2) / 2.
struct LiquidFilm : ResistingFilm<LiquidFilm> {
  /// Speed lost on one way.
  template <class T>
  static T lost_speed(const Encounter<T>& e, std::span<const T> own) {
    const T r = e.radius();
    const T covers = own[1] / own[2];
    return 3.0 * std::numbers::pi * own[0] * r * r / e.mass() *
           logarithm_of_one_plus(covers * covers);
  }
};

}  // namespace

Mechanism liquid_film() {
  return make_mechanism<LiquidFilm>({
      .id = "liquid_film",
      .title = "a liquid film on sphere or surface",
      .place = MechanismPlace::gas,
      .formula =
          "on each way the sphere loses the speed dv = (6 pi mu r^2 / m) ln(delta / h), with the "
          "viscosity mu of the liquid, the thickness delta of its film and the roughness h at "
          "which the solids touch. With the Stokes number St = m V / (6 pi mu r^2) and the e_dry "
          "of the solid contact, e = e_dry (1 - St_c / St), St_c = (1 + 1 / e_dry) ln(delta / h); "
          "the sphere is captured at St <= St_c. Between two spheres r and m are the reduced ones",
      .source =
          "Davis, R. H., Serayssol, J.-M. & Hinch, E. J. (1986), J. Fluid Mech., doi "
          "10.1017/S0022112086002392; Davis, R. H., Rager, D. A. & Good, B. T. (2002), J. Fluid "
          "Mech., doi 10.1017/S0022112002001489 (rebound from coated surfaces over St / St_c); "
          "Gollwitzer, F., Rehberg, I., Kruelle, C. A. & Huang, K. (2012), arXiv:1202.1750, and "
          "Mueller, T. & Huang, K. (2016), arXiv:1601.07032 (e of wet spheres is linear in 1 / "
          "St). The film is thin and does not cavitate on the way out; its inertia and its "
          "surface tension are neglected",
      .fingerprint = "1 - e^2 ~ V^(-1) d^(-1), V* ~ d^(-1), independent of the target; vanishes "
                     "on dry bodies",
      .parameters = {{.name = "film_viscosity",
                      .unit = "Pa s",
                      .meaning = "mu, viscosity of the liquid",
                      .initial = 1e-4,
                      .upper = 1e4,
                      .plausible = {0.0, 1e3,
                                    "water has 1e-3 Pa s, glycerol 1.4 Pa s, thick oils up to 1e3"},
                      .starts = {1e-3, 1e-1},
                      .stated_by = {{.condition = Condition::film_thickness, .zero_up_to = 0.0}}},
                     {.name = "film_depth",
                      .unit = "m",
                      .meaning = "delta, thickness of the film, on both bodies together",
                      .initial = 1e-6,
                      .upper = 1e-1,
                      .plausible = {0.0, 1e-3, "films on spheres are thinner than 1 mm"},
                      .free = false,
                      .searched = false,
                      .stated_by = {StatedBy{Condition::film_thickness}}},
                     {.name = "film_roughness",
                      .unit = "m",
                      .meaning = "h, height of the asperities, at which the solids touch",
                      .null_value = 1e-7,
                      .initial = 1e-7,
                      .lower = 1e-10,
                      .upper = 1e-3,
                      .plausible = {1e-10, 1e-4, "from atomically smooth to blasted surfaces"},
                      .free = false,
                      .searched = false,
                      .stated_by = {StatedBy{Condition::surface_rms_roughness}}}},
      .needs_liquid = true,
      .taken_away = TakenAway{Condition::film_thickness, 0.0, "dry both bodies"},
  });
}

}  // namespace recoil
