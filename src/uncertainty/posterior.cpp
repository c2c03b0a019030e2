#include "uncertainty/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/parallel.hpp"
#include "core/statistics.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/impact_problem.hpp"
#include "uncertainty/ensemble.hpp"

namespace recoil {
namespace {

/// theta as the sampler sees it: what moves, as logarithms where it is fitted so, and those of the
/// damping factors: along C_A ~ f0^-3.75 or so the density is bent in C_A and straight in ln C_A.
/// Not where one may be 0: towards that its logarithm goes on without end.
class PosteriorCoordinates {
 public:
  explicit PosteriorCoordinates(const FitResult& fitted)
      : model_(fitted.model), theta_(fitted.theta), error_(fitted.std_error) {
    for (std::size_t j = 0; j < theta_.size(); ++j) {
      if (model_.slots[j].moves()) moving_.push_back(j);
    }
  }
  const std::vector<std::size_t>& moving() const { return moving_; }
  bool logarithmic(std::size_t j) const { return model_.slots[j].log_scale || flat_itself(j); }
  /// Does its prior ask for a factor of itself, as it is flat and its coordinate the logarithm?
  bool flat_itself(std::size_t j) const {
    constexpr double clear_of_zero = 2.0;  // standard errors
    return !model_.slots[j].log_scale && model_.slots[j].parameter->is_damping() &&
           theta_[j] > clear_of_zero * error_[j];
  }
  double to_z(std::size_t j, double value) const {
    return logarithmic(j) ? std::log(value) : value;
  }
  /// ln d theta / d z.
  double log_volume(std::span<const double> z) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      if (flat_itself(moving_[k])) sum += z[k];
    }
    return sum;
  }
  /// Nothing outside of the bounds.
  bool to_theta(std::span<const double> z, std::vector<double>& theta) const {
    theta = theta_;
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      const ParameterSlot& slot = model_.slots[moving_[k]];
      const double value = logarithmic(moving_[k]) ? std::exp(z[k]) : z[k];
      if (!(value >= slot.lower && value <= slot.upper)) return false;
      theta[moving_[k]] = value;
    }
    return true;
  }

 private:
  const ImpactModel& model_;
  const std::vector<double>& theta_;
  const std::vector<double>& error_;
  std::vector<std::size_t> moving_;
};

/// Is the scale of the noise a parameter, too?
bool scale_unknown(const FitResult& fitted) {
  return !fitted.data.sd_stated || fitted.noise_verdict == NoiseVerdict::exceeded;
}

/// ln posterior of one thread.
class LogPosterior {
 public:
  explicit LogPosterior(const FitResult& fitted)
      : coordinates_(fitted), data_(fitted.data), scale_unknown_(scale_unknown(fitted)) {
    data_.constants_weight = 1.0;
    problem_ = impact_problem(fitted.model, data_);
    residuals_.resize(problem_.residual_count);
  }
  LogPosterior(const LogPosterior&) = delete;
  LogPosterior& operator=(const LogPosterior&) = delete;

  double operator()(std::span<const double> z) {
    if (!coordinates_.to_theta(z, theta_) || !problem_.evaluate(theta_, residuals_, {})) {
      return -INFINITY;
    }
    double scatter = 0.0, rest = 0.0;
    int rebounds = 0;
    for (std::size_t i = 0; i < residuals_.size(); ++i) {
      const double square = residuals_[i] * residuals_[i];
      if (scale_unknown_ && i < data_.points.size() && !data_.points[i].censored) {
        scatter += square;
        ++rebounds;
      } else {
        rest += square;
      }
    }
    return coordinates_.log_volume(z) - 0.5 * rest -
           (scale_unknown_ ? 0.5 * rebounds * std::log(scatter) : 0.0);
  }
  const PosteriorCoordinates& coordinates() const { return coordinates_; }

 private:
  PosteriorCoordinates coordinates_;
  Observations data_;
  bool scale_unknown_;
  LeastSquaresProblem problem_;
  std::vector<double> residuals_, theta_;
};

