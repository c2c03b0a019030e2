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

/// The sampler's answer under one variance function of the noise.
struct SampledFit {
  std::optional<NoPosterior> missing;
  int steps = 0;
  std::size_t walkers = 0;
  double acceptance = 0.0;
  std::vector<double> r_hat, effective;                  // [moving]
  std::vector<std::vector<std::vector<double>>> chains;  // [moving][walkers of all][step]
};

/// The chains of the kept draws as values of the parameters, and whether they have settled.
bool read_chains(const std::vector<EnsembleRun>& runs, const PosteriorCoordinates& coordinates,
                 const PosteriorOptions& options, SampledFit& sampled) {
  const std::size_t p = coordinates.moving().size();
  sampled.chains.assign(p, {});
  sampled.r_hat.assign(p, 0.0);
  sampled.effective.assign(p, 0.0);
  bool settled = true;
  for (std::size_t j = 0; j < p; ++j) {
    auto& chains = sampled.chains[j];
    for (const EnsembleRun& run : runs) {
      for (const auto& walker : run.kept) chains.push_back(walker[j]);
    }
    // Of the values, which are what the draws are for: towards a bound at 0 the logarithms go on
    // without end.
    if (coordinates.logarithmic(coordinates.moving()[j])) {
      for (std::vector<double>& chain : chains) {
        for (double& value : chain) value = std::exp(value);
      }
    }
    sampled.r_hat[j] = split_r_hat(chains);
    sampled.effective[j] = effective_sample_size(chains);
    settled = settled && sampled.r_hat[j] <= options.largest_r_hat &&
              sampled.effective[j] >= options.least_effective;
  }
  return settled;
}

/// @param first_stream of random numbers; every ensemble has its own
SampledFit sample_one(const FitResult& fitted, const PosteriorOptions& options,
                      std::size_t first_stream) {
  SampledFit sampled;
  const PosteriorCoordinates coordinates(fitted);
  const std::size_t p = coordinates.moving().size();
  const std::size_t walkers = std::max<std::size_t>(16, 4 * p);
  std::vector<EnsembleRun> runs(static_cast<std::size_t>(options.ensembles));
  parallel_over(runs.size(), options.threads, [&](std::size_t e) {
    RandomStream random(options.seed, RandomPurpose::posterior, first_stream + e);
    runs[e].density = std::make_unique<LogPosterior>(fitted);
    auto start = scattered(fitted, *runs[e].density, walkers, random);
    if (start.empty()) return;
    LogPosterior& density = *runs[e].density;
    runs[e].ensemble = std::make_unique<Ensemble>(
        [&density](std::span<const double> z) { return density(z); }, std::move(start), random);
    runs[e].kept.assign(walkers, std::vector<std::vector<double>>(p));
  });
  if (std::any_of(runs.begin(), runs.end(), [](const EnsembleRun& run) { return !run.ensemble; })) {
    sampled.missing = NoPosterior::no_walkers;
    return sampled;
  }
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
    sampled.steps = steps;
    if (read_chains(runs, coordinates, options, sampled)) break;
    if (2 * steps > options.most_steps) {
      sampled.missing = NoPosterior::not_settled;
      return sampled;
    }
  }
  sampled.walkers = walkers * runs.size();
  for (const EnsembleRun& run : runs) {
    sampled.acceptance += run.ensemble->acceptance() / static_cast<double>(runs.size());
  }
  return sampled;
}

/// A value and how much of the posterior it stands for.
struct WeightedDraw {
  double value = 0.0;
  double weight = 0.0;
};

