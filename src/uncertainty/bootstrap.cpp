#include "uncertainty/bootstrap.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/reweighting.hpp"
#include "uncertainty/capture_interval.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/refit.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {

namespace {

constexpr std::size_t most_suspects = 3;
constexpr int most_compared = 999;      // successful replicates in the comparison
constexpr double clearly_unlike = 3.0;  // standard errors of a mean

/// Sums of a point's perturbation over some replicates.
struct Moments {
  double count = 0.0, sum = 0.0, square = 0.0;

  void add(double value) {
    count += 1.0;
    sum += value;
    square += value * value;
  }
  double mean() const { return count > 0.0 ? sum / count : 0.0; }
  double sd() const {
    return count > 1.0 ? std::sqrt(std::max(0.0, (square - sum * sum / count) / (count - 1.0)))
                       : 0.0;
  }
};

}  // namespace

FailedReplicates locate_failures(const ResamplingPlan& plan, std::uint64_t seed, int replicates,
                                 std::vector<std::uint64_t> index) {
  FailedReplicates result;
  result.index = std::move(index);
  if (result.index.empty()) return result;
  const std::size_t n = plan.fitted->data.points.size();
  std::vector<Moments> failed(n);
  std::vector<Moments> usual(n);
  const auto add = [&](std::uint64_t replicate, std::vector<Moments>& to) {
    const std::vector<double> values = perturbation(plan, seed, replicate);
    for (std::size_t i = 0; i < n; ++i) to[i].add(values[i]);
  };
  for (std::size_t k = 0; k < result.index.size() && k < most_compared; ++k) {
    add(result.index[k], failed);
  }
  for (int r = 0; r < std::min(replicates, most_compared); ++r) {
    const auto own = static_cast<std::uint64_t>(r);
    if (!std::binary_search(result.index.begin(), result.index.end(), own)) add(own, usual);
  }
  std::vector<std::pair<double, FailedReplicates::Suspect>> ranked;
  for (std::size_t i = 0; i < n; ++i) {
    const double sd = usual[i].sd();
    if (!(sd > 0.0)) continue;
    const double distance =
        std::abs(failed[i].mean() - usual[i].mean()) * std::sqrt(failed[i].count) / sd;
    ranked.push_back(
        {distance, {i, failed[i].mean(), usual[i].mean(), distance >= clearly_unlike}});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t k = 0; k < std::min(ranked.size(), most_suspects); ++k) {
    result.suspects.push_back(ranked[k].second);
  }
  // Repeats the first failed refit for the message of the minimiser.
  Observations sample = plan.fitted->data;
  resample(plan, seed, result.index.front(), sample);
  const LeastSquaresResult again = refit(*plan.fitted, sample);
  result.undetermined = again.ended();
  if (!again.ended()) result.message = again.message;
  return result;
}

