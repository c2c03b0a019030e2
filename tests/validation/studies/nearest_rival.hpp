#pragma once

#include <filesystem>
#include <string>

#include "validation/synthetic/case.hpp"

namespace hidden {

/// The single cause of the catalogue, other than the true one, that comes closest to it.
struct NearestRival {
  std::string id;
  double misfit = 0.0;  ///< that it leaves of data without noise, as a signal-to-noise
};

/// Fits every other mechanism (base parameters free) to the case without noise, by the built
/// command. What leaves less than 3 or so, no data of this size can exclude: an honest answer lists
/// it. Whether its parameters would be plausible is not asked. The spreads of size and adhesion,
/// slow to fit, are tried only on what else happens near capture.
NearestRival nearest_rival(const Case& made, const std::filesystem::path& binary);

/// The case with its noise taken away.
Case without_noise(Case made);

/// Misfit that `recoil fit` leaves of a written case with `mechanism` (or none, when empty), as a
/// signal-to-noise; infinite when there is no fit.
double misfit_left(const std::filesystem::path& fit, const std::string& mechanism,
                   const std::filesystem::path& binary);

}  // namespace hidden
