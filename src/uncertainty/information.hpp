#pragma once

#include <string>
#include <vector>

#include "estimate/fit.hpp"

namespace recoil {

/// One direction of the expected information: the product of powers of the free parameters that is
/// known best, next best, ...
struct InformationDirection {
  std::vector<double> exponents;  ///< [slots] of unit length; 0 for what is not free
  double relative_sd = 0.0;       ///< standard deviation of the logarithm of that product [1]
  std::string words;              ///< "f0^0.97 C_A^0.25", and what that is physically
};

/// What more points at one place would do.
struct PlannedPoints {
  std::size_t dataset = 0;
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  int points = 0;
  std::vector<double> relative_sd;  ///< [slots] then, 0 for what is not free
};

/// The Fisher information J'J of the weighted residuals in the logarithms of the free parameters
/// that rest on no bound, at the estimate. Its eigenvectors are combinations that the data see
/// (stiff) or hardly see (sloppy).
struct Information {
  std::vector<InformationDirection> directions;  ///< stiff first
  std::vector<double> relative_sd;               ///< [slots] now, 0 for what is not free
  double condition = 1.0;                        ///< largest over smallest eigenvalue
  std::vector<PlannedPoints> plans;  ///< the most useful place first, for the worst known parameter
};

/// @param capture the capture velocity [m/s] of every (dataset, diameter) of the data; 0: none
struct CapturePlace {
  std::size_t dataset = 0;
  double diameter = 0.0;
  double velocity = 0.0;
};
Information information_at(const FitResult& fitted, const std::vector<CapturePlace>& capture);

}  // namespace recoil
