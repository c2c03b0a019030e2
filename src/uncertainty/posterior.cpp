#include "uncertainty/posterior.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "core/parallel.hpp"
#include "core/statistics.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/likelihood.hpp"
#include "estimate/shared_errors.hpp"

namespace recoil {
namespace {

/// The coordinates z of the sampler: the moving parameters, as logarithms for `log_scale` and for
/// damping factors. (The density extends along C_A ~ f0^-3.75, which is curved in C_A and straight
/// in ln C_A.) A damping factor that may be 0 keeps a linear coordinate, because its logarithm is
/// unbounded.
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
  double to_z(std::size_t j, double value) const {
    return logarithmic(j) ? std::log(value) : value;
  }
  /// d theta / d z.
  double slope(std::size_t j, double value) const { return logarithmic(j) ? value : 1.0; }
  /// The log-Jacobian: sum of ln d theta / d z over the logarithmic coordinates whose prior is flat
  /// in theta.
  double log_volume(std::span<const double> z) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < moving_.size(); ++k) {
      if (flat_itself(moving_[k])) sum += z[k];
    }
    return sum;
  }
  /// Computes theta from z. @return false if it is outside the bounds
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
  /// Has the slot a prior flat in theta but a logarithmic coordinate, so that the density in z has
  /// a factor theta?
  bool flat_itself(std::size_t j) const {
    constexpr double clear_of_zero = 2.0;  // standard errors
    return !model_.slots[j].log_scale && model_.slots[j].parameter->is_damping() &&
           theta_[j] > clear_of_zero * error_[j];
  }

  const ImpactModel& model_;
  const std::vector<double>& theta_;
  const std::vector<double>& error_;
  std::vector<std::size_t> moving_;
};

/// Is the scale of the noise a parameter?
bool scale_unknown(const FitResult& fitted) {
  return !fitted.data.noise.sd_stated || fitted.noise_verdict == NoiseVerdict::exceeded;
}

/// A state of a chain.
struct State {
  std::vector<double> z, theta, residuals;
  double log_density = -INFINITY;  ///< posterior density in z, up to a constant
};

/// The posterior under one variance function, for one thread.
class Posterior {
 public:
  explicit Posterior(const FitResult& fitted)
      : coordinates(fitted),
        scaled(scale_unknown(fitted)),
        fitted_(fitted),
        data_(fitted.data),
        weights_(fitted.weights),
        log_determinant_(SharedErrors(data_, weights_).log_determinant()) {
    weights_.noise.constants_weight = 1.0;
    problem_ = impact_problem(fitted.model, data_, weights_);
    // ln of each point's density at its peak, for scale 1. The density of a mean is normal in e.
    for (std::size_t i = 0; i < data_.points.size(); ++i) {
      const Observation& point = data_.points[i];
      peaks_.push_back(
          log_peak_density(point, weights_.points[i], point.restitution * point.restitution));
    }
  }
  Posterior(const Posterior&) = delete;
  Posterior& operator=(const Posterior&) = delete;

  const PosteriorCoordinates coordinates;
  const bool scaled;  ///< the scale of the noise is unknown

  void evaluate(State& state) {
    state.log_density = -INFINITY;
    state.residuals.resize(problem_.residual_count);
    if (!coordinates.to_theta(state.z, state.theta) ||
        !problem_.evaluate(state.theta, state.residuals, {})) {
      return;
    }
    const auto [scatter, rebounds, rest] = sums(state.residuals);
    state.log_density = coordinates.log_volume(state.z) - 0.5 * rest -
                        (scaled ? 0.5 * rebounds * std::log(scatter) : 0.0);
  }