/// Walkers about the estimate, twice as wide as its errors; empty when too few places are possible.
std::vector<std::vector<double>> scattered(const FitResult& fitted, LogPosterior& density,
                                           std::size_t count, RandomStream& random) {
  constexpr double wide = 2.0;
  constexpr double without_error = 0.05;  // of the value, or of what its bounds allow
  const PosteriorCoordinates& coordinates = density.coordinates();
  std::vector<std::vector<double>> walkers;
  for (std::size_t tries = 0; tries < 200 * count && walkers.size() < count; ++tries) {
    std::vector<double> z;
    for (const std::size_t j : coordinates.moving()) {
      const ParameterSlot& slot = fitted.model.slots[j];
      double value = fitted.theta[j];
      double error = fitted.std_error[j];
      if (!(error > 0.0)) {
        error = without_error * (value > 0.0 ? value : std::max(slot.initial, 1e-3 * slot.upper));
      }
      const bool logarithmic = coordinates.logarithmic(j);
      if (logarithmic) value = std::max(value, error);  // on a bound at 0
      const double step = logarithmic ? std::min(1.0, error / value) : error;
      const double there = coordinates.to_z(j, value) + wide * step * random.normal();
      // At a bound the walkers lie on its inner side.
      z.push_back(logarithmic ? there : slot.lower + std::abs(there - slot.lower));
    }
    if (std::isfinite(density(z))) walkers.push_back(std::move(z));
  }
  if (walkers.size() < count) walkers.clear();
  return walkers;
}

struct EnsembleRun {
  std::unique_ptr<LogPosterior> density;
  std::unique_ptr<Ensemble> ensemble;
  std::vector<std::vector<std::vector<double>>> kept;  // [walker][coordinate][step]
};

void fill_marginal(const std::vector<std::vector<double>>& chains, double level,
                   PosteriorMarginal& marginal) {
  std::vector<double> values;
  for (const std::vector<double>& chain : chains) {
    values.insert(values.end(), chain.begin(), chain.end());
  }
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  for (const double v : values) marginal.mean += v / n;
  for (const double v : values) marginal.sd += (v - marginal.mean) * (v - marginal.mean) / n;
  marginal.sd = std::sqrt(marginal.sd);
  marginal.interval.lower = sorted_quantile(values, 0.5 * (1.0 - level));
  marginal.interval.upper = sorted_quantile(values, 0.5 * (1.0 + level));
}

}  // namespace

