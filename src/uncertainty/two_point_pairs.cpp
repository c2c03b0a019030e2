#include "uncertainty/two_point_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/statistics.hpp"
#include "estimate/point_conditions.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "uncertainty/bootstrap.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/refit.hpp"
#include "uncertainty/resample.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_points = 16;  // 120 pairs
// Of the two velocities: closer points differ by little but noise, hardly ever have an answer, and
// the iteration takes longest to find that out.
constexpr double least_ratio = 1.5;
constexpr std::size_t most_judged = 60;    // of a kind
constexpr std::size_t fewest_answers = 9;  // for a median and quartiles that deserve the name
// The solver's tolerance over its own: moves e^2 by 1e-8 where the noise moves it by 1e-2.
constexpr double tolerance_factor = 100.0;
constexpr double normal_quartiles = 1.3489795;  // distance of the quartiles of the normal law [sd]

EstimateScatter scatter(std::vector<double> values) {
  if (values.size() < fewest_answers) return {};
  std::sort(values.begin(), values.end());
  return {sorted_quantile(values, 0.5),
          (sorted_quantile(values, 0.75) - sorted_quantile(values, 0.25)) / normal_quartiles};
}

std::vector<std::size_t> evenly(const std::vector<std::size_t>& from, std::size_t most) {
  if (from.size() <= most) return from;
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < most; ++k) {
    chosen.push_back(from[k * (from.size() - 1) / (most - 1)]);
  }
  return chosen;
}

/// What stays the same for all pairs of one series.
struct Series {
  PairSeries at;
  std::size_t candidates = 0;
  std::vector<std::size_t> points;                         // of pairs, by velocity
  std::vector<std::pair<std::size_t, std::size_t>> pairs;  // indices into `points`
  std::vector<std::size_t> judged;                         // those of the same diameter first
  std::size_t judged_of_series = 0;
  std::vector<double> new_noise;  // variance of e at the judged points
};

/// Variance of a new measurement of e [1]: that of the point and that of its velocity and diameter.
double new_noise(const FitResult& fitted, const Observation& point, double restitution_squared) {
  const double e = std::max(std::sqrt(std::max(restitution_squared, 0.0)), point.weights.sd);
  const double of_input = e > 0.0 ? point.weights.input_sd / (2.0 * e) : 0.0;
  return std::pow(fitted.noise_scale * point.weights.sd, 2) + std::pow(of_input, 2);
}

Series make_series(const FitResult& fitted, const PairSeries& at) {
  Series series;
  series.at = at;
  std::vector<std::size_t> candidates;
  std::vector<std::size_t> same;
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < fitted.data.points.size(); ++i) {
    const Observation& point = fitted.data.points[i];
    if (point.dataset != at.dataset || point.censored) continue;
    (point.diameter == at.diameter ? same : others).push_back(i);
    if (point.diameter == at.diameter && fitted.prediction_squared[i] > 0.0 &&
        point.restitution > 0.0) {
      candidates.push_back(i);
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(), [&](std::size_t a, std::size_t b) {
    return fitted.data.points[a].velocity < fitted.data.points[b].velocity;
  });
  series.candidates = candidates.size();
  series.points = evenly(candidates, most_points);
  for (std::size_t low = 0; low < series.points.size(); ++low) {
    for (std::size_t high = low + 1; high < series.points.size(); ++high) {
      const bool apart = fitted.data.points[series.points[high]].velocity >=
                         least_ratio * fitted.data.points[series.points[low]].velocity;
      if (apart) series.pairs.emplace_back(low, high);
    }
  }
  series.judged = evenly(same, most_judged);
  series.judged_of_series = series.judged.size();
  for (const std::size_t i : evenly(others, most_judged)) series.judged.push_back(i);
  for (const std::size_t i : series.judged) {
    series.new_noise.push_back(
        new_noise(fitted, fitted.data.points[i], fitted.prediction_squared[i]));
  }
  return series;
}

std::vector<PointConditions> conditions(const Observations& data,
                                        const std::vector<std::size_t>& points) {
  std::vector<PointConditions> made;
  for (const std::size_t i : points) {
    made.push_back({data.points[i].dataset, data.points[i].diameter, data.points[i].velocity});
  }
  return made;
}

/// What a calibration is judged by.
struct Yardstick {
  const std::vector<double>& e;      // at the judged points
  const std::vector<double>* noise;  // added to each squared error; null: none
};

