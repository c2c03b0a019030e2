#pragma once

#include <string>
#include <vector>

#include "export/exported_impact.hpp"

namespace recoil {

/// e(V, d) for programs that look it up instead of integrating a contact. Every size has its own
/// capture velocity V*, and e^2 stands at multiples of it, x = V / V*: linear in x between the
/// nodes, it stays exact at the capture, where e^2 is zero and e rises like the root. Between sizes
/// everything is linear in ln d, V* in ln-ln. Where some size is not captured, x is V / (1 m/s).
struct RestitutionLookup {
  std::vector<double> diameter;             ///< [m], ascending
  std::vector<double> scale;                ///< V* [m/s] per size, or 1 m/s
  std::vector<double> multiple;             ///< x, ascending, the same for all sizes
  std::vector<std::vector<double>> square;  ///< e^2, [diameter][x]
  bool captures = false;                    ///< scale is V*: below it a sphere stays
  double slowest = 0.0;                     ///< [m/s] of the range that it was made for
  double fastest = 0.0;
  /// Largest |delta e| found between the nodes, from `clear_of_capture` V* on [1]: closer to V* an
  /// error of V* itself counts, as e rises like the root of V - V*.
  double error = 0.0;
  double capture_error = 0.0;  ///< largest relative error of V* between the sizes [1]

  double restitution(double diameter_at, double velocity) const;
};

struct LookupRequest {
  std::size_t dataset = 0;
  std::vector<double> sizes;  ///< smallest and largest diameter [m], or one
  double slowest = 0.0;       ///< [m/s]
  double fastest = 0.0;
};

/// Takes as many nodes as hold |delta e| below `lookup_error` where possible, in V at most 512 and
/// in d at most 17.
RestitutionLookup restitution_lookup(const ImpactModel& model, std::span<const double> theta,
                                     const LookupRequest& request);
inline constexpr double lookup_error = 5e-4;
inline constexpr double clear_of_capture = 1.01;

/// The same as C: arrays, and `double recoil_restitution(double diameter, double velocity)` in SI
/// units, 0 for a sphere that stays. It compiles as C89 and as C++.
std::string lookup_in_c(const RestitutionLookup& lookup);

}  // namespace recoil
