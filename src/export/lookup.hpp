#pragma once

#include <string>
#include <vector>

#include "export/exported_impact.hpp"

namespace recoil {

/// A table of e(V, d) for programs that do not integrate a contact. e^2 is tabulated at multiples
/// of the capture velocity of each size, x = V / V*, and is linear in x between the nodes. This is
/// exact at capture, where e^2 is zero and e rises like the square root. e^2 is linear in ln d
/// between sizes, and ln V* is linear in ln d. If a size is not captured, x is V / (1 m/s).
struct RestitutionLookup {
  std::vector<double> diameter;             ///< [m], ascending
  std::vector<double> scale;                ///< V* [m/s] per size, or 1 m/s
  std::vector<double> multiple;             ///< x, ascending, the same for all sizes
  std::vector<std::vector<double>> square;  ///< e^2, [diameter][x]
  bool captures = false;                    ///< scale is V*, below which a sphere stays
  double slowest = 0.0;                     ///< of the tabulated range [m/s]
  double fastest = 0.0;                     ///< of the tabulated range [m/s]
  /// Largest |delta e| between the nodes above `clear_of_capture` V* [1]. Closer to V* the error of
  /// V* itself dominates, because e rises like the square root of V - V*.
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

/// Increases the number of nodes until |delta e| is below `lookup_error`, up to 513 in V and 17 in
/// d.
RestitutionLookup restitution_lookup(const ImpactModel& model, std::span<const double> theta,
                                     const LookupRequest& request);
inline constexpr double lookup_error = 5e-4;
inline constexpr double clear_of_capture = 1.01;

/// The table as C source: arrays, and `double recoil_restitution(double diameter, double velocity)`
/// in SI units, 0 for captures. It compiles as C89 and as C++.
std::string lookup_in_c(const RestitutionLookup& lookup);

}  // namespace recoil