/// The error of what `predictor` last evaluated, without the points in `used`.
HeldOut error_beside(const Observations& data, const Series& series,
                     const PointPredictor& predictor, const Yardstick& yardstick,
                     const std::vector<std::size_t>& used) {
  std::array<double, 2> sum = {};
  std::array<int, 2> count = {};
  for (std::size_t k = 0; k < series.judged.size(); ++k) {
    if (std::find(used.begin(), used.end(), series.judged[k]) != used.end()) continue;
    if (!predictor.at(k).usable()) return {};
    const double e =
        expected_restitution(data.points[series.judged[k]], predictor.at(k).restitution_squared);
    const std::size_t kind = k < series.judged_of_series ? 0 : 1;
    sum[kind] += std::pow(e - yardstick.e[k], 2) +
                 (yardstick.noise == nullptr ? 0.0 : (*yardstick.noise)[k]);
    ++count[kind];
  }
  HeldOut error;
  if (count[0] > 0) error.series = std::sqrt(sum[0] / count[0]);
  if (count[1] > 0) error.diameters = std::sqrt(sum[1] / count[1]);
  return error;
}

HeldOut median_of(const std::vector<HeldOut>& errors) {
  std::vector<double> series;
  std::vector<double> diameters;
  for (const HeldOut& error : errors) {
    if (error.series) series.push_back(*error.series);
    if (error.diameters) diameters.push_back(*error.diameters);
  }
  return {scatter(std::move(series)).median, scatter(std::move(diameters)).median};
}

/// The simulated data: e of the points that pairs are made of, and the full fit of all points.
struct Simulation {
  std::vector<std::vector<double>> restitution;  // [series][points], 0: captured
  std::vector<double> theta;                     // empty: the fit failed
};

Simulation simulate(const ResamplingPlan& plan, const ImpactModel& model,
                    const std::vector<Series>& all, std::uint64_t seed, std::uint64_t index) {
  RandomStream random(seed, RandomPurpose::two_point_pairs, index);
  Observations sample = plan.fitted->data;
  resample_parametric(plan, setting_errors_of(plan, seed, index), random, sample);
  Simulation made;
  for (const Series& series : all) {
    made.restitution.emplace_back();
    for (const std::size_t i : series.points) {
      const Observation& point = sample.points[i];
      made.restitution.back().push_back(point.censored ? 0.0 : point.restitution);
    }
  }
  LeastSquaresResult full = refit(model, sample, plan.fitted->theta);
  if (has_answer(full, *plan.fitted)) made.theta = std::move(full.theta);
  return made;
}

class Study {
 public:
  Study(const FitResult& fitted, const ImpactModel& model, const Series& series)
      : data_(fitted.data), model_(model), series_(series) {
    for (const std::size_t i : series.judged) {
      fitted_e_.push_back(
          expected_restitution(fitted.data.points[i], fitted.prediction_squared[i]));
      measured_e_.push_back(fitted.data.points[i].restitution);
    }
  }

  /// Pair number `p` on the simulated data of series number `s`.
  PairQuality pair(std::size_t p, std::size_t s, const std::vector<Simulation>& simulations) const {
    const auto [low, high] = series_.pairs[p];
    PairQuality quality;
    quality.low_point = series_.points[low];
    quality.high_point = series_.points[high];
    std::vector<TwoPoints> points = {
        two_points(quality, measured(quality.low_point), measured(quality.high_point))};
    for (const Simulation& simulation : simulations) {
      const double e_low = simulation.restitution[s][low];
      const double e_high = simulation.restitution[s][high];
      if (e_low > 0.0 && e_high > 0.0) {
        points.push_back(two_points(quality, e_low, e_high));
      } else {
        ++quality.ended[static_cast<std::size_t>(TwoPointStatus::too_few_points)];
      }
    }
    const std::vector<TwoPointRun> runs = iterate_two_points(model_, points);
    PointPredictor predictor(model_, conditions(data_, series_.judged));
    const std::vector<std::size_t> used = {quality.low_point, quality.high_point};
    quality.measured = runs.front();
    if (quality.measured.status == TwoPointStatus::converged) {
      predictor.evaluate(two_point_theta(model_, series_.at.dataset, quality.measured), false);
      quality.measured_held_out =
          error_beside(data_, series_, predictor, {measured_e_, nullptr}, used);
    }
    std::vector<double> C_H;
    std::vector<double> C_A;
    std::vector<HeldOut> errors;
    for (std::size_t k = 1; k < runs.size(); ++k) {
      ++quality.ended[static_cast<std::size_t>(runs[k].status)];
      if (runs[k].status != TwoPointStatus::converged) continue;
      C_H.push_back(runs[k].C_H);
      C_A.push_back(runs[k].C_A);
      predictor.evaluate(two_point_theta(model_, series_.at.dataset, runs[k]), false);
      errors.push_back(
          error_beside(data_, series_, predictor, {fitted_e_, &series_.new_noise}, used));
    }
    quality.C_H = scatter(std::move(C_H));
    quality.C_A = scatter(std::move(C_A));
    quality.held_out = median_of(errors);
    return quality;
  }

