#include "estimate/weights.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "core/numerics.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/pooled_deviations.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "estimate/setting_error.hpp"

namespace recoil {
namespace {

constexpr double first_spread = 0.05;  // event_spread omega of the first round
constexpr double near_reach = 0.7;     // largest step in ln omega: a factor of two
constexpr double least_spread = 2e-3;
constexpr double largest_spread = 0.6;
// If e^2 exceeds its scatter by this factor, all spheres survive: sqrt(e^2) is their mean to a
// relative 1 / (8 * 30^2) = 1.4e-4. A point whose scatter counts keeps it up to a slightly larger
// factor: otherwise a point at the limit would change its weight in every round, without end. It is
// larger by more than these rounds change the spread, and no more, as the answer must not depend on
// the start.
constexpr double far_from_capture = 30.0;
constexpr double far_again = 1.1 * far_from_capture;
// Initial sd of e^2 from impact to impact if only counts are known: d e^2 / d ln V is about 2 at
// capture, and capture velocities typically scatter by a tenth.
constexpr double first_scatter = 0.2;

/// The step in ln V or ln d for differences of e^2, given the relative error of V or d.
double error_step(double relative) {
  constexpr double shortest = 1e-3;
  constexpr double longest = 0.3;
  return std::clamp(relative, shortest, longest);
}

/// Renews weights. It collects all conditions at which it needs the model, so that they are
/// simulated in one batch, and reads the predictions in the same order.
class WeightUpdate {
 public:
  /// @param inputs false: only the scatter from impact to impact
  WeightUpdate(const Observations& data, Weights before, bool inputs)
      : data_(data), weights_(std::move(before)), inputs_(inputs) {
    for (const PointWeights& own : weights_.points) scattered_.push_back(own.scatter > 0.0);
    const std::vector<bool> mixed = among_captures(data.points);
    mixed_ = std::find(mixed.begin(), mixed.end(), true) != mixed.end();
    double& spread = weights_.noise.event_spread;
    if (!mixed_) forget_scatter();
    if (mixed_ && !(spread > 0.0)) spread = first_spread;
  }

  /// The conditions besides the points themselves at which predictions are needed. `points` may
  /// have the results at the points.
  std::vector<PointConditions> sample_points(const PointPredictor& points) {
    std::vector<PointConditions> all;
    scatters_.assign(data_.points.size(), mixed_);
    for (std::size_t i = 0; mixed_ && points.keeps_answers() && i < scatters_.size(); ++i) {
      // Far from capture, the slope alone shows that the scatter is not used.
      const Observation& p = data_.points[i];
      const double first_order =
          weights_.noise.event_spread * p.velocity * std::abs(points.velocity_slope(i));
      scatters_[i] = p.captured > 0 || scattered_[i] ||
                     !(points.at(i).restitution_squared > 2.0 * far_from_capture * first_order);
    }
    const auto beside = [&](const Observation& p, double h, bool in_velocity) {
      for (const double factor : {std::exp(h), std::exp(-h)}) {
        all.push_back({p.dataset, p.diameter * (in_velocity ? 1.0 : factor),
                       p.velocity * (in_velocity ? factor : 1.0), p.series});
      }
    };
    for (std::size_t i = 0; i < data_.points.size(); ++i) {
      const Observation& p = data_.points[i];
      for (std::size_t k = 0; inputs_ && k < data_.sources.size(); ++k) {
        const InputShift by = data_.sources[k]->shift(p);
        if (by.relative() > 0.0) beside(p, error_step(by.relative()), by.velocity > 0.0);
      }
      if (scatters_[i]) beside(p, std::sqrt(3.0) * weights_.noise.event_spread, true);
    }
    return all;
  }