PosteriorResult sample_posterior(const FitResult& fitted,
                                 const std::vector<CaptureEstimate>& capture,
                                 const PosteriorOptions& options) {
  PosteriorResult result;
  result.parameters.resize(fitted.theta.size());
  for (PosteriorMarginal& marginal : result.parameters) {
    marginal.interval = no_interval(NoInterval::fixed);
  }
  const PosteriorCoordinates coordinates(fitted);
  const std::size_t p = coordinates.moving().size();
  if (p == 0) return result;
  if (scale_unknown(fitted) && fitted.dof <= 0) {
    result.missing = NoPosterior::few_points;
    return result;
  }
  const std::size_t walkers = std::max<std::size_t>(16, 4 * p);
  std::vector<EnsembleRun> runs(static_cast<std::size_t>(options.ensembles));
  parallel_over(runs.size(), options.threads, [&](std::size_t e) {
    RandomStream random(options.seed, RandomPurpose::posterior, e);
    runs[e].density = std::make_unique<LogPosterior>(fitted);
    auto start = scattered(fitted, *runs[e].density, walkers, random);
    if (start.empty()) return;
    LogPosterior& density = *runs[e].density;
    runs[e].ensemble = std::make_unique<Ensemble>(
        [&density](std::span<const double> z) { return density(z); }, std::move(start), random);
    runs[e].kept.assign(walkers, std::vector<std::vector<double>>(p));
  });
  if (std::any_of(runs.begin(), runs.end(), [](const EnsembleRun& run) { return !run.ensemble; })) {
    result.missing = NoPosterior::no_walkers;
    return result;
  }

  std::vector<std::vector<std::vector<double>>> chains(p);  // [coordinate][all walkers][step]
  for (int steps = options.fewest_steps;; steps *= 2) {
    // What was kept so far becomes what is dropped of the longer run.
    parallel_over(runs.size(), options.threads, [&](std::size_t e) {
      EnsembleRun& run = runs[e];
      const int dropped = steps == options.fewest_steps ? steps : 0;
      for (int k = 0; k < dropped; ++k) run.ensemble->step();
      for (auto& walker : run.kept) {
        for (auto& values : walker) values.clear();
      }
      for (int k = 0; k < steps; ++k) {
        run.ensemble->step();
        for (std::size_t w = 0; w < walkers; ++w) {
          for (std::size_t j = 0; j < p; ++j) {
            run.kept[w][j].push_back(run.ensemble->walkers()[w][j]);
          }
        }
      }
    });
    bool settled = true;
    for (std::size_t j = 0; j < p; ++j) {
      const std::size_t slot = coordinates.moving()[j];
      chains[j].clear();
      for (const EnsembleRun& run : runs) {
        for (const auto& walker : run.kept) chains[j].push_back(walker[j]);
      }
      // Of the values, which are what the draws are for: towards a bound at 0 the logarithms go on
      // without end.
      if (coordinates.logarithmic(slot)) {
        for (std::vector<double>& chain : chains[j]) {
          for (double& value : chain) value = std::exp(value);
        }
      }
      PosteriorMarginal& marginal = result.parameters[slot];
      marginal.r_hat = split_r_hat(chains[j]);
      marginal.effective = effective_sample_size(chains[j]);
      settled = settled && marginal.r_hat <= options.largest_r_hat &&
                marginal.effective >= options.least_effective;
    }
    result.steps = steps;
    if (settled) break;
    if (2 * steps > options.most_steps) {
      result.missing = NoPosterior::not_settled;
      return result;
    }
  }
  result.walkers = static_cast<int>(walkers * runs.size());
  for (const EnsembleRun& run : runs) {
    result.acceptance += run.ensemble->acceptance() / static_cast<double>(runs.size());
  }
  for (std::size_t j = 0; j < p; ++j) {
    const std::size_t slot = coordinates.moving()[j];
    PosteriorMarginal& marginal = result.parameters[slot];
    marginal.interval = {};
    fill_marginal(chains[j], options.level, marginal);
  }

  // Joint draws: every so many of all that were kept, walker by walker.
  const std::size_t steps = static_cast<std::size_t>(result.steps);
  const std::size_t total = chains.front().size() * steps;
  const std::size_t kept = std::min(options.kept, total);
  for (std::size_t k = 0; k < kept; ++k) {
    const std::size_t at = k * total / kept;
    std::vector<double> theta = fitted.theta;
    for (std::size_t j = 0; j < p; ++j) {
      theta[coordinates.moving()[j]] = chains[j][at / steps][at % steps];
    }
    result.draws.push_back(std::move(theta));
  }
  std::vector<CaptureQuery> queries;
  for (const CaptureEstimate& at : capture) queries.push_back({at.dataset, at.diameter, at.value});
  result.capture_draws.resize(kept);
  parallel_over(kept, options.threads, [&](std::size_t k) {
    for (const CaptureVelocity& v :
         recoil::capture_velocities(fitted.model, result.draws[k], queries)) {
      result.capture_draws[k].push_back(v.found ? v.value : std::nan(""));
    }
  });
  for (std::size_t q = 0; q < queries.size(); ++q) {
    PosteriorMarginal& marginal = result.capture.emplace_back();
    std::vector<double> values;
    for (const std::vector<double>& draw : result.capture_draws) {
      if (std::isfinite(draw[q])) values.push_back(draw[q]);
    }
    if (static_cast<double>(values.size()) < share_for_band * static_cast<double>(kept)) {
      marginal.interval = no_interval(NoInterval::never_rebounds);
    } else {
      fill_marginal({values}, options.level, marginal);
    }
  }
  return result;
}

}  // namespace recoil
