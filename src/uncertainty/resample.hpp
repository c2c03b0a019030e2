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

/// By which rule of `plan_resampling` a scheme is used.
enum class SchemeBecause {
  asked_for,
  sd_stated,      ///< parametric: every point states its standard deviation
  sd_not_stated,  ///< wild: the scatter need not be equal everywhere
  no_residuals,   ///< parametric: no point rebounded
  shared_sizes,   ///< parametric: points of one series share an error of their diameter
};
template <>
struct NamesOf<SchemeBecause> {
  static constexpr std::array<std::string_view, 5> names = {
      "asked_for", "sd_stated", "sd_not_stated", "no_residuals", "shared_sizes"};
};

/// Why a scheme cannot be used.
enum class SchemeObstacle {
  no_residuals,     ///< no point rebounded
  single_series,    ///< there is nothing to exchange
  shared_settings,  ///< points of one setting share an error, and single ones would be exchanged
  shared_sizes,     ///< points of one series do
  shared_instants   ///< successive bounces of one launch do
};
template <>
struct NamesOf<SchemeObstacle> {
  static constexpr std::array<std::string_view, 5> names = {
      "no_residuals", "single_series", "shared_settings", "shared_sizes", "shared_instants"};
};

/// What a scheme draws from, prepared once for all replicates. Refers to the fit, which has to
/// outlive it.
struct ResamplingPlan {
  Scheme scheme = Scheme::parametric;  ///< never automatic
  SchemeBecause because = SchemeBecause::asked_for;
  const FitResult* fitted = nullptr;
  std::vector<double> residuals;  ///< residual: the pool; wild: one for each point [weighted]
  std::vector<std::vector<std::size_t>> clusters;  ///< the points of each series that has any

  /// How many things are drawn that are independent of each other: points, or series.
  std::size_t units() const;
};

/// Why `scheme` cannot be used on `data`; none when it can.
std::optional<SchemeObstacle> scheme_obstacle(Scheme scheme, const Observations& data);

/// The same in words, for messages.
std::string obstacle_words(SchemeObstacle obstacle);

/// Prepares `asked`. `automatic` becomes parametric where every point states its standard
/// deviation, and wild otherwise: without stated deviations nobody has said that the scatter is the
/// same everywhere, and wild is the scheme that does not need it.
/// @pre !scheme_obstacle(asked, data)
ResamplingPlan plan_resampling(const FitResult& fitted, Scheme asked);

/// The errors of e that the settings of replicate `index` share [points].
std::vector<double> setting_errors_of(const ResamplingPlan& plan, std::uint64_t seed,
                                      std::uint64_t index);

// The schemes. Each fills `sample.points` from the plan and one stream of random numbers; whatever
// else `sample` holds is left alone. In the first three a captured point stays a captured point and
// its place in the stream is kept; in the last two it travels with its case or series.

/// e*_i = e_model,i + s sd_i z_i, z standard normal, s the fit's noise_scale.
/// Where settings share errors, `setting_errors` of e [points] come on top.
void resample_parametric(const ResamplingPlan& plan, std::span<const double> setting_errors,
                         RandomStream& random, Observations& sample);

/// e*_i = e_model,i + sd_i rho_i, rho drawn from the centred r_j / sqrt(1 - h_j) of all points that
/// rebounded (Davison & Hinkley 1997, Bootstrap Methods and their Application, section 6.2.3).
void resample_residual(const ResamplingPlan& plan, RandomStream& random, Observations& sample);

/// e*_i = e_model,i + sd_i r_i / (1 - h_i) v_i with v_i = -1 or +1, equally likely: the wild
/// bootstrap (Wu 1986, Ann. Statist. 14, 1261-1295) with the HC3 scaling and Rademacher signs,
/// which Davidson & Flachaire (2008), J. Econometrics 146, 162-169, found to do better in small
/// samples than the two-point distribution of Mammen (1993). Where settings share errors, the
/// points of one setting have one sign (Cameron, Gelbach & Miller 2008, Rev. Econ. Stat. 90,
/// 414-427).
void resample_wild(const ResamplingPlan& plan, RandomStream& random, Observations& sample);

/// n whole points with replacement: nothing but the points themselves is assumed.
void resample_cases(const ResamplingPlan& plan, RandomStream& random, Observations& sample);

/// As many whole series as there are, with replacement: points of a series may depend on each
/// other. Where settings share errors, whole settings.
void resample_clusters(const ResamplingPlan& plan, RandomStream& random, Observations& sample);

/// The stated values of the uncertain constants of the materials, drawn anew about those of the
/// fit: they are observations like the points.
void resample_constants(const FitResult& fitted, std::uint64_t seed, std::uint64_t index,
                        Observations& sample);

/// The sample of replicate `index`: a pure function of (plan, seed, index). `sample` has been
/// copied from the plan's data once; its memory is used again.
void resample(const ResamplingPlan& plan, std::uint64_t seed, std::uint64_t index,
              Observations& sample);

/// By how much each point of the data was disturbed in replicate `index`, in units of what is usual
/// for the scheme: (e* - e_model) / sd, or how often the point was drawn less one.
std::vector<double> disturbance(const ResamplingPlan& plan, std::uint64_t seed,
                                std::uint64_t index);

/// The covariance of a fit `run` to data like those of `plan` [p x p], made in the same way for the
/// fit and for its replicates: from (J'J)^-1, or by the sandwich where the scheme allows for points
/// that scatter unequally (wild, case, cluster). Empty where there is none.
std::vector<double> replicate_covariance(const LeastSquaresResult& run, const Observations& data,
                                         const FitResult& fitted, const ResamplingPlan& plan);

/// That of the fit itself.
std::vector<double> reference_covariance(const FitResult& fitted, const ResamplingPlan& plan);

/// Standard errors [p]; zeros without a covariance.
std::vector<double> roots_of_diagonal(std::span<const double> covariance, std::size_t p);

/// The standard error of ln V* by its gradient; 0 where there is none.
double logarithmic_error(const CaptureVelocity& capture, std::span<const double> covariance);

}  // namespace recoil
