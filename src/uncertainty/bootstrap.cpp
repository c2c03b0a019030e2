#include "uncertainty/bootstrap.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/noise.hpp"

namespace recoil {
namespace {

using State = ReplicateTable::State;

// Between two batches finished replicates can be put on disk; waiting for the slowest of a batch
// costs about one refit in so many.
constexpr std::size_t batch = 500;
constexpr auto between_saves = std::chrono::seconds(10);
// Tolerance of the impacts in refits over that of the fit. It moves the estimates of a replicate by
// about 1e-8 of themselves (measured on 60 points, f0 free), where they scatter by percents, and
// saves a third of the time.
constexpr double refit_loosened = 100.0;
// The two-point iteration costs several refits, and only its spread is wanted, which this many give
// to 2 %.
constexpr int most_two_point = 999;
// A bootstrap quicker than this is not worth a file.
constexpr auto worth_keeping = std::chrono::seconds(1);

/// Weights of a replicate need no more digits than its own scatter has.
SettleOptions settle_options() {
  SettleOptions options;
  options.minimiser = refit_options();
  options.parameters = 0.02;
  options.scale = 0.01;
  return options;
}

/// Do the points scatter unequally in a way that the covariance does not know of?
bool uses_sandwich(Scheme scheme) {
  return scheme == Scheme::wild || scheme == Scheme::cases || scheme == Scheme::cluster;
}

/// Standard errors of a fit to data like `data`, made in the same way for the fit and for its
/// replicates. Zero where there is none.
std::vector<double> standard_errors(const LeastSquaresResult& run, const Observations& data,
                                    const FitResult& fitted, const ResamplingPlan& plan) {
  const std::size_t p = run.theta.size();
  if (run.covariance.empty()) return std::vector<double>(p, 0.0);
  if (uses_sandwich(plan.scheme)) {
    return sandwich_errors(run.residuals, run.jacobian,
                           scaled_covariance(data, run.covariance, 1.0));
  }
  // Where the noise is estimated, it was so again with the parameters of this run.
  const double scale = data.sd_stated ? fitted.noise_scale : 1.0;
  const std::vector<double> covariance = scaled_covariance(data, run.covariance, scale);
  std::vector<double> errors(p, 0.0);
  for (std::size_t j = 0; j < p; ++j) errors[j] = std::sqrt(covariance[j * p + j]);
  return errors;
}

/// The standard errors of the fit itself, as those of its replicates are made.
std::vector<double> reference_errors(const FitResult& fitted, const ResamplingPlan& plan) {
  if (!uses_sandwich(plan.scheme) || fitted.covariance.empty()) return fitted.std_error;
  const LeastSquaresProblem problem = impact_problem(fitted.model, *plan.data);
  const std::size_t p = fitted.theta.size();
  LeastSquaresResult at_fit;
  at_fit.theta = fitted.theta;
  at_fit.residuals.resize(problem.residual_count);
  at_fit.jacobian.resize(problem.residual_count * p);
  if (!problem.evaluate(at_fit.theta, at_fit.residuals, at_fit.jacobian)) return fitted.std_error;
  at_fit.covariance = fitted.covariance;
  const double scaled = scaled_covariance(*plan.data, {1.0}, fitted.noise_scale).front();
  for (double& entry : at_fit.covariance) entry /= scaled;
  return standard_errors(at_fit, *plan.data, fitted, plan);
}

/// What one thread needs to refit samples one after the other without building anything anew: the
/// problem refers to the sample beside it, and outlives its data as long as the points stay where
/// they are and only their restitution changes.
class Workspace {
 public:
  explicit Workspace(const ResamplingPlan& plan) : plan_(plan), model_(plan.fitted->model) {
    sample_ = *plan.data;
    sample_.warnings.clear();
    model_.loosened *= refit_loosened;
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  /// The refit of replicate `index`, with the weights that belong to it where they depend on it.
  LeastSquaresResult refit(std::uint64_t seed, std::uint64_t index) {
    resample(plan_, seed, index, sample_);
    if (sample_.weights_depend_on_fit()) {
      Settled settled = settle(model_, sample_, plan_.fitted->theta, settle_options());
      weighted_ = std::move(settled.data);
      return std::move(settled.run);
    }
    const bool same_design = plan_.scheme != Scheme::cases && plan_.scheme != Scheme::cluster;
    if (!problem_ || !same_design) problem_ = impact_problem(model_, sample_);
    return minimise(*problem_, plan_.fitted->theta, minimiser_);
  }

  /// What the last refit worked on.
  const Observations& data() const { return sample_.weights_depend_on_fit() ? weighted_ : sample_; }

 private:
  const ResamplingPlan& plan_;
  ImpactModel model_;
  const LeastSquaresOptions minimiser_ = refit_options();
  Observations sample_;
  Observations weighted_;
  std::optional<LeastSquaresProblem> problem_;
};

/// Everything that decides a replicate's digits, hashed.
std::string bootstrap_key(const FitResult& fitted, const Observations& data,
                          const ResamplingPlan& plan, const UncertaintyOptions& options) {
  std::string text = fmt::format("{}|{}|{}|{}|{}|{:a}|", options.keep_key, options.seed,
                                 to_string(plan.scheme), static_cast<int>(fitted.model.phase),
                                 static_cast<int>(fitted.model.solver), fitted.noise_scale);
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    text += fmt::format("{} {:a} {:a} {:a} {} {}|", slot.label(), fitted.theta[j], slot.lower,
                        slot.upper, slot.free, slot.log_scale);
  }
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    text += fmt::format("{} {} {:a} {:a} {:a} {:a} {} {:a} {:a} {:a}|", point.dataset, point.series,
                        point.diameter, point.velocity, point.restitution, point.sd, point.censored,
                        fitted.prediction[i], fitted.residuals[i], fitted.leverage[i]);
  }
  return sha256_hex(text);
}

}  // namespace