  /// The estimate in z, and the Gauss-Newton covariance there, from J'J and the precision of the
  /// priors.
  std::pair<Eigen::VectorXd, Eigen::MatrixXd> normal_about_estimate() {
    const std::vector<std::size_t>& moving = coordinates.moving();
    const std::size_t p = fitted_.theta.size();
    const auto count = static_cast<Eigen::Index>(moving.size());
    std::vector<double> residuals(problem_.residual_count);
    std::vector<double> jacobian(problem_.residual_count * p);
    Eigen::VectorXd centre(count);
    Eigen::MatrixXd slopes =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(residuals.size()), count);
    Eigen::VectorXd own = Eigen::VectorXd::Zero(count);  // precision of the prior
    const bool answered = problem_.evaluate(fitted_.theta, residuals, jacobian);
    for (Eigen::Index k = 0; k < count; ++k) {
      const std::size_t j = moving[static_cast<std::size_t>(k)];
      const ParameterSlot& slot = fitted_.model.slots[j];
      centre(k) = coordinates.to_z(j, fitted_.theta[j]);
      for (Eigen::Index i = 0; answered && i < slopes.rows(); ++i) {
        slopes(i, k) =
            jacobian[static_cast<std::size_t>(i) * p + j] * coordinates.slope(j, fitted_.theta[j]);
      }
      // A flat prior has the variance width^2 / 12.
      const double width =
          coordinates.to_z(j, slot.upper) - coordinates.to_z(j, std::max(slot.lower, 0.0));
      if (std::isfinite(width) && width > 0.0) own(k) = 12.0 / (width * width);
    }
    const auto [scatter, rebounds, rest] = sums(residuals);
    const double variance = scaled ? scatter / std::max(1, fitted_.dof) : 1.0;
    const Eigen::Index points = static_cast<Eigen::Index>(data_.points.size());
    slopes.topRows(points) /= std::sqrt(variance);
    Eigen::MatrixXd precision = slopes.transpose() * slopes;
    precision.diagonal() += own;
    return {centre, precision.inverse()};
  }

  /// Draws the scale of the noise, given the parameters.
  double draw_scale(const State& state, RandomStream& random) const {
    const auto [scatter, rebounds, rest] = sums(state.residuals);
    return std::sqrt(scatter / gsl_cdf_chisq_Pinv(random.uniform(), rebounds));
  }
  /// ln likelihood of every point [points].
  std::vector<double> pointwise(const State& state, double scale) const {
    std::vector<double> each = peaks_;
    for (std::size_t i = 0; i < each.size(); ++i) {
      const double s = scatters(i) ? scale : 1.0;
      each[i] -= 0.5 * std::pow(state.residuals[i] / s, 2) + std::log(s);
    }
    return each;
  }
  /// The term that shared errors add to the sum of `pointwise`.
  double shared() const { return -0.5 * log_determinant_; }
  /// ln prior density of theta, or of ln theta for `log_scale`.
  double log_prior(const State& state, double scale) const {
    double ln = -std::log(scale);
    for (const std::size_t j : coordinates.moving()) {
      const ParameterSlot& slot = fitted_.model.slots[j];
      if (slot.is_constant()) {
        const std::size_t k = j - fitted_.model.first_constant();
        const double deviation = state.residuals[data_.points.size() + k];
        ln += std::log(fitted_.model.constants[k].deviation_slope(state.theta[j])) -
              0.5 * (deviation * deviation + std::log(2.0 * std::numbers::pi));
        if (slot.log_scale) ln += std::log(state.theta[j]);
      } else {
        ln -=
            std::log(slot.log_scale ? std::log(slot.upper / slot.lower) : slot.upper - slot.lower);
      }
    }
    return ln;
  }

 private:
  struct Sums {
    double scatter = 0.0;  ///< sum of squares with an unknown scale
    int rebounds = 0;      ///< number of these residuals
    double rest = 0.0;
  };
  bool scatters(std::size_t i) const {
    return scaled && i < data_.points.size() && !data_.points[i].censored;
  }
  Sums sums(std::span<const double> residuals) const {
    Sums sums;
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      (scatters(i) ? sums.scatter : sums.rest) += residuals[i] * residuals[i];
      sums.rebounds += scatters(i) ? 1 : 0;
    }
    return sums;
  }

  const FitResult& fitted_;
  const Observations& data_;
  Weights weights_;
  double log_determinant_;
  LeastSquaresProblem problem_;
  std::vector<double> peaks_;
};

/// The proposal distributions of the chains, with a common covariance in z.
class Proposals {
 public:
  Proposals(Eigen::VectorXd centre, const Eigen::MatrixXd& covariance)
      : centre_(std::move(centre)), factor_(covariance) {}
  bool usable() const { return factor_.info() == Eigen::Success && centre_.allFinite(); }