void fill_marginal(std::vector<WeightedDraw> draws, double level, PosteriorMarginal& marginal) {
  std::sort(draws.begin(), draws.end(),
            [](const WeightedDraw& a, const WeightedDraw& b) { return a.value < b.value; });
  double total = 0.0;
  for (const WeightedDraw& draw : draws) total += draw.weight;
  for (const WeightedDraw& draw : draws) marginal.mean += draw.value * draw.weight / total;
  for (const WeightedDraw& draw : draws) {
    marginal.sd += std::pow(draw.value - marginal.mean, 2) * draw.weight / total;
  }
  marginal.sd = std::sqrt(marginal.sd);
  // The value below which the share p of the weight lies, each draw standing in the middle of its
  // own.
  const auto quantile = [&](double p) {
    double below = 0.0;
    for (std::size_t k = 0; k < draws.size(); ++k) {
      const double middle = below + 0.5 * draws[k].weight;
      if (middle >= p * total) {
        if (k == 0) return draws[k].value;
        const double before = below - 0.5 * draws[k - 1].weight;
        const double part = (p * total - before) / (middle - before);
        return draws[k - 1].value + part * (draws[k].value - draws[k - 1].value);
      }
      below += draws[k].weight;
    }
    return draws.back().value;
  };
  marginal.interval = {};
  marginal.interval.lower = quantile(0.5 * (1.0 - level));
  marginal.interval.upper = quantile(0.5 * (1.0 + level));
}

/// Constants that the fit holds: every draw of the parameters was made with the stated ones. Gives
/// each draw constants of its own, from their errors, and moves it as the fit would move, to first
/// order (a parameter above 0 by a factor). The constants come after the parameters.
void draw_constants(const FitResult& fitted, const std::vector<std::size_t>& moving,
                    std::uint64_t seed, SampledFit& sampled) {
  const ImpactModel& model = fitted.model;
  const std::size_t count = fitted.constant_effects.size();
  if (count == 0 || sampled.chains.empty()) return;
  const std::size_t chains = sampled.chains.front().size();
  const std::size_t steps = sampled.chains.front().front().size();
  const std::vector<std::vector<double>> empty(chains, std::vector<double>(steps));
  sampled.chains.resize(moving.size() + count, empty);
  sampled.r_hat.resize(moving.size() + count, 1.0);
  sampled.effective.resize(moving.size() + count, static_cast<double>(chains * steps));
  std::vector<double> z(count);
  for (std::size_t c = 0; c < chains; ++c) {
    RandomStream random(seed, RandomPurpose::constants, c);
    for (std::size_t i = 0; i < steps; ++i) {
      for (std::size_t k = 0; k < count; ++k) {
        z[k] = random.normal();
        const UncertainConstant& constant = model.constants[k];
        sampled.chains[moving.size() + k][c][i] = constant.moved(constant.stated, z[k]);
      }
      for (std::size_t j = 0; j < moving.size(); ++j) {
        const ParameterSlot& slot = model.slots[moving[j]];
        const double estimate = fitted.theta[moving[j]];
        double by = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
          by += z[k] * fitted.constant_effects[k][moving[j]];
        }
        double& value = sampled.chains[j][c][i];
        value = slot.lower >= 0.0 && estimate > 0.0 ? value * std::exp(by / estimate) : value + by;
        value = std::clamp(value, slot.lower, slot.upper);
      }
    }
  }
}

/// Marginals of the parameters from the draws under all variance functions.
void fill_parameters(const std::vector<std::size_t>& moving, const std::vector<SampledFit>& sampled,
                     const std::vector<double>& weights, double level, PosteriorResult& result) {
  for (std::size_t j = 0; j < moving.size(); ++j) {
    PosteriorMarginal& marginal = result.parameters[moving[j]];
    std::vector<WeightedDraw> draws;
    double variance = 0.0;  // of a mean, in variances of a draw
    for (std::size_t k = 0; k < sampled.size(); ++k) {
      const auto& chains = sampled[k].chains[j];
      const auto count = static_cast<double>(chains.size() * chains.front().size());
      for (const std::vector<double>& chain : chains) {
        for (const double value : chain) draws.push_back({value, weights[k] / count});
      }
      marginal.r_hat = std::max(marginal.r_hat, sampled[k].r_hat[j]);
      variance += weights[k] * weights[k] / sampled[k].effective[j];
    }
    marginal.effective = 1.0 / variance;
    fill_marginal(std::move(draws), level, marginal);
  }
}