  /// @param at the predicted e^2 of the points
  /// @param beside the predictions at `sample_points`
  /// @param free_count number of free parameters
  Weights updated(const std::vector<double>& at, const std::vector<Prediction>& beside,
                  int free_count) && {
    auto next = beside.begin();
    const auto local = [&](double middle, double h) {
      const double more = (next++)->restitution_squared;
      const double less = (next++)->restitution_squared;
      return Local{middle, (more - less) / (2.0 * h), (more - 2.0 * middle + less) / (h * h)};
    };
    if (inputs_) {
      weights_.predicted = at;
      weights_.effects.assign(data_.sources.size(), std::vector<double>(at.size(), 0.0));
    }
    if (inputs_) pool_noise(at);
    std::vector<Local> locals;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (inputs_) set_errors(i, at[i], local);
      if (scatters_[i]) {
        locals.push_back(local(at[i], std::sqrt(3.0) * weights_.noise.event_spread));
      } else if (mixed_) {
        locals.push_back({at[i], 0.0, 0.0});
      }
    }
    if (mixed_) estimate_scatter(locals);
    if (inputs_) set_errors_of_restitution(at, free_count);
    return std::move(weights_);
  }

  /// The weights with event_spread times `factor` and its effect on them; the rest is unchanged.
  Weights with_spread(const std::vector<double>& at, const std::vector<Prediction>& beside,
                      double factor) const {
    Weights changed = weights_;
    changed.noise.event_spread *= factor;
    auto next = beside.begin();
    for (std::size_t i = 0; i < changed.points.size(); ++i) {
      if (!scatters_[i]) continue;
      const double middle = at[i];
      const double more = (next++)->restitution_squared;
      const double less = (next++)->restitution_squared;
      const double h = std::sqrt(3.0) * weights_.noise.event_spread;
      PointWeights& own = changed.points[i];
      if (!(own.scatter > 0.0)) continue;
      set_scatter(i, own,
                  {middle, (more - less) / (2.0 * h), (more - 2.0 * middle + less) / (h * h)},
                  changed.noise.event_spread);
      locate_peak(data_.points[i], own);
    }
    return changed;
  }

 private:
  /// A replicate may lack points with both rebounds and captures although the original data had
  /// some.
  void forget_scatter() {
    weights_.noise.event_spread = 0.0;
    for (PointWeights& own : weights_.points) {
      own.scatter = 0.0;
      own.shift = 0.0;
    }
  }

  void pool_noise(const std::vector<double>& at) {
    if (!data_.noise.pools_sd) return;
    Noise& noise = weights_.noise;
    const auto pooled = pool_deviations(data_, weights_, at)
                            .value_or(PooledNoise{VarianceFunction::stated, 0.0, 0});
    noise.variance = pooled.variance;
    noise.scale = pooled.scale;
    noise.pooled_dof = pooled.dof;
  }

  /// Sets the estimated sd and the effective variance of point i with predicted e^2 `m`; `local`
  /// reads the next derivatives.
  template <class NextLocal>
  void set_errors(std::size_t i, double m, const NextLocal& local) {
    const Observation& point = data_.points[i];
    PointWeights& own = weights_.points[i];
    const bool pooled = weights_.noise.pooled_dof > 0 && pools_deviation(point);
    if (!data_.noise.sd_stated || pooled) {
      own.sd = std::max(data_.noise.rounding_sd,
                        weights_.noise.estimated_sd(m, own.proximity, point.averaged()));
    } else {
      own.sd = point.sd;
    }
    double variance = 0.0;
    own.input_bias = 0.0;
    for (std::size_t k = 0; k < data_.sources.size(); ++k) {
      const ErrorSource& source = *data_.sources[k];
      const double relative = source.shift(point).relative();
      if (!(relative > 0.0)) continue;
      const Local at = local(m, error_step(relative));
      const double effect = source.effect(point, at, weights_.noise);
      weights_.effects[k][i] = effect;
      // Without e there is no residual that an error could share.
      if (source.shared != SharedBy::none && !point.censored) continue;
      variance += effect * effect;
      own.input_bias += 0.5 * at.bend * relative * relative;
    }
    own.input_sd = std::sqrt(variance);
  }