  /// Draws from Student's t about the centre, scaled by `wide`.
  std::vector<double> independent_proposal(RandomStream& random, double wide = 1.0) const {
    const double squares = gsl_cdf_chisq_Pinv(random.uniform(), freedom);
    return away(centre_, wide * std::sqrt(freedom / squares), random);
  }
  /// ln density of `independent_proposal`, up to a constant.
  double log_density(const std::vector<double>& z) const {
    const Eigen::Map<const Eigen::VectorXd> at(z.data(), centre_.size());
    const double square = factor_.matrixL().solve(at - centre_).squaredNorm();
    return -0.5 * (freedom + static_cast<double>(centre_.size())) * std::log1p(square / freedom);
  }
  std::vector<double> random_walk(const std::vector<double>& z, RandomStream& random) const {
    const Eigen::Map<const Eigen::VectorXd> at(z.data(), centre_.size());
    // The optimal step for a normal density (Roberts, Gelman & Gilks 1997), or a third of it.
    const double length = 2.38 / std::sqrt(static_cast<double>(centre_.size()));
    return away(at, random.uniform() < 0.5 ? length : length / 3.0, random);
  }

 private:
  static constexpr double freedom = 8.0;  // heavier tails than most posteriors

  std::vector<double> away(const Eigen::VectorXd& from, double length, RandomStream& random) const {
    Eigen::VectorXd step(from.size());
    for (double& x : step) x = length * random.normal();
    const Eigen::VectorXd to = from + factor_.matrixL() * step;
    return {to.begin(), to.end()};
  }

  Eigen::VectorXd centre_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

/// A Metropolis-Hastings chain.
struct Chain {
  std::unique_ptr<Posterior> density;
  RandomStream random;
  State at;
  std::vector<State> kept;
  int accepted = 0;

