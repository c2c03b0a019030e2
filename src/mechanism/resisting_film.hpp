#pragma once

#include <cmath>
#include <span>

#include "mechanism/encounter.hpp"

namespace recoil {

/// sign(x) sqrt(|x|), smoothed for |x| < width^2.
template <class T>
T signed_root(const T& x, const T& width) {
  const T w2 = width * width;
  return x / sqrt(sqrt(x * x + w2 * w2));
}

/// A film between sphere and surface that takes the speed `Film::lost_speed(e, own)` on each way,
/// whatever the speed is: all of it from slower spheres.
template <class Film>
struct ResistingFilm {
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    const T lost = Film::lost_speed(e, own);
    if (value_of(lost) == 0.0) {
      e.velocity -= lost;
      return;
    }
    e.velocity = positive_part(e.velocity - lost, 0.05 * lost);
  }

  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    const T lost = Film::lost_speed(e, own);
    if (value_of(lost) == 0.0) {
      add_slopes(e.square, -2.0 * std::sqrt(std::abs(value_of(e.square))), lost);
      return;
    }
    const T rest = signed_root(e.square, 0.25 * lost) - lost;
    e.square = rest * sqrt(rest * rest + 0.01 * lost * lost);
  }
};

}  // namespace recoil
