#pragma once

#include <optional>
#include <vector>

#include "estimate/fit.hpp"

namespace recoil {

/// A combination of parameters with a physical meaning.
enum class Combination {
  capture_velocity,  ///< V*^2 ~ V_a^3 (C_A + 2 C_H)
  adhesion_loss,     ///< C_A f0, far above capture
  plateau_loss,      ///< C_H, in the fastest impacts
};

/// One eigenvector of the expected information: a product of powers of the free parameters.
struct InformationDirection {
  std::vector<double> exponents;       ///< [slots] with unit norm; 0 for slots that are not free
  double relative_sd = 0.0;            ///< standard deviation of the logarithm of that product [1]
  std::optional<Combination> meaning;  ///< the combination whose direction is within acos(0.97)
};

/// The effect of more points at one velocity and diameter.
struct PlannedPoints {
  std::size_t dataset = 0;
  double diameter = 0.0;          ///< [m]
  double velocity = 0.0;          ///< [m/s]
  double capture_velocity = 0.0;  ///< V* of this diameter [m/s]
  int points = 0;
  std::vector<double> relative_sd;  ///< [slots] with these points; 0 for slots that are not free
};

/// The Fisher information J'J of the weighted residuals in the logarithms of the free parameters
/// that are not at a bound, at the estimate. Its eigenvectors are combinations that the data
/// determine well (stiff) or hardly (sloppy).
struct Information {
  std::vector<InformationDirection> directions;  ///< stiff first
  /// [slots] with the present points; 0 for slots that are not free.
  std::vector<double> relative_sd;
  double condition = 1.0;            ///< largest over smallest eigenvalue
  std::vector<PlannedPoints> plans;  ///< the most useful first, for the least known parameter
};

/// The error of a parameter now, and with the points of a plan.
struct ErrorGain {
  std::size_t slot = 0;
  double now = 0.0, then = 0.0;  ///< relative [1]
};

/// The parameters whose error the most useful plan reduces by more than a fifth.
std::vector<ErrorGain> worthwhile_gains(const Information& information);

/// A diameter of the data, with its capture velocity.
struct CapturePlace {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]; 0: none
};

/// The information of the points of a fit, and the effect of more points. @param capture every
/// (dataset, diameter) of the data
Information information_at(const FitResult& fitted, const std::vector<CapturePlace>& capture);

}  // namespace recoil
