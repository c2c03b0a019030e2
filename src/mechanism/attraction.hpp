#pragma once

#include <span>

#include "mechanism/encounter.hpp"

namespace recoil {

/// A force that draws the sphere on before it touches: what it gains on the way in it pays back on
/// the way out. `Well::gained(e, own)` is 2 U / m, U the energy of the well [m2/s2].
template <class Well>
struct Attraction {
  template <class T>
  static void before(Encounter<T>& e, std::span<const T> own) {
    e.velocity = sqrt(e.velocity * e.velocity + Well::template gained<T>(e, own));
  }
  template <class T>
  static void after(Encounter<T>& e, std::span<const T> own) {
    e.square -= Well::template gained<T>(e, own);
  }
};

}  // namespace recoil
