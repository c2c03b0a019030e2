#include "estimate/law_average.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "core/parallel.hpp"
#include "estimate/predictor.hpp"
#include "estimate/reweighting.hpp"

namespace recoil {
namespace {

constexpr std::array sizes_of_error = {0.015, 0.03, 0.06, 0.12, 0.24};
constexpr double exact_prior = 0.1;
constexpr double short_length = 0.8, long_length = 1.6;
constexpr std::size_t most_sizes = 12;  // sizes that may have an error each
constexpr int screening_steps = 40;     // of a screening; then its criterion is an upper limit
constexpr double negligible = 0.01;     // weight below which an assumption is left out

std::size_t count_sizes(const Observations& data) {
  std::set<std::pair<std::size_t, double>> sizes;
  for (const Observation& point : data.points) sizes.insert({point.dataset, point.diameter});
  return sizes.size();
}

/// The criterion of a fit under an assumption, and where it is.
struct Screened {
  LawErrorPrior prior;
  double prior_weight = 1.0;
  double criterion = INFINITY;
  std::vector<double> theta;
};

/// The fits under one of `kernels` equally likely kernels, for all sizes of the error.
std::vector<Screened> screen_kernel(const FitResult& exact, LawErrorPrior prior, double kernels,
                                    const Observations& data) {
  std::vector<Screened> found;
  Noise noise = exact.weights.noise;
  noise.constants_weight = 1.0;
  noise.candidates.clear();
  ReweightingOptions options;
  options.minimiser.strategies = {Strategy::gauss_newton, Strategy::box_descent};
  options.minimiser.finish = false;
  options.minimiser.close_enough = 0.01;
  options.minimiser.max_iterations = screening_steps;
  options.parameters = 0.02;
  options.scale = 0.01;
  std::vector<double> theta = exact.theta;
  for (const LawErrorSize& of : sizes_of_law_error()) {
    if (of.size == 0.0) continue;
    const double before = std::exchange(prior.size, of.size);
    const ImpactModel model = with_law_error(exact.model, prior, data.conditions());
    // g stays where it was.
    for (std::size_t j = exact.theta.size(); j < theta.size(); ++j) theta[j] *= before / prior.size;
    theta.resize(model.slots.size(), 0.0);
    ReweightedFit fit = reweighted_fit(model, data, noise, theta, options);
    if (!fit.run.ended() && fit.run.end != DescentEnd::limit) continue;
    theta = fit.run.theta;
    noise = fit.weights.noise;
    found.push_back({prior, of.prior / kernels,
                     restricted_criterion(model, data, fit.run, fit.weights), theta});
  }
  return found;
}

FitResult fit_with(const FitResult& exact, const Screened& at, Observations data,
                   const FitOptions& given) {
  FitOptions options = given;
  options.several_starts = false;
  options.start = at.theta;
  options.minimiser.strategies = {Strategy::gauss_newton, Strategy::box_descent};
  options.noise = exact.weights.noise;
  options.noise->candidates.clear();
  return fit(with_law_error(exact.model, at.prior, exact.data.conditions()), std::move(data),
             options);
}

FitResult averaged_here(const ImpactModel& model, Observations&& data, const FitOptions& options) {
  FitResult exact = fit(model, data, options);
  if (!exact.usable || !exact.weights.noise.known || exact.covariance.empty()) return exact;
  // The variance function is the one that exact laws select.
  Observations same_noise = exact.data;
  if (!data.noise.sd_stated) same_noise.noise.spec.variance = exact.weights.noise.variance;
  std::vector<LawErrorPrior> kernels;
  const std::size_t sizes = count_sizes(data);
  for (const double length : {short_length, long_length}) {
    kernels.push_back({.length = length});
    if (sizes > 1 && sizes <= most_sizes) kernels.push_back({.length = length, .by_size = true});
  }
  kernels.push_back({.length = long_length, .at_capture = true});
  std::vector<std::vector<Screened>> screened(kernels.size());
  parallel_over(kernels.size(), options.threads, [&](std::size_t k) {
    screened[k] = screen_kernel(exact, kernels[k], static_cast<double>(kernels.size()), same_noise);
  });
  std::vector<Screened> all = {{{}, exact_prior, exact.criterion, exact.theta}};
  for (std::vector<Screened>& of_kernel : screened) {
    std::move(of_kernel.begin(), of_kernel.end(), std::back_inserter(all));
  }
  const auto by_criterion = [](const Screened& a, const Screened& b) {
    return a.criterion < b.criterion;
  };
  const double least = std::min_element(all.begin(), all.end(), by_criterion)->criterion;
  std::vector<LawAlternative> laws;
  double sum = 0.0;
  for (const Screened& one : all) {
    laws.push_back({one.prior, one.prior_weight * std::exp(-0.5 * (one.criterion - least)), {}});
    sum += laws.back().weight;
  }
  for (LawAlternative& one : laws) one.weight /= sum;
  const auto by_weight = [](const LawAlternative& a, const LawAlternative& b) {
    return a.weight < b.weight;
  };
  const auto best = static_cast<std::size_t>(std::max_element(laws.begin(), laws.end(), by_weight) -
                                             laws.begin());
  parallel_over(laws.size(), options.threads, [&](std::size_t k) {
    if (k == 0 || k == best || laws[k].weight < negligible) return;
    FitResult other = fit_with(exact, all[k], same_noise, options);
    if (other.usable) laws[k].fitted = std::make_shared<const FitResult>(std::move(other));
  });
  if (best == 0) {
    exact.laws = std::move(laws);
    return exact;
  }
  FitResult result = fit_with(exact, all[best], std::move(data), options);
  if (!result.usable) {
    exact.laws = std::move(laws);
    return exact;
  }
  result.starts = exact.starts;
  result.searched_points = exact.searched_points;
  result.handovers += exact.handovers;
  laws[0].fitted = std::make_shared<const FitResult>(std::move(exact));
  result.laws = std::move(laws);
  return result;
}

/// The size s below which the posterior has the probability p. Each size stands for all within a
/// factor of sqrt(2), the step of `sizes_of_error`, with equal density in ln s.
/// @param weights of exact laws, then of every size
double quantile_of(const std::vector<double>& weights, double p) {
  double below = weights.front();
  if (p <= below) return 0.0;
  for (std::size_t k = 0; k < sizes_of_error.size(); ++k) {
    const double own = weights[k + 1];
    if (p <= below + own) return sizes_of_error[k] * std::exp2((p - below) / own - 0.5);
    below += own;
  }
  return sizes_of_error.back() * std::numbers::sqrt2;
}

}  // namespace

std::vector<LawErrorSize> sizes_of_law_error() {
  std::vector<LawErrorSize> all = {{0.0, exact_prior}};
  const double sum = std::accumulate(sizes_of_error.begin(), sizes_of_error.end(), 0.0);
  for (const double size : sizes_of_error) all.push_back({size, (1.0 - exact_prior) * size / sum});
  return all;
}

bool LawErrorEstimate::seen() const {
  constexpr double least_bayes_factor = 20.0;
  const double odds_of_wrong = (1.0 - exact_weight) / exact_weight;
  return odds_of_wrong >= least_bayes_factor * (1.0 - exact_prior) / exact_prior;
}

FitResult fit_over_laws(const ImpactModel& model, Observations data, const FitOptions& options) {
  return on_threads(options.threads,
                    [&] { return averaged_here(model, std::move(data), options); });
}

FitResult fit_as_stated(const FitSpec& spec, const ImpactModel& model, Observations data,
                        const FitOptions& options) {
  return spec.uncertainty.materials == Materials::averaged
             ? fit_over_laws(model, std::move(data), options)
             : fit(model, std::move(data), options);
}

std::optional<LawErrorEstimate> law_error_of(const FitResult& fitted, double level) {
  if (fitted.laws.empty()) return std::nullopt;
  std::vector<double> weights(sizes_of_error.size() + 1, 0.0);
  for (const LawAlternative& one : fitted.laws) {
    const auto size = std::ranges::find(sizes_of_error, one.prior.size);
    const bool exact = size == sizes_of_error.end();
    weights[exact ? 0 : static_cast<std::size_t>(size - sizes_of_error.begin()) + 1] += one.weight;
  }
  const double exact = weights[0];
  LawErrorEstimate estimate;
  estimate.exact_weight = exact;
  estimate.lower = quantile_of(weights, 0.5 - level / 2.0);
  // Exact laws stand for all errors below the smallest size.
  estimate.upper = std::max(quantile_of(weights, estimate.seen() ? 0.5 + level / 2.0 : level),
                            sizes_of_error.front() / std::numbers::sqrt2);
  estimate.median = quantile_of(weights, exact + 0.5 * (1.0 - exact));
  return estimate;
}

bool LawAlternative::is_of(const FitResult& result) const {
  const LawError* own = result.model.law_error.get();
  return own == nullptr ? !(prior.size > 0.0) : own->prior() == prior;
}

const FitResult& with_laws_exact(const FitResult& fitted) {
  for (const LawAlternative& one : fitted.laws) {
    if (!(one.prior.size > 0.0) && one.fitted) return *one.fitted;
  }
  return fitted;
}

}  // namespace recoil