namespace {

// Tolerance of the impact solver in refits, relative to that of the fit. It changes the estimates
// of a replicate by a relative 1e-8 (measured on 60 points, f0 free), while they scatter by
// percents, and saves a third of the time.
constexpr double refit_tolerance_factor = 100.0;
// First and largest number of replicates of `replicates = "auto"`.
constexpr int fewest_automatic = 999;
constexpr int most_automatic = 19999;

/// The first number of replicates: at least as many as an interval at this level needs.
int first_count(const UncertaintyOptions& options) {
  const int asked = options.replicates_auto ? fewest_automatic : options.replicates;
  const double needed = static_cast<double>(fewest_replicates(options.level));
  return asked == 0 ? 0 : std::max(asked, static_cast<int>(std::min(needed, 1.0 * most_automatic)));
}

/// The memory in which one thread refits samples. The problem refers to `sample_` and is reused as
/// long as only the restitution of the points changes.
class Workspace {
 public:
  explicit Workspace(const ResamplingPlan& plan) : plan_(plan), model_(plan.fitted->model) {
    sample_ = plan.fitted->data;
    model_.solver.tolerance_factor *= refit_tolerance_factor;
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  /// The refit of replicate `index`, with its own weights if weights depend on the fit.
  LeastSquaresResult refit(std::uint64_t seed, std::uint64_t index) {
    resample(plan_, seed, index, sample_);
    const FitResult& fitted = *plan_.fitted;
    if (sample_.weights_depend_on_fit()) {
      ReweightedFit settled = reweighted_fit(model_, sample_, fitted.weights.noise, fitted.theta,
                                             refit_reweighting_options());
      weights_ = std::move(settled.weights);
      return std::move(settled.run);
    }
    const bool same_design = plan_.scheme != Scheme::cases && plan_.scheme != Scheme::cluster;
    if (!problem_ || !same_design) {
      weights_ = first_weights(sample_, fitted.weights.noise);
      problem_ = impact_problem(model_, sample_, weights_);
    }
    return minimise(*problem_, fitted.theta, minimiser_);
  }

  /// The data of the last refit, and their weights.
  const Observations& data() const { return sample_; }
  const Weights& weights() const { return weights_; }

 private:
  const ResamplingPlan& plan_;
  ImpactModel model_;
  const LeastSquaresOptions minimiser_ = refit_options();
  Observations sample_;
  Weights weights_;
  std::optional<LeastSquaresProblem> problem_;
};

/// Data that all replicates share, besides the fit.
struct Run {
  explicit Run(const ResamplingPlan& plan)
      : workspaces([&plan] { return std::make_unique<Workspace>(plan); }) {}