LeastSquaresOptions refit_options() {
  LeastSquaresOptions options;
  options.function_tolerance = 1e-9;
  options.gradient_tolerance = 1e-10;
  options.parameter_tolerance = 1e-8;
  options.max_iterations = 100;
  return options;
}

LeastSquaresResult refit(const ImpactModel& model, const Observations& sample,
                         std::span<const double> start) {
  if (sample.weights_depend_on_fit()) return settle(model, sample, start, settle_options()).run;
  return minimise(impact_problem(model, sample), start, refit_options());
}

bool has_answer(const LeastSquaresResult& refit, const FitResult& fitted) {
  return refit.converged && (!refit.covariance.empty() || fitted.covariance.empty());
}

Bootstrap::Bootstrap(const FitResult& fitted, const Observations& data,
                     const std::vector<CaptureEstimate>& capture, const UncertaintyOptions& options)
    : fitted_(fitted),
      capture_(capture),
      options_(options),
      plan_(plan_resampling(fitted, data, options.scheme)),
      reference_error_(reference_errors(fitted, plan_)) {
  table_.slots = fitted.theta.size();
  if (options.keep.empty()) return;
  key_ = bootstrap_key(fitted, data, plan_, options);
  table_ = load_replicates(options.keep, key_, fitted.theta.size());
}

void Bootstrap::keep() const { save_replicates(options_.keep, key_, table_); }

void Bootstrap::extend(int count) {
  using Clock = std::chrono::steady_clock;
  count_ = static_cast<std::size_t>(count);
  table_.grow(count_);
  std::optional<InterruptGuard> guard;
  if (!options_.keep.empty()) guard.emplace();
  tbb::enumerable_thread_specific<std::unique_ptr<Workspace>> workspaces(
      [&] { return std::make_unique<Workspace>(plan_); });
  const auto run = [&](std::size_t i) {
    if (table_.state[i] != State::not_run || (guard && stop_requested())) return;
    Workspace& workspace = *workspaces.local();
    const LeastSquaresResult found = workspace.refit(options_.seed, i);
    const bool usable = has_answer(found, fitted_);
    if (usable) {
      const auto at = static_cast<std::ptrdiff_t>(i * table_.slots);
      const std::vector<double> errors = standard_errors(found, workspace.data(), fitted_, plan_);
      std::copy(found.theta.begin(), found.theta.end(), table_.theta.begin() + at);
      std::copy(errors.begin(), errors.end(), table_.std_error.begin() + at);
    }
    table_.state[i] = usable ? State::usable : State::failed;
  };
  const auto start = Clock::now();
  auto saved = start;
  bool changed = false;
  {
    Progress progress("bootstrap", count_);
    for (std::size_t first = 0; first < count_; first += batch) {
      const std::size_t size = std::min(batch, count_ - first);
      parallel_over(size, options_.threads, [&](std::size_t k) {
        run(first + k);
        progress.advance();
      });
      if (!guard) continue;
      changed = true;
      if (stop_requested() || Clock::now() - saved > between_saves) {
        keep();
        saved = Clock::now();
        changed = false;
      }
      if (stop_requested()) break;
    }
  }
  if (guard && stop_requested()) {
    throw Interrupted(
        fmt::format("stopped: {} replicates are kept in {}; the same command goes on from there",
                    table_.finished(), options_.keep.string()));
  }
  if (guard && changed && Clock::now() - start > worth_keeping) keep();

  if (!options_.capture) return;
  std::vector<CaptureQuery> queries;
  for (const CaptureEstimate& at : capture_) {
    queries.push_back({at.dataset, at.diameter, at.value});
  }
  const std::size_t known = capture_velocity_.size();
  capture_velocity_.resize(std::max(known, count_));
  parallel_over(capture_velocity_.size() - known, options_.threads, [&](std::size_t k) {
    const std::size_t i = known + k;
    if (table_.state[i] != State::usable) return;
    const std::span<const double> theta(table_.theta.data() + i * table_.slots, table_.slots);
    for (const CaptureVelocity& v : capture_velocities(fitted_.model, theta, queries)) {
      capture_velocity_[i].push_back(v.found ? v.value : std::nan(""));
    }
  });
}