  /// Sets the effects of the errors that are no errors of an input, and sigma of the settings.
  void set_errors_of_restitution(const std::vector<double>& at, int free_count) {
    weights_.noise.setting_sd =
        data_.share(SharedBy::setting) ? setting_sd_at(data_, weights_, at, free_count) : 0.0;
    for (std::size_t k = 0; k < data_.sources.size(); ++k) {
      const ErrorSource& source = *data_.sources[k];
      for (std::size_t i = 0; i < at.size(); ++i) {
        const Observation& point = data_.points[i];
        if (source.shift(point).relative() > 0.0) continue;
        weights_.effects[k][i] = source.effect(point, {at[i], 0.0, 0.0}, weights_.noise);
      }
    }
  }

  void set_scatter(std::size_t i, PointWeights& own, const Local& at, double spread) const {
    const Observation& point = data_.points[i];
    const double square = spread * spread;
    own.shift = 0.5 * square * at.bend;
    own.scatter =
        std::sqrt(square * at.slope * at.slope + 0.5 * square * square * at.bend * at.bend);
    const double u = (at.value + own.shift) / own.scatter;
    if (!(u < (scattered_[i] ? far_again : far_from_capture)) && point.captured == 0) {
      own.scatter = 0.0;
      own.shift = 0.0;
      return;
    }
    const double by_input =
        root_of_positive_normal(u).slope / std::sqrt(own.scatter) * own.input_sd;
    const double of_mean = survivors_sd(point, own, at.value);
    own.mean_sd = std::sqrt(of_mean * of_mean + by_input * by_input);
  }

  /// -2 ln likelihood up to a constant; sets the scatter of the points to this spread.
  double deviance(const std::vector<Local>& locals, double log_spread) {
    const double spread = std::exp(log_spread);
    double sum = 0.0;
    for (std::size_t i = 0; i < locals.size(); ++i) {
      const Observation& point = data_.points[i];
      PointWeights& own = weights_.points[i];
      set_scatter(i, own, locals[i], spread);
      if (own.scatter > 0.0) {
        sum += event_deviance(point, own, locals[i].value);
        if (!point.censored) sum += 2.0 * std::log(own.mean_sd / own.sd);
      } else if (!point.censored) {
        sum += std::pow(
            (point.restitution - expected_restitution(point, own, locals[i].value)) / own.sd, 2);
      }
    }
    return sum;
  }

  /// Estimates omega by maximum likelihood at these parameters, and sets the scatter of every
  /// point.
  void estimate_scatter(const std::vector<Local>& locals) {
    double& spread = weights_.noise.event_spread;
    spread = std::exp(lowest(locals));
    for (std::size_t i = 0; i < locals.size(); ++i) {
      set_scatter(i, weights_.points[i], locals[i], spread);
      locate_peak(data_.points[i], weights_.points[i]);
    }
  }

  /// The ln omega that minimises the deviance: a local search from the omega of the round before,
  /// by parabolas and, if these fail, by golden section; if the minimum is not bracketed, a search
  /// over the whole range.
  double lowest(const std::vector<Local>& locals) {
    const double before = std::log(weights_.noise.event_spread);
    constexpr double tolerance = 1e-3;          // of omega, relative
    const double close = std::sqrt(tolerance);  // the error after a Newton step is about its square
    const double least = std::log(least_spread);
    const double most = std::log(largest_spread);
    const auto at = [&](double log_spread) { return deviance(locals, log_spread); };
    constexpr int most_parabolas = 8;
    constexpr double width = 0.02;  // half-width of a parabola
    double place = before;
    double lowest_value = at(place);
    for (int i = 0; i < most_parabolas; ++i) {
      const double more = at(place + width);
      const double less = at(place - width);
      // The deviance decreases towards an end of the range: the end is the answer.
      if (place < least + width && more > lowest_value) return place;
      if (place > most - width && less > lowest_value) return place;
      const double bend = (more - 2.0 * lowest_value + less) / (width * width);
      const double downhill = (less - more) / (2.0 * width);
      const double step = bend > 0.0 ? std::clamp(downhill / bend, -near_reach, near_reach)
                                     : std::copysign(near_reach, downhill);
      const double next = std::clamp(place + step, least, most);
      if (bend > 0.0 && std::abs(step) < close) return next;
      const double there = at(next);
      if (!(there < lowest_value)) break;
      place = next;
      lowest_value = there;
    }
    const double near = find_minimum(at, std::max(place - near_reach, least),
                                     std::min(place + near_reach, most), tolerance);
    if (std::abs(near - place) < 0.95 * near_reach) return near;
    constexpr int grid = 12;
    const double stride = (most - least) / grid;
    int best = 0;
    double best_value = INFINITY;
    for (int i = 0; i <= grid; ++i) {
      const double value = at(least + i * stride);
      if (value < best_value) {
        best = i;
        best_value = value;
      }
    }
    return find_minimum(at, least + std::max(best - 1, 0) * stride,
                        least + std::min(best + 1, grid) * stride, tolerance);
  }

