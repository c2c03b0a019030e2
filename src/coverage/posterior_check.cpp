#include "coverage/posterior_check.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/random.hpp"
#include "core/statistics.hpp"
#include "coverage/coverage_truth.hpp"
#include "estimate/law_average.hpp"
#include "estimate/model_verdict.hpp"
#include "estimate/noise_doubt.hpp"

namespace recoil {
namespace {

/// The measured points and, after them, the repeated ones. No error is shared between the two.
/// @param scale of the noise: the repeated points state their errors without it
Observations with_repeated(const Observations& measured, const std::vector<Dataset>& before,
                           const std::vector<Dataset>& after, double scale) {
  Observations both = measured;
  SharedNumbers next;
  next.launch = 0;
  for (const Observation& point : measured.points) {
    next.setting = std::max(next.setting, point.setting + 1);
    next.batch = std::max(next.batch, point.batch + 1);
    next.size = std::max(next.size, point.size + 1);
    if (point.launch == Observation::no_launch) continue;
    next.launch = std::max(next.launch, point.launch + 1);
  }
  std::size_t i = 0;
  for (std::size_t d = 0; d < after.size(); ++d) {
    for (std::size_t k = 0; k < after[d].points.size(); ++k) {
      const ImpactPoint& now = after[d].points[k];
      Observation point = measured.points[i++];
      point.setting += next.setting;
      point.batch += next.batch;
      point.size += next.size;
      if (point.launch != Observation::no_launch) point.launch += next.launch;
      point.restitution = now.restitution;
      point.events = now.events;
      point.captured = now.captured;
      point.counted = now.counted || now.captured > 0;
      point.censored = now.all_captured() || now.counts_only;
      // What did not change may contain the error of rounding.
      const bool renewed = now.restitution_sd != before[d].points[k].restitution_sd;
      if (now.restitution_sd && renewed) point.sd = *now.restitution_sd / scale;
      both.points.push_back(point);
    }
  }
  return both;
}

/// How far ranks are from uniform: the least probability, at any rank, of so few or so many below.
class Evenness {
 public:
  double operator()(const std::vector<int>& ranks) {
    std::vector<unsigned> up_to(most_rank, 0);  // the number of ranks up to i
    for (const int rank : ranks) {
      for (std::size_t i = static_cast<std::size_t>(rank); i < up_to.size(); ++i) ++up_to[i];
    }
    double least = 1.0;
    for (std::size_t i = 0; i < up_to.size(); ++i) {
      const auto [at, is_new] = tails_.try_emplace({i, up_to[i]}, 0.0);
      if (is_new) at->second = tail(i, up_to[i], static_cast<unsigned>(ranks.size()));
      least = std::min(least, at->second);
    }
    return least;
  }

 private:
  static double tail(std::size_t i, unsigned count, unsigned of) {
    const double p = static_cast<double>(i + 1) / (most_rank + 1);
    const double above = count == 0 ? 1.0 : gsl_cdf_binomial_Q(count - 1, p, of);
    return std::min(above, gsl_cdf_binomial_P(count, p, of));
  }
  std::map<std::pair<std::size_t, unsigned>, double> tails_;  // all ranks are equally many
};

/// The probability that uniform ranks are as uneven anywhere: simultaneous bands (Saeilynoja,
/// Buerkner & Vehtari 2022, Stat. Comput. 32, 32) by simulation.
class EvenRanks {
 public:
  explicit EvenRanks(std::size_t sets) {
    constexpr std::uint64_t samples = 9999;
    std::vector<int> uniform(sets);
    for (std::uint64_t s = 0; s < samples; ++s) {
      RandomStream random(1, RandomPurpose::calibration, s);
      for (int& rank : uniform) rank = static_cast<int>(random.below(most_rank + 1));
      of_uniform_.push_back(evenness_(uniform));
    }
    std::sort(of_uniform_.begin(), of_uniform_.end());
  }
  double p_value(const std::vector<int>& ranks) {
    const auto at = std::upper_bound(of_uniform_.begin(), of_uniform_.end(), evenness_(ranks));
    return static_cast<double>(at - of_uniform_.begin() + 1) /
           static_cast<double>(of_uniform_.size() + 1);
  }

