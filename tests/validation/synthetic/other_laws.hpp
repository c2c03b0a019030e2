#pragma once

#include <string_view>
#include <vector>

#include "validation/synthetic/sphere.hpp"

namespace hidden {

/// The effects for which a second published law can make the data: neither that of the catalogue
/// nor that of `contact`.
const std::vector<std::string_view>& effects_with_other_law();

/// Is that law one of a contact without adhesion? Beside adhesion it is used with Dahneke's (1975)
/// balance of energies, which is not good near capture: a dashpot in a contact that adheres
/// takes 1.3 to 1.9 times as much of spheres of 2.6 to 6.9 um there (and 1.05 times at ten times
/// the capture velocity).
bool is_law_of_dry_contact(std::string_view effect);

/// The largest strength up to which the second law of `effect` is good, in the unit of the effect,
/// for spheres of mass and stiffness like `sphere`'s up to `velocity`; infinite where it always is.
double largest_by_other_law(std::string_view effect, const Sphere& sphere, double velocity);

/// Rebound over incident speed of a yielding sphere, from finite elements (Jackson, Green &
/// Marghitu 2010, Nonlinear Dyn. 60, 217-229, equations 31 to 33): with u = V / V_y,
///   e = 1 - 0.1 ln u ((u - 1) / 59)^0.156                             1 < u <= 60,
///   e = 1 - 0.1 ln 60 - 0.11 ln(u / 60) (u - 60)^(2.36 p_Y / (1.6 E*))   beyond;
/// V_y is where the peak pressure of Hertz is p_Y.
double jackson_restitution(const Sphere& sphere, double yield_pressure, double velocity);

/// Of a sphere whose material follows Kuwabara & Kono, to the second order in its relaxation
/// (Ramirez, Poeschel, Brilliantov & Schwager 1999, Phys. Rev. E 60, 4465-4472):
///   e = 1 - b + (3/5) b^2,  b = 1.15344 (3/2) A (K sqrt(R) / m)^(2/5) V^(1/5);
/// the next term, -0.32 b^3 or so, is a hundredth at b = 0.3.
double ramirez_restitution(const Sphere& sphere, double relaxation, double velocity);

/// Of a sphere on a thin plate of mobility 1 / Z: e = exp(-1.719 lambda), lambda = (m / Z) (K
/// sqrt(R) / m)^(2/5) V^(1/5) being Zener's (1941) inelasticity (Boettcher, Russell & Mueller 2017,
/// Int. J. Solids Struct. 106, 229-239), for lambda < 0.25.
double boettcher_restitution(const Sphere& sphere, double plate_mobility, double velocity);

/// Speed that the film between sphere and wall takes, to leading order with the mean free path as
/// the gap at which the continuum ends (Barnocky & Davis 1988, Phys. Fluids 31, 1324-1329):
///   6 pi mu R^2 / m ln(gap / path) [m/s].
double speed_lost_in_film(double mu, const Sphere& sphere, double gap, double path);

}  // namespace hidden
