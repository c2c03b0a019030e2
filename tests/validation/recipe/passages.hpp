#pragma once

#include <cstdint>
#include <string>

#include "validation/recipe/recipe.hpp"

namespace recoil {

/// What a phase Doppler instrument would have recorded of the recipe's experiment: one row per
/// passage through the measuring plane, `series,time,velocity,tangential_velocity,diameter` in s,
/// m/s and um, in the order of time; for `recoil pair`.
///
/// One drop height after the other, so many spheres each that the recipe's number of events is
/// expected to be seen with both passages. A sphere of random size falls freely, is captured or
/// rebounds with the truth's e at its own size and velocity, with the recipe's scatter of one
/// event; leaves rolling, with 5/7 of its tangential velocity, so that tan(angle out) = (5/7)
/// tan(angle in) / e; passes the plane again where it is fast enough; may come back through the
/// volume for a second impact, and so on. Sphere i of height k draws from the stream (seed,
/// reconstruction, 10^6 (k + 1000) + i): the points' own streams have smaller numbers.
/// @param times as many spheres as the recipe asks for.
/// @throws InputError when the recipe has no table [passages] or no [sizes].
std::string draw_passages(const Recipe& recipe, std::uint64_t seed, int times = 1);

}  // namespace recoil