  tbb::enumerable_thread_specific<std::unique_ptr<Workspace>> workspaces;
  std::vector<CaptureQuery> queries;  ///< the capture velocities of the fit
};

/// The larger Monte-Carlo error of the two ends over the width of the interval; 0 if nothing is
/// random.
double relative_error(const Interval& interval) {
  if (!interval.available()) return 0.0;
  const double width = *interval.upper - *interval.lower;
  const double error =
      std::max(interval.lower_error.value_or(0.0), interval.upper_error.value_or(0.0));
  return width > 0.0 ? error / width : 0.0;
}

/// The largest Monte-Carlo error of an end over the width of its interval, among the percentile
/// intervals of the parameters and the quoted intervals of the capture velocities; 0 if nothing is
/// random.
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

/// The number of replicates B at which the relative error, proportional to 1 / sqrt(B), reaches
/// `wanted`; one less than a multiple of 1000, so that the quantiles are replicates.
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
  const auto run = std::make_shared<Run>(plan_);
  for (const CaptureEstimate& at : capture_) {
    run->queries.push_back({at.dataset, at.diameter, at.value});
  }
  replicate_ = [this, run](std::size_t i) {
    Workspace& workspace = *run->workspaces.local();
    const LeastSquaresResult found = workspace.refit(options_.seed, i);
    if (!has_answer(found, fitted_)) return std::vector<double>{};
    const auto covariance =
        replicate_covariance(found, workspace.data(), workspace.weights(), fitted_, plan_);
    std::vector<double> numbers = found.theta;
    const std::vector<double> errors = roots_of_diagonal(covariance, found.theta.size());
    numbers.insert(numbers.end(), errors.begin(), errors.end());
    if (run->queries.empty()) return numbers;
    for (const CaptureVelocity& v : capture_velocities(fitted_.model, found.theta, run->queries)) {
      numbers.push_back(v.found ? v.value : std::nan(""));
      numbers.push_back(logarithmic_error(v, covariance));
    }
    return numbers;
  };
}

void Bootstrap::extend(int count) {
  const std::size_t first = replicates_.size();
  count_ = static_cast<std::size_t>(count);
  replicates_.resize(std::max(first, count_));
  const std::size_t length = 2 * (fitted_.theta.size() + capture_.size());
  const auto read = [length](const Json& row) {
    std::vector<double> numbers = row_numbers(row);
    if (!numbers.empty() && numbers.size() != length) throw std::length_error("another bootstrap");
    return numbers;
  };
  Progress progress("bootstrap", replicates_.size() - first);
  parallel_over(replicates_.size() - first, options_.threads, [&](std::size_t k) {
    const std::size_t i = first + k;
    replicates_[i] = kept_or_made(
        options_.kept.get(), i, [&] { return replicate_(i); }, row_json, read);
    progress.advance();
  });
}

Json Bootstrap::row(std::size_t index) const { return row_json(replicate_(index)); }

BootstrapResult Bootstrap::result() const {
  BootstrapResult result;
  result.replicates = static_cast<int>(count_);
  result.seed = options_.seed;
  result.scheme = plan_.scheme;
  result.because = plan_.because;
  result.series = plan_.clusters.size();
  const std::size_t slots = fitted_.theta.size();
  result.reference_error = roots_of_diagonal(reference_covariance_, slots);
  for (const CaptureEstimate& at : capture_) {
    const CaptureVelocity v =
        capture_velocity(fitted_.model, fitted_.theta, at.dataset, at.diameter, at.value);
    result.capture_reference_error.push_back(logarithmic_error(v, reference_covariance_));
  }
  std::vector<std::uint64_t> failed;
  for (std::size_t i = 0; i < count_; ++i) {
    const std::vector<double>& numbers = replicates_[i];
    if (numbers.empty()) {
      failed.push_back(i);
      continue;
    }
    const auto errors = numbers.begin() + static_cast<std::ptrdiff_t>(slots);
    const auto captures = errors + static_cast<std::ptrdiff_t>(slots);
    result.theta.emplace_back(numbers.begin(), errors);
    result.std_error.emplace_back(errors, captures);
    result.capture_velocity.emplace_back();
    result.capture_error.emplace_back();
    for (auto at = captures; at != numbers.end(); at += 2) {
      result.capture_velocity.back().push_back(at[0]);
      result.capture_error.back().push_back(at[1]);
    }
  }
  result.failed = static_cast<int>(failed.size());
  result.failures = locate_failures(plan_, options_.seed, result.replicates, std::move(failed));
  return result;
}

std::string digits_of(const FitResult& fitted) {
  std::string digits = fmt::format("{:a}", fitted.noise_scale);
  for (const double value : fitted.theta) digits += fmt::format("|{:a}", value);
  for (std::size_t i = 0; i < fitted.data.points.size(); ++i) {
    digits += fmt::format("|{:a} {:a} {:a}", fitted.prediction[i], fitted.residuals[i],
                          fitted.leverage[i]);
  }
  return digits;
}

BootstrapResult bootstrap(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                          const UncertaintyOptions& options) {
  Bootstrap run(fitted, capture, options);
  const bool known = fitted.weights.noise.known;  // without noise nothing can be drawn
  for (int count = known ? first_count(options) : 0;;) {
    run.extend(count);
    BootstrapResult result = run.result();
    const double error = monte_carlo_error(fitted, result, capture, options.level);
    if (error > 0.0) result.relative_error = error;
    if (!known || !options.replicates_auto || error <= options.wanted_error ||
        count >= most_automatic) {
      return result;
    }
    count = more_replicates(count, error, options.wanted_error);
  }
}

std::size_t replicates_at_most(const UncertaintyOptions& options) {
  return static_cast<std::size_t>(options.replicates_auto ? most_automatic : first_count(options));
}

Pieces bootstrap_pieces(const FitResult& fitted, const std::vector<CaptureEstimate>& capture,
                        const UncertaintyOptions& options) {
  const auto run = std::make_shared<Bootstrap>(fitted, capture, options);
  return {"bootstrap", replicates_at_most(options), options.threads,
          [run](std::size_t i) { return run->row(i); }};
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
    const LeastSquaresResult found = refit(*plan.fitted, rest);
    if (has_answer(found, *plan.fitted)) estimates[unit] = found.theta;
  });
  return estimates;
}

}  // namespace recoil