  /// Draws the start from a distribution twice as wide as the posterior. @return false if no state
  /// of finite density was found
  bool start(const Proposals& proposals) {
    for (int tries = 0; tries < 1000 && !std::isfinite(at.log_density); ++tries) {
      at.z = proposals.independent_proposal(random, 2.0);
      density->evaluate(at);
    }
    return std::isfinite(at.log_density);
  }
  void step(const Proposals& proposals) {
    State next;
    const bool independent = random.uniform() < 0.5;
    const double chance = std::log(random.uniform());
    next.z =
        independent ? proposals.independent_proposal(random) : proposals.random_walk(at.z, random);
    density->evaluate(next);
    double gain = next.log_density - at.log_density;
    if (independent) gain += proposals.log_density(at.z) - proposals.log_density(next.z);
    if (!(chance < gain)) return;
    ++accepted;
    at = std::move(next);
  }
};

/// The chains under one variance function of the noise.
struct SampledFit {
  std::optional<NoPosterior> missing;
  int steps = 0;
  double acceptance = 0.0;
  std::vector<Chain> chains;
  std::vector<ChainCheck> checks;  // [moving]
};

/// One value of every kept draw, [chain][draw].
template <class Value>
ChainDraws draws_of(std::size_t chains, std::size_t length, const Value& value) {
  ChainDraws draws(chains);
  for (std::size_t c = 0; c < chains; ++c) {
    for (std::size_t i = 0; i < length; ++i) draws[c].push_back(value(c, i));
  }
  return draws;
}

bool settled(const ChainCheck& check, const PosteriorOptions& options) {
  return check.r_hat < options.largest_r_hat && check.bulk >= options.least_effective &&
         check.tail >= options.least_effective;
}

Proposals adapted(const std::vector<Chain>& chains) {
  const auto p = static_cast<Eigen::Index>(chains.front().at.z.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(p);
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(p, p);
  double count = 0.0;
  const Eigen::VectorXd origin = Eigen::Map<const Eigen::VectorXd>(chains[0].at.z.data(), p);
  for (const Chain& chain : chains) {
    for (const State& state : chain.kept) {
      const Eigen::VectorXd d = Eigen::Map<const Eigen::VectorXd>(state.z.data(), p) - origin;
      sum += d;
      squares += d * d.transpose();
      ++count;
    }
  }
  const Eigen::VectorXd mean = sum / count;
  return {origin + mean, squares / count - mean * mean.transpose()};
}

/// @param first_stream first stream of random numbers; every chain has its own
SampledFit sample_one(const FitResult& fitted, const PosteriorOptions& options,
                      std::size_t first_stream) {
  SampledFit sampled;
  for (std::size_t c = 0; c < options.chains; ++c) {
    sampled.chains.push_back(
        {std::make_unique<Posterior>(fitted),
         RandomStream(options.seed, RandomPurpose::posterior, first_stream + c),
         {},
         {}});
  }
  const auto [centre, covariance] = sampled.chains.front().density->normal_about_estimate();
  Proposals proposals(centre, covariance);
  std::vector<char> started(options.chains, 0);
  if (proposals.usable()) {
    parallel_over(options.chains, options.threads,
                  [&](std::size_t c) { started[c] = sampled.chains[c].start(proposals) ? 1 : 0; });
  }
  if (std::count(started.begin(), started.end(), 0) > 0) {
    sampled.missing = NoPosterior::no_start;
    return sampled;
  }
  const int shortest = static_cast<int>(options.length);
  // The first round is only a warm-up.
  bool warm = false;
  for (sampled.steps = shortest;;) {
    const int thin = sampled.steps / shortest;
    parallel_over(options.chains, options.threads, [&](std::size_t c) {
      Chain& chain = sampled.chains[c];
      chain.kept.clear();
      chain.accepted = 0;
      for (int k = 0; k < sampled.steps; ++k) {
        chain.step(proposals);
        if ((k + 1) % thin == 0) chain.kept.push_back(chain.at);
      }
    });
    const std::vector<std::size_t>& moving = sampled.chains.front().density->coordinates.moving();
    sampled.checks.assign(moving.size(), {});
    parallel_over(moving.size(), options.threads, [&](std::size_t k) {
      sampled.checks[k] =
          check_chains(draws_of(options.chains, options.length, [&](std::size_t c, std::size_t i) {
            return sampled.chains[c].kept[i].theta[moving[k]];
          }));
    });
    const bool done = std::all_of(sampled.checks.begin(), sampled.checks.end(),
                                  [&](const ChainCheck& c) { return settled(c, options); });
    if (warm && done) break;
    if (warm) sampled.steps *= 2;
    warm = true;
    if (sampled.steps > options.most_steps) {
      sampled.missing = NoPosterior::not_settled;
      break;
    }
    Proposals better = adapted(sampled.chains);
    if (better.usable()) proposals = std::move(better);
  }
  for (const Chain& chain : sampled.chains) {
    sampled.acceptance += chain.accepted / static_cast<double>(options.chains) / sampled.steps;
  }
  return sampled;
}

/// Shifts the parameters of a draw as the fit would change if its held constants were off by z, to
/// first order (positive parameters by a factor).
/// @param sign -1: back
void shift_by_constants(const FitResult& fitted, const std::vector<std::size_t>& moving,
                        const std::vector<double>& z, double sign, std::vector<double>& draw) {
  for (const std::size_t j : moving) {
    const ParameterSlot& slot = fitted.model.slots[j];
    const double estimate = fitted.theta[j];
    double by = 0.0;
    for (std::size_t k = 0; k < z.size(); ++k) by += sign * z[k] * fitted.constant_effects[k][j];
    double& value = draw[j];
    value = slot.lower >= 0.0 && estimate > 0.0 ? value * std::exp(by / estimate) : value + by;
    value = std::clamp(value, slot.lower, slot.upper);
  }
}

/// Includes the errors of constants that the fit holds. The draws used the stated constants; this
/// gives each draw its own constants.
void draw_constants(const FitResult& fitted, const std::vector<std::size_t>& moving,
                    RandomStream& random, std::vector<double>& draw) {
  const ImpactModel& model = fitted.model;
  std::vector<double> z(fitted.constant_effects.size());
  for (std::size_t k = 0; k < z.size(); ++k) {
    z[k] = random.normal();
    draw[model.first_constant() + k] = model.constants[k].moved(model.constants[k].stated, z[k]);
  }
  if (!z.empty()) shift_by_constants(fitted, moving, z, 1.0, draw);
}

/// Selects joint draws from the variance functions in proportion to their weights: the fractional
/// parts of multiples of the golden ratio cover [0, 1) evenly within every chain.
void keep_draws(const std::vector<FitAlternative>& alternatives,
                const std::vector<SampledFit>& sampled, const std::vector<std::size_t>& moving,
                const PosteriorOptions& options, PosteriorResult& result) {
  const std::vector<Observation>& points = alternatives.front().fitted().data.points;
  const bool scaled = sampled.front().chains.front().density->scaled;
  if (options.pointwise && result.left_out.possible()) result.pointwise.resize(points.size());
  for (std::size_t c = 0; c < options.chains; ++c) {
    RandomStream constants(options.seed, RandomPurpose::constants, c);
    RandomStream scales(options.seed, RandomPurpose::posterior, (std::uint64_t{1} << 32) + c);
    for (std::size_t i = 0; i < options.length; ++i) {
      double share = std::fmod((static_cast<double>(i) + 0.5) * std::numbers::phi, 1.0);
      std::size_t k = 0;
      while (k + 1 < sampled.size() && share >= alternatives[k].weight) {
        share -= alternatives[k++].weight;
      }
      const Posterior& density = *sampled[k].chains[c].density;
      const State& state = sampled[k].chains[c].kept[i];
      result.draws.push_back(state.theta);
      result.alternative.push_back(k);
      draw_constants(alternatives[k].fitted(), moving, constants, result.draws.back());
      const double scale = scaled ? density.draw_scale(state, scales) : 1.0;
      if (scaled) result.scale.push_back(scale);
      const std::vector<double> each = density.pointwise(state, scale);
      result.log_likelihood.push_back(std::accumulate(each.begin(), each.end(), density.shared()));
      result.log_prior.push_back(density.log_prior(state, scale));
      for (std::size_t n = 0; n < result.pointwise.size(); ++n) {
        result.pointwise[n].push_back(each[n]);
      }
    }
  }
}

void leave_one_out(int threads, PosteriorResult& result) {
  LeaveOneOut& out = result.left_out;
  out.points.resize(result.pointwise.size());
  std::vector<double> elpd(out.points.size()), in_sample(out.points.size());
  parallel_over(out.points.size(), threads, [&](std::size_t i) {
    const std::vector<double>& ln = result.pointwise[i];
    out.points[i] = leave_out_of_chains(ln, result.chains);
    elpd[i] = out.points[i].elpd;
    const double most = *std::max_element(ln.begin(), ln.end());
    double sum = 0.0;
    for (const double value : ln) sum += std::exp(value - most);
    in_sample[i] = most + std::log(sum / static_cast<double>(ln.size()));
  });
  out.elpd = std::accumulate(elpd.begin(), elpd.end(), 0.0);
  out.p_loo = std::accumulate(in_sample.begin(), in_sample.end(), 0.0) - out.elpd;
  for (const LeftOutPoint& point : out.points) out.mcse = std::hypot(out.mcse, point.mcse);
  out.se = std::sqrt(static_cast<double>(elpd.size())) * standard_deviation(elpd);
}

void fill_marginal(std::vector<double> draws, double level, PosteriorMarginal& marginal) {
  marginal.mean = mean(draws);
  marginal.sd = standard_deviation(draws);
  std::sort(draws.begin(), draws.end());
  marginal.interval = {};
  marginal.interval.lower = sorted_quantile(draws, 0.5 * (1.0 - level));
  marginal.interval.upper = sorted_quantile(draws, 0.5 * (1.0 + level));
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
    std::vector<double> values;
    for (const std::vector<double>& draw : result.capture_draws) {
      if (std::isfinite(draw[q])) values.push_back(draw[q]);
    }
    if (static_cast<double>(values.size()) < share_for_band * static_cast<double>(kept)) {
      marginal.interval = no_interval(NoInterval::never_rebounds);
    } else {
      fill_marginal(std::move(values), options.level, marginal);
    }
  }
}

}  // namespace

