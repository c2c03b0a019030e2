#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/json.hpp"
#include "validation/synthetic/case.hpp"

namespace recoil::hidden {

/// A single cause of the catalogue, other than the true one, that comes closest to it.
struct NearestRival {
  std::string id;
  double misfit = 0.0;  ///< that it leaves of data without noise, as a signal-to-noise
  int freed = 0;        ///< its parameters that the catalogue fixes and that were fitted
  RECOIL_FIELDS(id, misfit, freed)

  /// The probability that its criterion is worse by 4 than that of the true cause: nobody who asks
  /// for odds of e^2 names the cause more often. With lambda the square of the misfit, the
  /// difference is normal with the mean lambda + 2 freed and the variance 4 lambda.
  double nameable() const;
};

/// What somebody could answer at best who knows the noise of the points of one case and the effect
/// that may be hidden in them, with its size.
struct IdealJudge {
  NearestRival rival;  ///< of all causes; empty where it is not sought
  NearestRival other;  ///< of those that are no law of the true cause
  double sees = 0.0;   ///< `probability_to_see`
  RECOIL_FIELDS(rival, other, sees)
};

/// Asks him: of the effect's rivals where it is one of the catalogue in several diameters.
IdealJudge ideal_judge(const Case& made, bool with_rivals);

/// Fits every other mechanism (base parameters free) to the case without noise, also with the
/// parameters free that a diagnosis may release. What leaves less than 3 or so, no data of this
/// size can exclude: an honest answer lists it. Whether its parameters would be plausible is not
/// asked. The spreads of size and adhesion, slow to fit, are tried only on what else happens near
/// capture.
/// @return the nearest of all, and of those that are no law of the true cause
std::pair<NearestRival, NearestRival> nearest_rivals(const Case& made);

/// The probability that the most powerful test sees an effect, if the laws of the base model may be
/// wrong. Without the effect the residuals of the points are normal,
///   z ~ N(0, I + s^2 F F'), with s of 3, 6 or 12 % in proportion to their probabilities;
/// the test is the likelihood ratio of z - `effect` against z, and it raises a false alarm in 5 %
/// of such data (Neyman & Pearson 1933, Phil. Trans. R. Soc. A 231, 289-337). The probability is
/// that for z = `effect` and noise: the laws are exact in truth. Nobody who allows these errors,
/// and cries no oftener in vain, sees more.
/// @param effect what it does to the residuals [n]
/// @param errors F [n x any]: what relative errors of the losses of 1 do to them
/// @param draws with and without the effect; the standard error is at most 0.5 / sqrt(draws)
double power_beside_law_errors(const Eigen::VectorXd& effect, const Eigen::MatrixXd& errors,
                               std::uint64_t seed, int draws = 4000);

/// The same for a case whose points have no noise. C_H and C_A are unknown, and the losses of the
/// base model have an unknown factor 1 + g with g normal and smooth in ln V and ln d (correlation
/// lengths of 1). Linear in both.
double probability_to_see(const Case& made);

/// The case with its noise taken away.
Case without_noise(Case made);

/// Misfit that a fit leaves of a written case with `mechanism` (or none, when empty), as a
/// signal-to-noise; infinite when there is no fit.
double misfit_left(const std::filesystem::path& fit, const std::string& mechanism,
                   const std::vector<std::string>& freed = {});

}  // namespace recoil::hidden