/// Joint draws: of every variance function its share, every so many of all that were kept, walker
/// by walker.
void keep_draws(const std::vector<std::size_t>& moving, std::span<const double> theta,
                const std::vector<SampledFit>& sampled, const std::vector<double>& weights,
                std::size_t wanted, PosteriorResult& result) {
  double before = 0.0;
  for (std::size_t k = 0; k < sampled.size(); ++k) {
    const double after = before + weights[k];
    const auto share = [&](double part) {
      return static_cast<std::size_t>(
          std::llround(std::min(part, 1.0) * static_cast<double>(wanted)));
    };
    const std::size_t kept =
        k + 1 == sampled.size() ? wanted - share(before) : share(after) - share(before);
    before = after;
    const auto& chains = sampled[k].chains;
    const auto steps = chains.front().front().size();
    const std::size_t total = chains.front().size() * steps;
    for (std::size_t i = 0; i < std::min(kept, total); ++i) {
      const std::size_t at = i * total / std::min(kept, total);
      std::vector<double> draw(theta.begin(), theta.end());
      for (std::size_t j = 0; j < moving.size(); ++j) {
        draw[moving[j]] = chains[j][at / steps][at % steps];
      }
      result.draws.push_back(std::move(draw));
    }
  }
}

void fill_capture(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                  const PosteriorOptions& options, PosteriorResult& result) {
  const std::size_t kept = result.draws.size();
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
    std::vector<WeightedDraw> values;
    for (const std::vector<double>& draw : result.capture_draws) {
      if (std::isfinite(draw[q])) values.push_back({draw[q], 1.0});
    }
    if (static_cast<double>(values.size()) < share_for_band * static_cast<double>(kept)) {
      marginal.interval = no_interval(NoInterval::never_rebounds);
    } else {
      fill_marginal(std::move(values), options.level, marginal);
    }
  }
}

}  // namespace

PosteriorResult sample_posterior(const std::vector<NoiseAlternative>& alternatives,
                                 const std::vector<CaptureEstimate>& capture,
                                 const PosteriorOptions& options) {
  const FitResult& fitted = alternatives.front().fitted;
  PosteriorResult result;
  result.parameters.resize(fitted.theta.size());
  for (PosteriorMarginal& marginal : result.parameters) {
    marginal.interval = no_interval(NoInterval::fixed);
  }
  std::vector<std::size_t> moving = PosteriorCoordinates(fitted).moving();
  if (moving.empty()) return result;
  if (scale_unknown(fitted) && fitted.dof <= 0) {
    result.missing = NoPosterior::few_points;
    return result;
  }
  std::vector<SampledFit> sampled;
  std::vector<double> weights;
  for (const NoiseAlternative& alternative : alternatives) {
    sampled.push_back(sample_one(alternative.fitted, options,
                                 sampled.size() * static_cast<std::size_t>(options.ensembles)));
    weights.push_back(alternative.weight);
    const SampledFit& own = sampled.back();
    result.steps = std::max(result.steps, own.steps);
    result.walkers += static_cast<int>(own.walkers);
    result.acceptance += alternative.weight * own.acceptance;
    for (std::size_t j = 0; own.missing && j < own.r_hat.size(); ++j) {
      result.parameters[moving[j]].r_hat = own.r_hat[j];
      result.parameters[moving[j]].effective = own.effective[j];
    }
    result.missing = own.missing;
    if (result.missing) return result;
    draw_constants(alternative.fitted, moving, options.seed, sampled.back());
  }
  for (std::size_t k = 0; k < fitted.constant_effects.size(); ++k) {
    moving.push_back(fitted.model.first_constant() + k);
  }
  fill_parameters(moving, sampled, weights, options.level, result);
  keep_draws(moving, fitted.theta, sampled, weights, options.kept, result);
  fill_capture(fitted, capture, options, result);
  return result;
}

}  // namespace recoil