PosteriorResult sample_posterior(const std::vector<FitAlternative>& alternatives,
                                 const std::vector<CaptureEstimate>& capture,
                                 const PosteriorOptions& options) {
  const FitResult& fitted = alternatives.front().fitted();
  PosteriorResult result;
  result.parameters.resize(fitted.theta.size());
  for (PosteriorMarginal& marginal : result.parameters) {
    marginal.interval = no_interval(NoInterval::fixed);
  }
  const std::vector<std::size_t> moving = PosteriorCoordinates(fitted).moving();
  if (moving.empty()) return result;
  if (scale_unknown(fitted) && fitted.dof <= 0) {
    result.missing = NoPosterior::few_points;
    return result;
  }
  result.chains = options.chains;
  std::vector<SampledFit> sampled;
  for (const FitAlternative& alternative : alternatives) {
    sampled.push_back(sample_one(alternative.fitted(), options, sampled.size() * options.chains));
    const SampledFit& own = sampled.back();
    result.steps = std::max(result.steps, own.steps);
    result.acceptance += alternative.weight * own.acceptance;
    result.missing = own.missing;
    if (!result.missing) continue;
    for (std::size_t j = 0; j < own.checks.size(); ++j) {
      result.parameters[moving[j]].check = own.checks[j];
    }
    return result;
  }
  result.length = options.length;
  result.left_out.shared_errors = fitted.data.share_errors();
  result.left_out.unscaled = fitted.data.noise.student.has_value();
  keep_draws(alternatives, sampled, moving, options, result);
  if (!result.pointwise.empty()) leave_one_out(options.threads, result);
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const bool held = j >= fitted.model.first_constant() && !fitted.constant_effects.empty();
    if (!fitted.model.slots[j].moves() && !held) continue;
    const ChainDraws draws = draws_of(
        options.chains, options.length,
        [&](std::size_t c, std::size_t i) { return result.draws[c * options.length + i][j]; });
    std::vector<double> all;
    for (const auto& chain : draws) all.insert(all.end(), chain.begin(), chain.end());
    result.parameters[j].check = check_chains(draws);
    fill_marginal(std::move(all), options.level, result.parameters[j]);
  }
  fill_capture(fitted, capture, options, result);
  return result;
}

