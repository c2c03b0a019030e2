#pragma once

#include <cstdint>

namespace recoil {

/// The purpose of a stream of random numbers. Streams with different purposes never overlap.
enum class RandomPurpose : std::uint32_t {
  bootstrap = 1,
  reconstruction = 2,
  coverage = 3,
  diagnosis = 5,
  held_out = 6,
  constants = 7,
  posterior = 8,
  settings = 9,
  calibration = 10,
  example = 11,
  experiments = 12,
  guesses = 13,
};

/// A reproducible stream of random numbers that is a pure function of (seed, purpose, replicate):
/// Philox4x64-10, counter based (Salmon, Moraes, Dror & Shaw 2011, SC'11,
/// doi 10.1145/2063384.2063405; the Random123 library). Replicate 17 therefore draws the same
/// numbers on any thread, and also if it is run alone.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, RandomPurpose purpose, std::uint64_t replicate);

  /// Uniform on the open interval (0, 1) [1].
  double uniform();

  /// Standard normal [1] by inversion: each takes one uniform number, so that streams stay aligned.
  double normal();

  /// Uniform on {0, ..., n - 1}. @pre n > 0
  std::uint64_t below(std::uint64_t n);

 private:
  std::uint64_t next();

  std::uint64_t seed_;
  std::uint64_t purpose_;
  std::uint64_t replicate_;
  std::uint64_t block_ = 0;
  std::uint64_t buffer_[4] = {};
  int used_ = 4;
};

}  // namespace recoil
