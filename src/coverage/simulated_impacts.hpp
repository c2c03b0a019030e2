#pragma once

#include <gsl/gsl_spline.h>

#include <functional>
#include <memory>
#include <vector>

#include "core/random.hpp"
#include "data/measured_sizes.hpp"

namespace recoil {

/// The true e(V) of one diameter, tabulated as e^2 V^2 against V^2. This is nearly a straight line,
/// so that Steffen's monotone cubic has an error of 1e-5.
class TrueCurve {
 public:
  /// @param restitution e [1] at a velocity [m/s]; 0 when captured
  /// @param capture the capture velocity [m/s]
  /// @param fastest the end of the table [m/s]; faster impacts have the same e
  TrueCurve(const std::function<double(double velocity)>& restitution, double capture,
            double fastest);

  /// e at `v` [m/s]; 0 if captured.
  double operator()(double v) const;

 private:
  double capture_;
  double fastest_;
  std::shared_ptr<const gsl_spline> spline_;
};

/// The true e of spheres of mixed sizes at one velocity.
class TrueMixture {
 public:
  /// @param restitution e [1] of a sphere of a diameter [m]; 0 when captured
  /// @param mean diameter of the spheres of this point [m]; `sizes` are scaled to it
  /// @param velocity incident velocity [m/s]
  TrueMixture(const std::function<double(double diameter)>& restitution, const MeasuredSizes& sizes,
              double mean, double velocity);

  /// Draws e of one sphere; 0 if it is captured or too slow to reach the measuring plane.
  double draw(RandomStream& random) const;

 private:
  std::vector<double> below_;  // cumulative fraction of the spheres, including this size
  std::vector<double> restitution_;
};

/// The summary of the impacts of one point.
struct CountedImpacts {
  int captured = 0;
  double restitution = 0.0;       ///< mean e of the rebounds [1]
  double variance_of_mean = 0.0;  ///< variance of that mean from the scatter of the impacts [1]
};

/// Summarises `events` impacts. @param restitution draws e of one impact; 0 if captured
CountedImpacts count_impacts(int events, const std::function<double()>& restitution);

}  // namespace recoil
