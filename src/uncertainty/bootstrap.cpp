#include "uncertainty/bootstrap.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/random.hpp"
#include "estimate/noise.hpp"

namespace recoil {
namespace {

// A refit starts at the estimate and needs no more digits than its own scatter has.
LeastSquaresOptions refit_options() {
  LeastSquaresOptions options;
  options.function_tolerance = 1e-9;
  options.gradient_tolerance = 1e-10;
  options.parameter_tolerance = 1e-8;
  options.max_iterations = 100;
  return options;
}

/// Centred, leverage-corrected weighted residuals.
std::vector<double> resampling_pool(const FitResult& fitted, const Observations& data) {
  std::vector<double> pool;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    if (data.points[i].censored) continue;
    constexpr double most_leverage = 0.99;  // a point that the fit passes through says nothing
    const double h = std::min(fitted.leverage[i], most_leverage);
    pool.push_back(fitted.residuals[i] / std::sqrt(1.0 - h));
  }
  double mean = 0.0;
  for (const double r : pool) mean += r / static_cast<double>(pool.size());
  for (double& r : pool) r -= mean;
  return pool;
}

/// Standard errors of a refit: with the noise of the original fit where that is known, with its own
/// where it is estimated. Zero where there is none.
std::vector<double> standard_errors(const Settled& settled, const FitResult& fitted,
                                    bool noise_known) {
  const LeastSquaresResult& refit = settled.run;
  const std::size_t p = refit.theta.size();
  std::vector<double> errors(p, 0.0);
  if (refit.covariance.empty()) return errors;
  // Where the noise is estimated it was so again, together with the parameters of the refit.
  const double scale = noise_known ? fitted.noise_scale : 1.0;
  const std::vector<double> covariance = scaled_covariance(settled.data, refit.covariance, scale);
  for (std::size_t j = 0; j < p; ++j) {
    errors[j] = std::sqrt(covariance[j * p + j]);
  }
  return errors;
}

struct Replicate {
  bool usable = false;
  std::vector<double> theta;
  std::vector<double> std_error;
  std::vector<double> capture;
  std::vector<std::vector<double>> two_point;  // one per dataset, empty when it failed
};

/// Everything that one replicate needs, shared and constant.
struct Plan {
  const FitResult& fitted;
  const Observations& data;
  const std::vector<CaptureEstimate>& capture;
  const std::vector<TwoPointResult>& two_point;
  std::uint64_t seed;
  bool parametric;
  std::vector<double> pool;

  Observations resample(std::uint64_t index) const {
    RandomStream random(seed, RandomPurpose::bootstrap, index);
    Observations sample = data;
    for (std::size_t i = 0; i < sample.points.size(); ++i) {
      Observation& point = sample.points[i];
      if (parametric) {
        point =
            simulate_observation(point, fitted.prediction_squared[i], fitted.noise_scale, random);
        continue;
      }
      const double noise = pool[random.below(pool.size())];
      if (point.censored) continue;  // a capture stays one; its stream position is kept
      const double expected = expected_restitution(point, fitted.prediction_squared[i]);
      point.restitution = std::max(0.0, expected + point.sd * noise);
    }
    return sample;
  }

  Replicate run(std::uint64_t index) const {
    Replicate replicate;
    const Observations sample = resample(index);
    const Settled settled = settle(fitted.model, sample, fitted.theta, refit_options());
    const LeastSquaresResult& refit = settled.run;
    replicate.usable = refit.converged;
    if (replicate.usable) {
      replicate.theta = refit.theta;
      replicate.std_error = standard_errors(settled, fitted, parametric);
      std::vector<CaptureQuery> queries;
      for (const CaptureEstimate& at : capture) {
        queries.push_back({at.dataset, at.diameter, at.value});
      }
      for (const CaptureVelocity& v : capture_velocities(fitted.model, refit.theta, queries)) {
        replicate.capture.push_back(v.found ? v.value : std::nan(""));
      }
    }
    for (std::size_t d = 0; d < two_point.size(); ++d) {
      const TwoPointResult run = recoil::two_point(fitted.model, sample, d, two_point[d].diameter);
      replicate.two_point.push_back(
          run.status == TwoPointStatus::converged ? run.theta : std::vector<double>{});
    }
    return replicate;
  }
};

}  // namespace

BootstrapResult bootstrap(const FitResult& fitted, const Observations& data,
                          const std::vector<CaptureEstimate>& capture,
                          const std::vector<TwoPointResult>& two_point,
                          const UncertaintyOptions& options) {
  BootstrapResult result;
  result.replicates = options.replicates;
  result.seed = options.seed;
  result.scheme = data.sd_stated ? "parametric" : "residual";
  result.scheme_why = data.sd_stated
                          ? "every point states its standard deviation: new noise of that size is "
                            "drawn about the fit"
                          : "no standard deviations are stated: the fit's own residuals, corrected "
                            "for leverage, are drawn about the fit";
  const Plan plan{fitted,
                  data,
                  capture,
                  two_point,
                  options.seed,
                  data.sd_stated,
                  data.sd_stated ? std::vector<double>{} : resampling_pool(fitted, data)};

  std::vector<Replicate> replicates(static_cast<std::size_t>(options.replicates));
  {
    Progress progress("bootstrap", replicates.size());
    parallel_over(replicates.size(), options.threads, [&](std::size_t i) {
      replicates[i] = plan.run(i);
      progress.advance();
    });
  }
  result.two_point_theta.resize(two_point.size());
  result.two_point_failed.assign(two_point.size(), 0);
  for (Replicate& replicate : replicates) {
    if (replicate.usable) {
      result.theta.push_back(std::move(replicate.theta));
      result.std_error.push_back(std::move(replicate.std_error));
      result.capture_velocity.push_back(std::move(replicate.capture));
    } else {
      ++result.failed;
    }
    for (std::size_t d = 0; d < two_point.size(); ++d) {
      if (replicate.two_point[d].empty()) {
        ++result.two_point_failed[d];
      } else {
        result.two_point_theta[d].push_back(std::move(replicate.two_point[d]));
      }
    }
  }
  return result;
}

std::vector<std::vector<double>> jackknife(const FitResult& fitted, const Observations& data,
                                           int threads) {
  std::vector<std::vector<double>> estimates(data.points.size());
  parallel_over(data.points.size(), threads, [&](std::size_t i) {
    Observations rest = data;
    rest.points.erase(rest.points.begin() + static_cast<std::ptrdiff_t>(i));
    const LeastSquaresResult refit =
        settle(fitted.model, std::move(rest), fitted.theta, refit_options()).run;
    if (refit.converged) estimates[i] = refit.theta;
  });
  return estimates;
}

}  // namespace recoil