  const Observations& data_;
  Weights weights_;
  bool inputs_;
  bool mixed_ = false;           ///< in some range of velocities spheres both rebound and stick
  std::vector<bool> scattered_;  ///< points whose scatter counted before
  /// Points that may be close enough to capture for the scatter to matter.
  std::vector<bool> scatters_;
};

/// The predicted e^2 at the points, and the predictions at `WeightUpdate::sample_points`.
struct ModelValues {
  std::vector<double> at;
  std::vector<Prediction> beside;
};

/// Evaluates the model for `update`; nullopt if an impact cannot be solved. The fit needs the
/// gradients at the same theta next, so they are computed at once if `points` keeps them.
std::optional<ModelValues> evaluate_model(const ImpactModel& model, std::span<const double> theta,
                                          PointPredictor& points, WeightUpdate& update) {
  ModelValues values{std::vector<double>(points.size()), {}};
  std::atomic<bool> answered = true;
  const auto take = [&](std::size_t first, std::span<const ImpactResult> block) {
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (!block[k].usable()) answered = false;
      values.at[first + k] = block[k].restitution_squared;
    }
  };
  points.evaluate_blocks(theta, points.keeps_answers(), take);
  if (!answered) return std::nullopt;
  std::vector<PointConditions> beside = update.sample_points(points);
  if (!beside.empty()) values.beside = predict(model, theta, std::move(beside), false);
  for (const Prediction& one : values.beside) {
    if (!one.usable()) return std::nullopt;
  }
  return values;
}

/// Sets (V* / V)^2 of every point at `theta`.
void set_proximities(const ImpactModel& model, const Observations& data,
                     std::span<const double> theta, Weights& weights) {
  std::map<std::pair<std::size_t, double>, double> captures;  // V* by dataset and diameter
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    const auto [found, is_new] = captures.try_emplace({point.dataset, point.diameter});
    double& capture = found->second;
    if (is_new) capture = weakly_damped_capture(model, theta, point.dataset, point.diameter);
    weights.points[i].proximity = std::min(1.0, std::pow(capture / point.velocity, 2));
  }
}

}  // namespace

Weights Weights::subset(std::span<const std::size_t> indices) const {
  const auto of = [&](const auto& all) {
    std::decay_t<decltype(all)> part;
    for (std::size_t k = 0; !all.empty() && k < indices.size(); ++k) {
      part.push_back(all[indices[k]]);
    }
    return part;
  };
  Weights part{of(points), noise, of(predicted), {}};
  for (const std::vector<double>& effect : effects) part.effects.push_back(of(effect));
  return part;
}

Weights first_weights(const Observations& data) {
  return first_weights(data, first_noise(data.noise));
}

