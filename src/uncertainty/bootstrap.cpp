#include "uncertainty/bootstrap.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/kept_rows.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/reweighting.hpp"
#include "uncertainty/capture_interval.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/locate_failures.hpp"
#include "uncertainty/refit.hpp"
#include "uncertainty/replicate_errors.hpp"

namespace recoil {
namespace {

using State = ReplicateTable::State;

// Between two batches finished replicates can be put on disk; waiting for the slowest of a batch
// costs about one refit in so many. The first one shows how long they take.
constexpr std::size_t first_batch = 50;
constexpr double largest_batch = 500.0;
constexpr double batch_seconds = 5.0;

/// After one of so many that took so long.
std::size_t next_batch(std::size_t size, double seconds) {
  const double least = 4.0 * tbb::this_task_arena::max_concurrency();
  const double fitting = static_cast<double>(size) * batch_seconds / std::max(seconds, 1e-9);
  return static_cast<std::size_t>(std::clamp(fitting, least, std::max(least, largest_batch)));
}

// Tolerance of the impacts in refits over that of the fit. It moves the estimates of a replicate by
// about 1e-8 of themselves (measured on 60 points, f0 free), where they scatter by percents, and
// saves a third of the time.
constexpr double refit_tolerance_factor = 100.0;
// `replicates = "auto"` begins with the first number and ends with the last.
constexpr int fewest_automatic = 999;
constexpr int most_automatic = 19999;
// A bootstrap quicker than this is not worth a file.
constexpr auto worth_keeping = std::chrono::seconds(1);

/// What one thread needs to refit samples one after the other without building anything anew: the
/// problem refers to the sample beside it, and outlives its data as long as the points stay where
/// they are and only their restitution changes.
class Workspace {
 public:
  explicit Workspace(const ResamplingPlan& plan) : plan_(plan), model_(plan.fitted->model) {
    sample_ = plan.fitted->data;
    model_.solver.tolerance_factor *= refit_tolerance_factor;
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  /// The refit of replicate `index`, with the weights that belong to it where they depend on it.
  LeastSquaresResult refit(std::uint64_t seed, std::uint64_t index) {
    resample(plan_, seed, index, sample_);
    if (sample_.weights_depend_on_fit()) {
      ReweightedFit settled =
          reweighted_fit(model_, sample_, plan_.fitted->theta, refit_reweighting_options());
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

/// The settings of the noise, which are settled anew in every replicate.
std::string noise_key(const Observations& data) {
  const NoiseSpec& spec = data.spec;
  const NoiseModel& noise = data.noise;
  return fmt::format("{} {} {} {} {:a} {} {:a} {} {:a} {} {:a} {:a}|", data.sd_stated,
                     data.weights_depend_on_fit(),
                     spec.variance ? to_string(*spec.variance) : "auto", spec.student,
                     spec.student_dof, spec.velocity_errors, spec.velocity_relative_sd,
                     spec.diameter_errors, spec.diameter_relative_sd, to_string(noise.variance),
                     noise.scale, noise.event_spread);
}

/// Everything that decides a replicate's digits, hashed.
std::string bootstrap_key(const FitResult& fitted, const ResamplingPlan& plan,
                          const UncertaintyOptions& options) {
  std::string text = fmt::format("{}|{}|{}|{}|{}|{:a}|", options.keep_key, options.seed,
                                 to_string(plan.scheme), static_cast<int>(fitted.model.phase),
                                 to_string(fitted.model.solver.kind), fitted.noise_scale);
  if (fitted.model.adhesion != AdhesionLaw::ring) text += to_string(fitted.model.adhesion) + "|";
  if (fitted.model.separation != equilibrium_separation) {
    text += fmt::format("{}|", fitted.model.separation);
  }
  text += noise_key(fitted.data);
  if (!fitted.model.constants.empty()) text += fmt::format("{:a}|", fitted.data.constants_weight);
  for (const UncertainConstant& constant : fitted.model.constants) {
    text += fmt::format("{:a} {:a}|", constant.stated, constant.sd);
  }
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    const ParameterSlot& slot = fitted.model.slots[j];
    text += fmt::format("{} {:a} {:a} {:a} {} {}|", slot.label(), fitted.theta[j], slot.lower,
                        slot.upper, slot.free, slot.log_scale);
  }
  for (std::size_t i = 0; i < fitted.data.points.size(); ++i) {
    const Observation& point = fitted.data.points[i];
    text +=
        fmt::format("{} {} {:a} {:a} {:a} {:a} {} {:a} {:a} {:a}|", point.dataset, point.series,
                    point.diameter, point.velocity, point.restitution, point.weights.sd,
                    point.censored, fitted.prediction[i], fitted.residuals[i], fitted.leverage[i]);
    text += fmt::format("{} {} {} {} {:a} {:a} {:a} {:a}|", point.events, point.captured,
                        point.counted, point.rebound_measured, point.velocity_sd, point.diameter_sd,
                        point.weights.input_sd, point.weights.scatter);
  }
  return sha256_hex(text);
}

/// The larger Monte-Carlo error of an interval's ends over its width; 0 where nothing is random.
double relative_error(const Interval& interval) {
  if (!interval.available()) return 0.0;
  const double width = *interval.upper - *interval.lower;
  const double error =
      std::max(interval.lower_error.value_or(0.0), interval.upper_error.value_or(0.0));
  return width > 0.0 ? error / width : 0.0;
}

/// The largest Monte-Carlo error of a percentile interval's ends, or of a capture velocity's quoted
/// ones, over the width of its interval; 0 where nothing is random.
double monte_carlo_error(const FitResult& fitted, const BootstrapResult& replicates,
                         std::vector<CaptureEstimate> captures, double level) {
  double worst = 0.0;
  if (replicates.withheld()) return worst;
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    if (!fitted.model.slots[j].free) continue;
    const std::vector<double> values = finite_column(replicates.theta, j);
    worst = std::max(worst, relative_error(percentile_interval(values, level)));
  }
  add_resampled_captures(fitted, replicates, level, captures);
  for (const CaptureEstimate& capture : captures) {
    if (capture.found) worst = std::max(worst, relative_error(capture.interval));
  }
  return worst;
}

/// How many replicates bring a relative error down to what is wanted, the error falling like
/// 1 / sqrt(B); one less than a multiple of 1000, so that the quantiles fall on replicates.
int more_replicates(int so_far, double error, double wanted) {
  const double needed = so_far * std::pow(error / wanted, 2);
  const double rounded = 1000.0 * std::ceil((needed + 1.0) / 1000.0) - 1.0;
  return static_cast<int>(
      std::clamp(rounded, static_cast<double>(so_far) + 1000.0, 1.0 * most_automatic));
}

}  // namespace

Bootstrap::Bootstrap(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                     const UncertaintyOptions& options)
    : fitted_(fitted),
      capture_(capture),
      options_(options),
      plan_(plan_resampling(fitted, options.scheme)),
      reference_covariance_(reference_covariance(fitted, plan_)) {
  table_.slots = fitted.theta.size();
  table_.derived = capture.size();
  if (options.keep.empty() && options.parts.empty()) return;
  key_ = bootstrap_key(fitted, plan_, options);
  load_replicates(options.keep, key_, table_);
  for (const std::filesystem::path& part : options.parts) load_replicates(part, key_, table_);
}

std::string key_of_bootstrap(const FitResult& fitted, const UncertaintyOptions& options) {
  return bootstrap_key(fitted, plan_resampling(fitted, options.scheme), options);
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
  std::vector<CaptureQuery> queries;
  for (const CaptureEstimate& at : capture_) {
    queries.push_back({at.dataset, at.diameter, at.value});
  }
  capture_velocity_.resize(std::max(capture_velocity_.size(), count_));
  const auto run = [&](std::size_t i) {
    if (guard && stop_requested()) return;
    Workspace& workspace = *workspaces.local();
    const LeastSquaresResult found = workspace.refit(options_.seed, i);
    const bool usable = has_answer(found, fitted_);
    if (usable) {
      const auto covariance = replicate_covariance(found, workspace.data(), fitted_, plan_);
      std::vector<double> errors = roots_of_diagonal(covariance, table_.slots);
      for (const CaptureVelocity& v : capture_velocities(fitted_.model, found.theta, queries)) {
        capture_velocity_[i].push_back(v.found ? v.value : std::nan(""));
        errors.push_back(logarithmic_error(v, covariance));
      }
      std::copy(found.theta.begin(), found.theta.end(),
                table_.theta.begin() + static_cast<std::ptrdiff_t>(i * table_.slots));
      std::copy(errors.begin(), errors.end(),
                table_.std_error.begin() + static_cast<std::ptrdiff_t>(i * table_.errors()));
    }
    table_.state[i] = usable ? State::usable : State::failed;
  };
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < count_; ++i) {
    if (table_.state[i] == State::not_run && options_.shard.owns(i)) left.push_back(i);
  }
  const auto start = Clock::now();
  KeepingPace pace;
  bool changed = false;
  {
    Progress progress("bootstrap", left.size());
    std::size_t batch = first_batch;
    for (std::size_t first = 0; first < left.size();) {
      const std::size_t rest = left.size() - first;
      const std::size_t size = guard ? std::min(batch, rest) : rest;
      const auto begin = Clock::now();
      parallel_over(size, options_.threads, [&](std::size_t k) {
        run(left[first + k]);
        progress.advance();
      });
      first += size;
      batch = next_batch(size, std::chrono::duration<double>(Clock::now() - begin).count());
      if (!guard) continue;
      changed = true;
      if (stop_requested()) {
        keep();
        break;
      }
      if (!pace.is_due()) continue;
      changed = !pace.keep([this] { keep(); });
    }
  }
  if (guard && stop_requested()) {
    throw Interrupted(
        fmt::format("stopped: {} replicates are kept in {}; the same command goes on from there",
                    table_.finished(), options_.keep.string()));
  }
  if (options_.shard.of > 1) return;
  if (guard && changed && Clock::now() - start > worth_keeping) {
    pace.keep([this] { keep(); });
  }