std::vector<double> shares_below(const FitResult& fitted, std::vector<double> theta, int steps,
                                 std::uint64_t seed, std::uint64_t stream) {
  if (scale_unknown(fitted) && fitted.dof <= 0) return {};
  Chain chain = {std::make_unique<Posterior>(fitted),
                 RandomStream(seed, RandomPurpose::posterior, stream),
                 {},
                 {}};
  RandomStream& random = chain.random;
  const PosteriorCoordinates& coordinates = chain.density->coordinates;
  const auto [centre, covariance] = chain.density->normal_about_estimate();
  const Proposals proposals(centre, covariance);
  if (!proposals.usable()) return {};
  const std::vector<double> own = theta;
  if (!fitted.constant_effects.empty()) {
    const auto z = constant_deviations(fitted.model, fitted.data, theta);
    shift_by_constants(fitted, coordinates.moving(), z, -1.0, theta);
  }
  State first;
  for (const std::size_t j : coordinates.moving()) {
    first.z.push_back(coordinates.to_z(j, theta[j]));
  }
  chain.density->evaluate(first);
  if (!std::isfinite(first.log_density)) return {};
  std::vector<double> below(own.size(), 0.0), equal(own.size(), 1.0);
  const auto before = static_cast<int>(random.below(static_cast<std::uint64_t>(steps) + 1));
  for (const int leg : {before, steps - before}) {
    chain.at = first;
    for (int k = 0; k < leg; ++k) {
      chain.step(proposals);
      std::vector<double> draw = chain.at.theta;
      draw_constants(fitted, coordinates.moving(), random, draw);
      for (std::size_t j = 0; j < own.size(); ++j) {
        below[j] += draw[j] < own[j] ? 1.0 : 0.0;
        equal[j] += draw[j] == own[j] ? 1.0 : 0.0;
      }
    }
  }
  for (std::size_t j = 0; j < own.size(); ++j) {
    below[j] = (below[j] + random.uniform() * equal[j]) / (steps + 1.0);
  }
  return below;
}

}  // namespace recoil