Weights first_weights(const Observations& data, Noise noise) {
  Weights weights;
  weights.noise = std::move(noise);
  if (!data.weights_depend_on_fit()) weights.noise.event_spread = 0.0;  // no sphere was captured
  for (const Observation& point : data.points) {
    PointWeights& own = weights.points.emplace_back();
    own.sd = data.noise.sd_stated
                 ? point.sd
                 : nominal_sd / std::sqrt(static_cast<double>(std::max(1, point.averaged())));
    if (!point.counts_only()) continue;
    own.scatter = first_scatter;
    own.mean_sd = own.sd;
    locate_peak(point, own);
  }
  return weights;
}

std::optional<Weights> weights_at(const ImpactModel& model, const Observations& data,
                                  Weights before, std::span<const double> theta,
                                  PointPredictor& points) {
  if (!data.noise.sd_stated || data.noise.pools_sd) set_proximities(model, data, theta, before);
  WeightUpdate update(data, std::move(before), true);
  const auto values = evaluate_model(model, theta, points, update);
  if (!values) return std::nullopt;
  return std::move(update).updated(values->at, values->beside, model.free_count());
}

std::optional<Weights> with_event_spread_at(const ImpactModel& model, const Observations& data,
                                            Weights before, std::span<const double> theta) {
  if (!(before.noise.event_spread > 0.0)) return before;
  WeightUpdate update(data, std::move(before), false);
  PointPredictor points(model, data.conditions());
  const auto values = evaluate_model(model, theta, points, update);
  if (!values) return std::nullopt;
  return std::move(update).updated(values->at, values->beside, model.free_count());
}

std::vector<double> event_spread_covariance(const ImpactModel& model, std::span<const double> theta,
                                            const Observations& data, const Weights& weights,
                                            std::span<const double> C) {
  if (!(weights.noise.event_spread > 0.0) || C.empty()) return {};
  WeightUpdate update(data, weights, false);
  const auto points = std::make_shared<PointPredictor>(model, data.conditions());
  const auto values = evaluate_model(model, theta, *points, update);
  if (!values) return {};
  const std::size_t n = data.points.size();
  const std::size_t p = theta.size();
  constexpr double step = 0.1;
  std::vector<double> deviance;             // T at ln omega - step, 0, + step
  std::vector<std::vector<double>> slopes;  // half of dT / d theta there
  for (const double by : {-step, 0.0, step}) {
    const Weights there = update.with_spread(values->at, values->beside, std::exp(by));
    const LeastSquaresProblem problem = impact_problem(model, data, there, points);
    std::vector<double> residuals(problem.residual_count);
    std::vector<double> jacobian(problem.residual_count * p);
    if (!problem.evaluate(theta, residuals, jacobian)) return {};
    deviance.push_back(event_spread_offset(data, there));
    slopes.emplace_back(p, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      deviance.back() += residuals[i] * residuals[i];
      for (std::size_t j = 0; j < p; ++j) slopes.back()[j] += residuals[i] * jacobian[i * p + j];
    }
  }
  double information = 0.5 * (deviance[2] - 2.0 * deviance[1] + deviance[0]) / (step * step);
  std::vector<double> b(p, 0.0);
  for (std::size_t j = 0; j < p; ++j) {
    for (std::size_t k = 0; k < p; ++k) {
      b[j] -= C[j * p + k] * (slopes[2][k] - slopes[0][k]) / (2.0 * step);
    }
  }
  for (std::size_t k = 0; k < p; ++k) {
    information += b[k] * (slopes[2][k] - slopes[0][k]) / (2.0 * step);  // - g'C g
  }
  const double variance = 1.0 / std::max(information, 1.0);
  std::vector<double> added(p * p);
  for (std::size_t j = 0; j < p; ++j) {
    for (std::size_t k = 0; k < p; ++k) added[j * p + k] = variance * b[j] * b[k];
  }
  return added;
}

double event_spread_offset(const Observations& data, const Weights& weights) {
  double sum = 0.0;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const PointWeights& own = weights.points[i];
    if (!(own.scatter > 0.0) || data.points[i].censored) continue;
    sum += own.peak.deviance + 2.0 * std::log(own.mean_sd / own.sd);
  }
  return sum;
}

}  // namespace recoil
