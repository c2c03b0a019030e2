#pragma once

#include <string>
#include <string_view>

namespace recoil {

/// True if these bytes begin as a WAV, FLAC or Ogg file does.
bool is_recording(std::string_view bytes);

/// The impacts in a sound.
struct HeardImpacts {
  std::string table;      ///< CSV with the columns launch and time [s]
  double time_sd = 0.0;   ///< of one instant, root mean square [s]
  std::size_t count = 0;  ///< of impacts
};

/// Finds the impacts of a bouncing ball in a recording of at most 3e7 samples (ten minutes at 48
/// kHz) in 1 to 8 channels, which are averaged, at 8 to 192 kHz.
///
/// An impact is a millisecond from which the energy of three exceeds that of the four before it,
/// and the median of the recording, eight times; the next one is at least 40 ms away. The sound
/// around it is taken as normal with variance n^2 + A^2 (1 - exp(-s / r))^2 exp(-2 s / d) at the
/// time s after the instant. Instant, amplitude A, rise r and decay d have a uniform prior on a
/// grid (r from 0.05 to 3.2 ms, d from 2 to 20 ms); time and error are mean and standard deviation
/// of the posterior of the instant. A launch ends where an interval is longer than the one before
/// it.
/// @throws InputError for a file that libsndfile cannot read, outside these limits, without three
///   impacts or with more than 500
HeardImpacts hear_impacts(const std::string& bytes, const std::string& file);

}  // namespace recoil
