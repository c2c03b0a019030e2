#pragma once

#include <gsl/gsl_spline.h>

#include <functional>
#include <memory>
#include <vector>

#include "core/random.hpp"
#include "data/measured_sizes.hpp"

namespace recoil {

/// e(V) of the truth for one diameter, tabulated: e^2 V^2 against V^2 is nearly straight, so that
/// Steffen's monotone cubic is good to 1e-5 here.
class TrueCurve {
 public:
  /// @param restitution e [1] at a velocity [m/s]; 0 when captured
  /// @param capture the capture velocity [m/s]
  /// @param fastest the end of the table [m/s]; faster impacts get the e of this one
  TrueCurve(const std::function<double(double velocity)>& restitution, double capture,
            double fastest);

  /// e at `v` [m/s]; 0 when captured.
  double operator()(double v) const;

 private:
  double capture_;
  double fastest_;
  std::shared_ptr<const gsl_spline> spline_;
};

/// e of the truth for spheres of mixed sizes at one velocity.
class TrueMixture {
 public:
  /// @param restitution e [1] of a sphere of a diameter [m]; 0 when captured
  /// @param mean diameter of the spheres of this point [m], to which `sizes` are scaled
  /// @param velocity of all of them [m/s]
  TrueMixture(const std::function<double(double diameter)>& restitution, const MeasuredSizes& sizes,
              double mean, double velocity);

  /// e of one sphere; 0 when it is captured, or too slow to climb back to the measuring plane.
  double draw(RandomStream& random) const;

 private:
  std::vector<double> below_;  // part of the spheres up to and with this one
  std::vector<double> restitution_;
};

/// What one point keeps of impacts that differ from one another.
struct CountedImpacts {
  int captured = 0;
  double restitution = 0.0;       ///< mean e of those that rebounded [1]
  double variance_of_mean = 0.0;  ///< of that mean, by the scatter of the impacts [1]
};

/// `events` impacts, each with an e of its own; 0 when captured.
CountedImpacts count_impacts(int events, const std::function<double()>& restitution);

/// `events` impacts, each at a velocity [m/s] of its own.
CountedImpacts count_impacts(const TrueCurve& curve, int events,
                             const std::function<double()>& velocity);

}  // namespace recoil