  if (capture_.empty()) return;
  // Those that an earlier run has left.
  parallel_over(count_, options_.threads, [&](std::size_t i) {
    if (table_.state[i] != State::usable || !capture_velocity_[i].empty()) return;
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
  result.scheme = plan_.scheme;
  result.because = plan_.because;
  result.series = plan_.clusters.size();
  result.reference_error = roots_of_diagonal(reference_covariance_, table_.slots);
  for (std::size_t k = 0; k < table_.derived; ++k) {
    const CaptureVelocity v = capture_velocity(fitted_.model, fitted_.theta, capture_[k].dataset,
                                               capture_[k].diameter, capture_[k].value);
    result.capture_reference_error.push_back(logarithmic_error(v, reference_covariance_));
  }
  std::vector<std::uint64_t> failed;
  for (std::size_t i = 0; i < count_; ++i) {
    if (table_.state[i] == State::failed) {
      failed.push_back(i);
      continue;
    }
    const double* theta = table_.theta.data() + i * table_.slots;
    const double* error = table_.std_error.data() + i * table_.errors();
    result.theta.emplace_back(theta, theta + table_.slots);
    result.std_error.emplace_back(error, error + table_.slots);
    result.capture_velocity.push_back(capture_velocity_[i]);
    result.capture_error.emplace_back(error + table_.slots, error + table_.errors());
  }
  result.failed = static_cast<int>(failed.size());
  result.failures = locate_failures(plan_, options_.seed, result.replicates, std::move(failed));
  return result;
}

BootstrapResult bootstrap(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                          const UncertaintyOptions& options) {
  Bootstrap run(fitted, capture, options);
  for (int count = options.replicates_auto ? fewest_automatic : options.replicates;;) {
    run.extend(count);
    BootstrapResult result = run.result();
    const double error = monte_carlo_error(fitted, result, capture, options.level);
    if (error > 0.0) result.relative_error = error;
    if (!options.replicates_auto || error <= options.wanted_error || count >= most_automatic) {
      return result;
    }
    count = more_replicates(count, error, options.wanted_error);
  }
}

std::size_t replicates_at_most(const UncertaintyOptions& options) {
  return static_cast<std::size_t>(options.replicates_auto ? most_automatic : options.replicates);
}

ReplicateTable shard_of_bootstrap(const FitResult& fitted,
                                  const std::vector<CaptureEstimate>& capture,
                                  const UncertaintyOptions& options) {
  Bootstrap run(fitted, capture, options);
  run.extend(static_cast<int>(replicates_at_most(options)));
  return run.table();
}

std::vector<std::vector<double>> jackknife(const ResamplingPlan& plan, int threads) {
  std::vector<std::vector<double>> estimates(plan.units());
  parallel_over(estimates.size(), threads, [&](std::size_t unit) {
    std::vector<bool> left_out(plan.fitted->data.points.size(), false);
    if (plan.scheme == Scheme::cluster) {
      for (const std::size_t i : plan.clusters[unit]) left_out[i] = true;
    } else {
      left_out[unit] = true;
    }
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < left_out.size(); ++i) {
      if (!left_out[i]) kept.push_back(i);
    }
    const Observations rest = plan.fitted->data.subset(kept);
    const LeastSquaresResult found = refit(plan.fitted->model, rest, plan.fitted->theta);
    if (has_answer(found, *plan.fitted)) estimates[unit] = found.theta;
  });
  return estimates;
}

}  // namespace recoil