BootstrapResult Bootstrap::result() const {
  BootstrapResult result;
  result.replicates = static_cast<int>(count_);
  result.seed = options_.seed;
  result.scheme = to_string(plan_.scheme);
  result.scheme_why = plan_.why;
  result.reference_error = reference_error_;
  std::vector<std::uint64_t> failed;
  for (std::size_t i = 0; i < count_; ++i) {
    if (table_.state[i] == State::failed) {
      failed.push_back(i);
      continue;
    }
    const auto from = static_cast<std::ptrdiff_t>(i * table_.slots);
    const auto to = from + static_cast<std::ptrdiff_t>(table_.slots);
    result.theta.emplace_back(table_.theta.begin() + from, table_.theta.begin() + to);
    result.std_error.emplace_back(table_.std_error.begin() + from, table_.std_error.begin() + to);
    if (options_.capture) result.capture_velocity.push_back(capture_velocity_[i]);
  }
  result.failed = static_cast<int>(failed.size());
  result.failures = locate_failures(plan_, options_.seed, result.replicates, std::move(failed));
  return result;
}

void bootstrap_two_point(const ResamplingPlan& plan, const std::vector<TwoPointResult>& two_point,
                         const UncertaintyOptions& options, BootstrapResult& result) {
  const std::size_t count = static_cast<std::size_t>(std::min(result.replicates, most_two_point));
  result.two_point_replicates = two_point.empty() ? 0 : static_cast<int>(count);
  result.two_point_theta.resize(two_point.size());
  result.two_point_failed.assign(two_point.size(), 0);
  if (two_point.empty()) return;
  std::vector<std::vector<std::vector<double>>> found(
      count);  // [replicates][datasets], empty: none
  tbb::enumerable_thread_specific<Observations> samples;
  Progress progress("two points", count);
  parallel_over(count, options.threads, [&](std::size_t i) {
    Observations& sample = samples.local();
    resample(plan, options.seed, i, sample);
    for (std::size_t d = 0; d < two_point.size(); ++d) {
      TwoPointResult run = recoil::two_point(plan.fitted->model, sample, d, two_point[d].diameter);
      found[i].push_back(run.status == TwoPointStatus::converged ? std::move(run.theta)
                                                                 : std::vector<double>{});
    }
    progress.advance();
  });
  for (auto& replicate : found) {
    for (std::size_t d = 0; d < two_point.size(); ++d) {
      if (replicate[d].empty()) {
        ++result.two_point_failed[d];
      } else {
        result.two_point_theta[d].push_back(std::move(replicate[d]));
      }
    }
  }
}

BootstrapResult bootstrap(const FitResult& fitted, const Observations& data,
                          const std::vector<CaptureEstimate>& capture,
                          const std::vector<TwoPointResult>& two_point,
                          const UncertaintyOptions& options) {
  Bootstrap run(fitted, data, capture, options);
  run.extend(options.replicates);
  BootstrapResult result = run.result();
  bootstrap_two_point(run.plan(), two_point, options, result);
  return result;
}

std::vector<std::vector<double>> jackknife(const ResamplingPlan& plan, int threads) {
  std::vector<std::vector<double>> estimates(plan.units());
  parallel_over(estimates.size(), threads, [&](std::size_t unit) {
    Observations rest = *plan.data;
    if (plan.scheme == Scheme::cluster) {
      const std::vector<std::size_t>& out = plan.clusters[unit];
      for (auto i = out.rbegin(); i != out.rend(); ++i) {
        rest.points.erase(rest.points.begin() + static_cast<std::ptrdiff_t>(*i));
      }
    } else {
      rest.points.erase(rest.points.begin() + static_cast<std::ptrdiff_t>(unit));
    }
    const LeastSquaresResult found = refit(plan.fitted->model, rest, plan.fitted->theta);
    if (has_answer(found, *plan.fitted)) estimates[unit] = found.theta;
  });
  return estimates;
}

}  // namespace recoil