  /// Everything that is not about a pair.
  PairStudy full(const FitResult& fitted, const std::vector<Simulation>& simulations) const {
    PairStudy study;
    study.dataset = series_.at.dataset;
    study.diameter = series_.at.diameter;
    study.simulations = static_cast<int>(simulations.size());
    study.points = series_.candidates;
    study.taken = series_.points.size();
    const std::size_t slot_H = model_.slot_C_H[study.dataset];
    const std::size_t slot_A = model_.slot_C_A[study.dataset];
    study.truth_C_H = fitted.theta[slot_H];
    study.truth_C_A = fitted.theta[slot_A];
    PointPredictor predictor(model_, conditions(data_, series_.judged));
    std::vector<double> C_H;
    std::vector<double> C_A;
    std::vector<HeldOut> errors;
    for (const Simulation& simulation : simulations) {
      if (simulation.theta.empty()) {
        ++study.full_failed;
        continue;
      }
      C_H.push_back(simulation.theta[slot_H]);
      C_A.push_back(simulation.theta[slot_A]);
      predictor.evaluate(simulation.theta, false);
      errors.push_back(
          error_beside(data_, series_, predictor, {fitted_e_, &series_.new_noise}, {}));
    }
    study.C_H = scatter(std::move(C_H));
    study.C_A = scatter(std::move(C_A));
    study.held_out = median_of(errors);
    predictor.evaluate(fitted.theta, false);
    study.measured_held_out = error_beside(data_, series_, predictor, {measured_e_, nullptr}, {});
    return study;
  }

 private:
  double measured(std::size_t point) const { return data_.points[point].restitution; }

  TwoPoints two_points(const PairQuality& pair, double e_low, double e_high) const {
    return {series_.at.dataset,
            series_.at.diameter,
            {data_.points[pair.low_point].velocity, e_low},
            {data_.points[pair.high_point].velocity, e_high}};
  }

  const Observations& data_;
  const ImpactModel& model_;
  const Series& series_;
  std::vector<double> fitted_e_;  // of the full fit at the judged points
  std::vector<double> measured_e_;
};

}  // namespace

double PairQuality::without_answer() const {
  int all = 0;
  for (const int count : ended) all += count;
  const int converged = ended[static_cast<std::size_t>(TwoPointStatus::converged)];
  return all > 0 ? 1.0 - static_cast<double>(converged) / all : 0.0;
}

std::vector<PairStudy> study_two_point_pairs(const FitResult& fitted,
                                             const std::vector<PairSeries>& series,
                                             const PairStudyOptions& options) {
  std::vector<Series> all;
  if (options.simulations > 0) {
    for (const PairSeries& at : series) {
      Series made = make_series(fitted, at);
      if (!made.pairs.empty()) all.push_back(std::move(made));
    }
  }
  if (all.empty()) return {};
  ImpactModel model = fitted.model;
  model.solver.tolerance_factor = tolerance_factor;
  const ResamplingPlan plan = plan_resampling(fitted, Scheme::parametric);
  std::vector<Simulation> simulations(static_cast<std::size_t>(options.simulations));
  parallel_over(simulations.size(), options.threads, [&](std::size_t i) {
    simulations[i] = simulate(plan, model, all, options.seed, i);
  });

  std::vector<PairStudy> studies;
  for (std::size_t s = 0; s < all.size(); ++s) {
    const Study study(fitted, model, all[s]);
    studies.push_back(study.full(fitted, simulations));
    std::vector<PairQuality>& pairs = studies.back().pairs;
    pairs.resize(all[s].pairs.size());
    Progress progress("choices of two points", pairs.size());
    parallel_over(pairs.size(), options.threads, [&](std::size_t p) {
      pairs[p] = study.pair(p, s, simulations);
      progress.advance();
    });
    const auto of_paper =
        std::find(all[s].pairs.begin(), all[s].pairs.end(),
                  std::pair<std::size_t, std::size_t>(0, all[s].points.size() - 1));
    studies.back().paper = static_cast<std::size_t>(of_paper - all[s].pairs.begin());
  }
  return studies;
}

}  // namespace recoil