 private:
  Evenness evenness_;
  std::vector<double> of_uniform_;
};

RankedParameter ranked(const std::string& name, const std::vector<int>& ranks, double p_value) {
  std::vector<double> scores;
  RankedParameter found{.parameter = name, .p_value = p_value};
  for (const int rank : ranks) {
    scores.push_back(gsl_cdf_ugaussian_Pinv((rank + 0.5) / (most_rank + 1)));
    found.held += rank >= 5 && rank < 95 ? 1 : 0;
  }
  const auto n = static_cast<double>(ranks.size());
  found.error_ratio = standard_deviation(scores);
  found.ratio_lower = found.error_ratio * std::sqrt((n - 1.0) / gsl_cdf_chisq_Pinv(0.975, n - 1.0));
  found.ratio_upper = found.error_ratio * std::sqrt((n - 1.0) / gsl_cdf_chisq_Pinv(0.025, n - 1.0));
  found.shift = mean(scores);
  found.shift_sd = found.error_ratio / std::sqrt(n);
  return found;
}

}  // namespace

PosteriorStudy posterior_study(const FitSpec& spec, const std::vector<Dataset>& datasets,
                               const UncertaintyOptions& options) {
  PosteriorStudy study;
  FitOptions fitting;
  fitting.threads = options.threads;
  FitResult fitted =
      fit_as_stated(spec, make_model(spec, datasets), gather(datasets, spec), fitting);
  if (!fitted.usable) throw ComputationError("no posterior to check: " + fitted.failure);
  study.fitted = std::make_shared<const FitResult>(std::move(fitted));
  study.alternatives = noise_alternatives(*study.fitted);
  study.datasets = datasets;
  study.seed = options.seed;
  PosteriorOptions sampling = sampling_options(options);
  sampling.pointwise = false;
  study.posterior = sample_posterior(study.alternatives, {}, sampling);
  study.simulate = [datasets, seed = options.seed](const FitResult& truth, std::uint64_t index) {
    return simulate_at(truth, datasets, impacts_of(truth.model), truth.theta, seed, index);
  };
  return study;
}

PosteriorTrial repeat_measurement(const PosteriorStudy& study, std::uint64_t index) {
  const PosteriorResult& posterior = study.posterior;
  if (posterior.draws.empty()) return {};
  // Multiples of the golden ratio spread over the draws of all chains.
  const double share = std::fmod((static_cast<double>(index) + 0.5) * std::numbers::phi, 1.0);
  const auto k = static_cast<std::size_t>(share * static_cast<double>(posterior.draws.size()));
  FitResult truth = study.alternatives[posterior.alternative[k]].fitted();
  truth.theta = posterior.draws[k];
  const double scale = posterior.scale.empty() ? 1.0 : posterior.scale[k];
  for (PointWeights& point : truth.weights.points) point.sd *= scale;
  std::vector<Dataset> repeated;
  try {
    repeated = study.simulate(truth, index);
  } catch (const ComputationError&) {
    return {};
  }
  FitOptions fitting;
  fitting.several_starts = false;
  fitting.start = study.fitted->theta;
  fitting.noise = study.fitted->weights.noise;
  fitting.noise->candidates.clear();
  const FitResult both =
      fit(study.fitted->model, with_repeated(study.fitted->data, study.datasets, repeated, scale),
          fitting);
  if (!both.usable) return {};
  const std::vector<double> shares =
      shares_below(both, truth.theta, study.steps, study.seed, ~index);
  PosteriorTrial trial;
  for (std::size_t j = 0; j < shares.size(); ++j) {
    if (!both.model.slots[j].free) continue;
    trial.ranks.push_back(static_cast<int>(shares[j] * (most_rank + 1)));
  }
  return trial;
}

std::vector<double> rank_p_values(const std::vector<std::vector<int>>& ranks) {
  std::vector<double> p_values;
  if (ranks.empty()) return p_values;
  EvenRanks even(ranks.front().size());
  for (const std::vector<int>& own : ranks) p_values.push_back(even.p_value(own));
  return p_values;
}

PosteriorCheck judge_posterior(const PosteriorStudy& study,
                               const std::vector<PosteriorTrial>& trials) {
  constexpr int fewest_sets = 50;
  constexpr double doubtful = 0.05;
  PosteriorCheck check;
  for (const PosteriorTrial& trial : trials) ++(trial.ranks.empty() ? check.failed : check.sets);
  std::vector<std::string> names;
  std::vector<std::vector<int>> ranks;
  for (const ParameterSlot& slot : study.fitted->model.slots) {
    if (!slot.free || check.sets < 2) continue;
    std::vector<int>& own = ranks.emplace_back();
    for (const PosteriorTrial& trial : trials) {
      if (!trial.ranks.empty()) own.push_back(trial.ranks.at(names.size()));
    }
    names.push_back(slot.label());
  }
  const std::vector<double> p_values = rank_p_values(ranks);
  for (std::size_t k = 0; k < names.size(); ++k) {
    check.parameters.push_back(ranked(names[k], ranks[k], p_values[k]));
    check.p_value = std::min(check.p_value, p_values[k] * static_cast<double>(names.size()));
  }
  const bool too_few = check.sets < fewest_sets || check.failed * 10 > check.sets + check.failed;
  if (study.posterior.draws.empty()) {
    check.because = NoVerdict::no_posterior;
  } else if (too_few) {
    check.because = NoVerdict::few_sets;
  } else if (check.p_value < rejected_posterior) {
    check.verdict = PosteriorVerdict::not_believed;
  } else if (judge_model(*study.fitted).verdict == ModelVerdict::does_not_fit) {
    check.because = NoVerdict::model_rejected;
  } else if (!noise_doubts(*study.fitted).empty()) {
    check.because = NoVerdict::noise_in_doubt;
  } else if (check.p_value < doubtful) {
    check.because = NoVerdict::open_ranks;
  } else {
    check.verdict = PosteriorVerdict::believed;
  }
  return check;
}

PosteriorCheck check_posterior(const PosteriorStudy& study, int datasets, int threads) {
  std::vector<PosteriorTrial> trials(static_cast<std::size_t>(datasets));
  Progress progress("coverage", trials.size());
  parallel_over(trials.size(), threads, [&](std::size_t i) {
    trials[i] = repeat_measurement(study, i);
    progress.advance();
  });
  return judge_posterior(study, trials);
}

}  // namespace recoil
