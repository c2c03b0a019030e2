#include "validation/synthetic/bend.hpp"

#include <cmath>
#include <numbers>

#include "validation/synthetic/purpose.hpp"

namespace hidden {

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
  recoil::RandomStream random(seed, hidden_purpose, first_bend + which);
  Bend bend;
  bend.size = size;
  for (Bend::Wave& wave : bend.waves) {
    const double turn = 2.0 * std::numbers::pi;
    const double number = turn / (longest * std::pow(shortest / longest, random.uniform()));
    const double direction = turn * random.uniform();
    wave = {number * std::cos(direction), number * std::sin(direction), turn * random.uniform()};
  }
  return bend;
}

}  // namespace hidden
