#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// Spheres that fall from a dispenser through the probe volume onto a surface, and what the
/// instrument writes down of it. The truth of every row is known. Shares nothing with the pairing
/// but the random numbers.
namespace stream {

/// Lengths in m, velocities in m/s, times in s. The defaults follow what Li, Dunn & Brach (1999)
/// say of SST65 on silicon; what they do not say (rate, shares of unseen passages, second impacts)
/// is assumed.
struct Design {
  std::size_t spheres = 2000;
  double rate = 10.0;  ///< spheres per second, at random times
  std::vector<double> drop_heights = {0.02, 0.04, 0.1, 0.22, 0.5, 1.0};  ///< one after the other
  double probe_height = 1.04e-3;
  double median = 46.3e-6;  ///< of a log-normal size distribution, cut at both ends
  double log_sd = 0.35;
  double smallest = 20e-6;
  double largest = 110e-6;
  /// Capture below 0.9 m/s at 20 um falling to 0.1 m/s at 110 um; e = top sqrt(1 - (V*/V)^2).
  double capture_at_20um = 0.9;
  double capture_exponent = 1.289;
  double top_restitution = 0.95;
  double restitution_sd = 0.03;  ///< of one impact
  double velocity_sd = 0.01;     ///< relative, of one passage
  double volume_sd = 20e-6;      ///< where in the probe volume a passage is timed
  double clock = 1e-6;           ///< times are written in steps of this
  double diameter_noise = 1.0;   ///< times the paper's +-15 % (2 um) to +-1 % (80 um), as 2 sd
  double seen = 0.97;            ///< share of passages that are written down
  double rebound_seen = 1.0;     ///< further factor for passages up
  double return_time = 0.15;     ///< a rebound comes back through the volume with exp(-T / this)
  /// Of the fall to the normal [rad]. Spheres leave rolling, tan(out) = (5/7) tan(in) / e.
  double angle_sd = 0.05;
  double duplicated = 0.002;  ///< shares of rows
  double damaged = 0.002;
  double displaced = 0.01;  ///< written some rows too late
  std::uint64_t seed = 1;
};

/// What one row of the file is.
struct Row {
  std::uint32_t sphere = 0;
  int impact = 0;  ///< 1: the first; the passage down before it and the one up after it
  bool down = true;
  bool usable = true;  ///< not damaged, and no repetition
};

/// What became of a passage down that is in the file.
enum class Fate { rebound_seen, rebound_unseen, too_slow, captured };

struct Stream {
  std::string csv;         ///< time [s], velocity [m/s], tangential_velocity [m/s], diameter [um]
  std::vector<Row> rows;   ///< rows[line] for lines from 2
  std::vector<Fate> fate;  ///< of the row with the same index, for passages down
  std::size_t duplicated = 0;
  std::size_t damaged = 0;
  double crowding = 0.0;  ///< rate times the mean time between a passage down and its rebound
};

Stream simulate(const Design& design);

}  // namespace stream
