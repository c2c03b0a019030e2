#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/names.hpp"
#include "core/random.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/fit.hpp"
#include "estimate/fit_spec.hpp"

namespace recoil {

/// The rule of `plan_resampling` that selected a scheme.
enum class SchemeBecause {
  asked_for,
  sd_stated,      ///< parametric: every point states its standard deviation
  sd_not_stated,  ///< wild: the scatter need not be equal everywhere
  no_residuals,   ///< parametric: no point rebounded
  shared_errors,  ///< parametric: points share an error, so that single ones cannot be exchanged
};
constexpr auto names_of_values(SchemeBecause) {
  return name_list("asked_for", "sd_stated", "sd_not_stated", "no_residuals", "shared_errors");
}

/// The data from which a scheme draws, prepared once for all replicates. Refers to the fit, which
/// must outlive it.
struct ResamplingPlan {
  Scheme scheme = Scheme::parametric;  ///< never automatic
  SchemeBecause because = SchemeBecause::asked_for;
  const FitResult* fitted = nullptr;
  /// Weighted residuals; residual: the pool; wild: one for each point.
  std::vector<double> residuals;
  /// Points that may depend on each other: of one series or setting, and all that share an error.
  std::vector<std::vector<std::size_t>> clusters;

  /// The number of independent units that are drawn: points, or series.
  std::size_t units() const;
};

/// The reason why `scheme` cannot be used on `data`, in words; nullopt if it can.
std::optional<std::string> scheme_obstacle(Scheme scheme, const Observations& data);

/// Prepares the scheme `asked`. `automatic` becomes parametric if the standard deviations are
/// stated, otherwise wild, which allows unequal scatter (parametric again if `scheme_obstacle`
/// excludes wild).
/// @pre !scheme_obstacle(asked, data)
ResamplingPlan plan_resampling(const FitResult& fitted, Scheme asked);

// The schemes. Each fills `sample.points` from the plan and one stream of random numbers; whatever
// else `sample` holds is not changed. In the first three schemes a captured point stays captured
// and uses its share of the random numbers; in the last two it is drawn with its case or series.

/// e*_i = e_model,i + s sd_i z_i, z standard normal, s the fit's noise_scale. `shared_errors` of e
/// [points] are added (`draw_shared_errors`).
void resample_parametric(const ResamplingPlan& plan, std::span<const double> shared_errors,
                         RandomStream& random, Observations& sample);

/// e*_i = e_model,i + sd_i rho_i, with rho drawn from the centred r_j / sqrt(1 - h_j) of all points
/// that rebounded (Davison & Hinkley 1997, Bootstrap Methods and their Application, section 6.2.3).
void resample_residual(const ResamplingPlan& plan, RandomStream& random, Observations& sample);

/// e*_i = e_model,i + sd_i r_i / (1 - h_i) v_i with v_i = -1 or +1, equally likely: the wild
/// bootstrap (Wu 1986, Ann. Statist. 14, 1261-1295) with the HC3 scaling and Rademacher signs,
/// which performed better in small samples than the two-point distribution of Mammen (1993), see
/// Davidson & Flachaire (2008), J. Econometrics 146, 162-169.
void resample_wild(const ResamplingPlan& plan, RandomStream& random, Observations& sample);

/// Draws n whole points with replacement; makes no assumption about the noise.
void resample_cases(const ResamplingPlan& plan, RandomStream& random, Observations& sample);

/// Draws as many clusters as there are, with replacement. The points of one that is drawn twice
/// share no error with those of its other draw.
void resample_clusters(const ResamplingPlan& plan, RandomStream& random, Observations& sample);

/// Redraws the stated values of the uncertain material constants about those of the fit, as they
/// are observations like the points.
void resample_constants(const FitResult& fitted, std::uint64_t seed, std::uint64_t index,
                        Observations& sample);

/// The sample of replicate `index`: a pure function of (plan, seed, index). `sample` must be a copy
/// of the plan's data; its memory is reused.
void resample(const ResamplingPlan& plan, std::uint64_t seed, std::uint64_t index,
              Observations& sample);

/// The perturbation of each point in replicate `index` [points]: (e* - e_model) / sd, or for cases
/// and clusters how often the point was drawn, minus one.
std::vector<double> perturbation(const ResamplingPlan& plan, std::uint64_t seed,
                                 std::uint64_t index);

/// The covariance of a fit `run` to data like those of `plan` [p x p], computed in the same way for
/// the fit and its replicates: from (J'J)^-1, or as the sandwich covariance if the scheme allows
/// unequal scatter (wild, case, cluster). Empty if J'J is singular.
std::vector<double> replicate_covariance(const LeastSquaresResult& run, const Observations& data,
                                         const Weights& weights, const FitResult& fitted,
                                         const ResamplingPlan& plan);

/// The covariance of the fit itself, computed in the same way.
std::vector<double> reference_covariance(const FitResult& fitted, const ResamplingPlan& plan);

/// Standard errors [p]; zeros without a covariance.
std::vector<double> roots_of_diagonal(std::span<const double> covariance, std::size_t p);

/// The standard error of ln V* from its gradient; 0 if there is none.
double logarithmic_error(const CaptureVelocity& capture, std::span<const double> covariance);

}  // namespace recoil
