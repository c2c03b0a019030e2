#include "estimate/noise.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <utility>

#include "core/numerics.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/impact_problem.hpp"
#include "estimate/observations.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "estimate/shared_settings.hpp"

namespace recoil {
namespace {

// e below which the sd of proportional noise is nearly constant.
constexpr double proportional_floor = 0.1;
constexpr double steepness = 2.0;      // d ln sd / d (V* / V)^2
constexpr double first_spread = 0.05;  // event_spread omega of the first round
constexpr double near_reach = 0.7;     // largest step in ln omega: a factor of two
constexpr double least_spread = 2e-3;
constexpr double largest_spread = 0.6;
// If e^2 exceeds its scatter by this factor, all spheres survive: sqrt(e^2) is their mean to a
// relative 1 / (8 * 30^2) = 1.4e-4.
constexpr double far_from_capture = 30.0;

/// e^2 at one point and its first two derivatives in the logarithm of V or d.
struct Local {
  double value = 0.0;
  double slope = 0.0;
  double bend = 0.0;
};

/// The step in ln V or ln d for differences of e^2, given the relative error of V or d.
double error_step(double relative) {
  constexpr double shortest = 1e-3;
  constexpr double longest = 0.3;
  return std::clamp(relative, shortest, longest);
}

/// Renews the weights of `data`. It collects all conditions at which it needs the model, so that
/// they are simulated in one batch, and reads the answers in the same order.
class Renewal {
 public:
  enum class What { everything, event_spread };

  explicit Renewal(Observations& data, What what = What::everything)
      : data_(data), everything_(what == What::everything) {
    const std::vector<bool> mixed = among_captures(data.points);
    mixed_ = std::find(mixed.begin(), mixed.end(), true) != mixed.end();
    if (!mixed_) forget_scatter();
    if (mixed_ && !(data.noise.event_spread > 0.0)) data.noise.event_spread = first_spread;
  }

  /// The conditions besides the points themselves at which predictions are needed. `points` may
  /// have the results at the points.
  std::vector<PointConditions> questions(const PointPredictor& points) {
    std::vector<PointConditions> all;
    scatters_.assign(data_.points.size(), mixed_);
    for (std::size_t i = 0; mixed_ && points.keeps_answers() && i < scatters_.size(); ++i) {
      // Far from capture, the slope alone shows that the scatter is not used.
      const Observation& p = data_.points[i];
      const double first_order =
          data_.noise.event_spread * p.velocity * std::abs(points.velocity_slope(i));
      scatters_[i] = p.captured > 0 ||
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
      if (everything_ && p.velocity_sd > 0.0)
        beside(p, error_step(p.velocity_sd / p.velocity), true);
      if (everything_ && p.setting_velocity_sd > 0.0)
        beside(p, error_step(p.setting_velocity_sd / p.velocity), true);
      for (const double sd : {p.diameter_sd, p.series_diameter_sd}) {
        if (everything_ && sd > 0.0) beside(p, error_step(sd / p.diameter), false);
      }
      if (scatters_[i]) beside(p, std::sqrt(3.0) * data_.noise.event_spread, true);
    }
    return all;
  }

  /// @param at the predicted e^2 of the points
  /// @param beside the answers to `questions`
  void learn(const std::vector<double>& at, const std::vector<Prediction>& beside) {
    auto next = beside.begin();
    const auto value = [&] { return (next++)->restitution_squared; };
    const auto local = [&](double middle, double h) {
      const double more = value();
      const double less = value();
      return Local{middle, (more - less) / (2.0 * h), (more - 2.0 * middle + less) / (h * h)};
    };
    std::vector<Local> locals;
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (everything_) set_errors(data_.points[i], at[i], local);
      if (scatters_[i]) {
        locals.push_back(local(at[i], std::sqrt(3.0) * data_.noise.event_spread));
      } else if (mixed_) {
        locals.push_back({at[i], 0.0, 0.0});
      }
    }
    if (mixed_) estimate_scatter(locals);
  }

  /// The data with event_spread times `factor` and its effect on the weights; the rest is
  /// unchanged.
  Observations with_spread(const std::vector<double>& at, const std::vector<Prediction>& beside,
                           double factor) const {
    Observations changed = data_;
    changed.noise.event_spread *= factor;
    auto next = beside.begin();
    for (std::size_t i = 0; i < changed.points.size(); ++i) {
      if (!scatters_[i]) continue;
      const double middle = at[i];
      const double more = (next++)->restitution_squared;
      const double less = (next++)->restitution_squared;
      const double h = std::sqrt(3.0) * data_.noise.event_spread;
      Observation& point = changed.points[i];
      if (!(point.weights.scatter > 0.0)) continue;
      set_scatter(point,
                  {middle, (more - less) / (2.0 * h), (more - 2.0 * middle + less) / (h * h)},
                  changed.noise.event_spread);
      if (point.peaks()) locate_peak(point);
    }
    return changed;
  }

 private:
  /// A replicate may lack points with both rebounds and captures although the original data had
  /// some.
  void forget_scatter() {
    data_.noise.event_spread = 0.0;
    for (Observation& point : data_.points) {
      point.weights.scatter = 0.0;
      point.weights.shift = 0.0;
    }
  }

  /// Sets the estimated sd and the effective variance of one point with predicted e^2 `m`; `local`
  /// reads the next derivatives.
  template <class NextLocal>
  void set_errors(Observation& point, double m, const NextLocal& local) const {
    if (!data_.noise.sd_stated) {
      point.weights.sd = data_.noise.estimated_sd(m, point.weights.proximity,
                                                  point.censored ? point.events : point.rebounds());
    }
    double variance = 0.0;
    point.weights.input_bias = 0.0;
    point.weights.setting_sd = 0.0;
    const auto add = [&](double relative, double shared) {
      if (!(relative > 0.0)) return;
      const Local at = local(m, error_step(relative));
      variance += std::pow((at.slope + shared) * relative, 2);
      point.weights.input_bias += 0.5 * at.bend * relative * relative;
    };
    const double of_ratio = 2.0 * std::max(m, 0.0);  // d e^2 / d ln V of e = V_rebound / V
    add(point.velocity_sd / point.velocity, point.rebound_measured ? of_ratio : 0.0);
    if (const double relative = point.setting_velocity_sd / point.velocity; relative > 0.0) {
      const Local at = local(m, error_step(relative));
      if (m > 0.0) {
        point.weights.setting_sd = std::abs(at.slope + of_ratio) * relative / (2.0 * std::sqrt(m));
      }
    }
    add(point.diameter_sd / point.diameter, 0.0);
    point.weights.size_sd = 0.0;
    if (const double relative = point.series_diameter_sd / point.diameter; relative > 0.0) {
      const Local at = local(m, error_step(relative));
      if (m > 0.0) point.weights.size_sd = at.slope * relative / (2.0 * std::sqrt(m));
    }
    point.weights.input_sd = std::sqrt(variance);
  }

  void set_scatter(Observation& point, const Local& at, double spread) const {
    const double square = spread * spread;
    point.weights.shift = 0.5 * square * at.bend;
    point.weights.scatter =
        std::sqrt(square * at.slope * at.slope + 0.5 * square * square * at.bend * at.bend);
    const double u = (at.value + point.weights.shift) / point.weights.scatter;
    if (!(u < far_from_capture) && point.captured == 0) {
      point.weights.scatter = 0.0;
      point.weights.shift = 0.0;
      return;
    }
    const double by_input = root_of_positive_normal(u).slope / std::sqrt(point.weights.scatter) *
                            point.weights.input_sd;
    const double own = survivors_sd(point, at.value);
    point.weights.mean_sd = std::sqrt(own * own + by_input * by_input);
  }

  /// -2 ln likelihood up to a constant; sets the scatter of the points to this spread.
  double deviance(const std::vector<Local>& locals, double log_spread) {
    const double spread = std::exp(log_spread);
    double sum = 0.0;
    for (std::size_t i = 0; i < locals.size(); ++i) {
      Observation& point = data_.points[i];
      set_scatter(point, locals[i], spread);
      if (point.weights.scatter > 0.0) {
        sum += event_deviance(point, locals[i].value);
        if (!point.censored) sum += 2.0 * std::log(point.weights.mean_sd / point.weights.sd);
      } else if (!point.censored) {
        sum += std::pow(
            (point.restitution - expected_restitution(point, locals[i].value)) / point.weights.sd,
            2);
      }
    }
    return sum;
  }

  /// Estimates omega by maximum likelihood at these parameters, and sets the scatter of every
  /// point.
  void estimate_scatter(const std::vector<Local>& locals) {
    double& spread = data_.noise.event_spread;
    spread = std::exp(lowest(locals));
    for (std::size_t i = 0; i < locals.size(); ++i) {
      Observation& point = data_.points[i];
      set_scatter(point, locals[i], spread);
      if (point.peaks()) locate_peak(point);
    }
  }

  /// The ln omega that minimises the deviance: a local search from the omega of the round before,
  /// by parabolas and, if these fail, by golden section; if the minimum is not bracketed, a search
  /// over the whole range.
  double lowest(const std::vector<Local>& locals) {
    const double before = std::log(data_.noise.event_spread);
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

  Observations& data_;
  bool everything_;
  bool mixed_ = false;  ///< in some range of velocities spheres both rebound and stick
  /// Points that may be close enough to capture for the scatter to matter.
  std::vector<bool> scatters_;
};

/// The predicted e^2 at the points, and the predictions at `Renewal::questions`.
struct Answers {
  std::vector<double> at;
  std::vector<Prediction> beside;
};

/// Evaluates the model for `renewal`; nullopt if an impact cannot be solved. The fit needs the
/// gradients at the same theta next, so they are computed at once if `points` keeps them.
std::optional<Answers> ask(const ImpactModel& model, std::span<const double> theta,
                           PointPredictor& points, Renewal& renewal) {
  Answers answers{std::vector<double>(points.size()), {}};
  std::atomic<bool> answered = true;
  const auto take = [&](std::size_t first, std::span<const ImpactResult> block) {
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (!block[k].usable()) answered = false;
      answers.at[first + k] = block[k].restitution_squared;
    }
  };
  points.evaluate_blocks(theta, points.keeps_answers(), take);
  if (!answered) return std::nullopt;
  std::vector<PointConditions> questions = renewal.questions(points);
  if (!questions.empty()) answers.beside = predict(model, theta, std::move(questions), false);
  for (const Prediction& answer : answers.beside) {
    if (!answer.usable()) return std::nullopt;
  }
  return answers;
}

}  // namespace

double Noise::estimated_sd(double restitution_squared, double proximity, int impacts) const {
  const double s = scale / std::sqrt(static_cast<double>(std::max(1, impacts)));
  const double square = std::max(restitution_squared, 0.0);
  double sd = s;
  switch (variance) {
    case VarianceFunction::stated:
    case VarianceFunction::constant:
      break;
    case VarianceFunction::proportional:
      sd = s * std::sqrt(square + proportional_floor * proportional_floor);
      break;
    case VarianceFunction::capture:
      // 4 e^2 sd^2 + 2 sd^4 = s^2, the variance of e^2 for a normal e.
      sd = s * std::sqrt(0.5 / (square + std::sqrt(square * square + 0.5 * s * s)));
      break;
    case VarianceFunction::steep:
      sd = s * std::exp(steepness * proximity);
      break;
  }
  return std::max(rounding_sd, sd);
}

std::optional<std::vector<double>> renew_weights(const ImpactModel& model,
                                                 std::span<const double> theta,
                                                 PointPredictor& points, Observations& data) {
  if (!data.noise.sd_stated) {
    double capture = 0.0;  // V* of the present dataset and diameter
    const Observation* before = nullptr;
    for (Observation& point : data.points) {
      if (before == nullptr || before->dataset != point.dataset ||
          before->diameter != point.diameter) {
        capture = weakly_damped_capture(model, theta, point.dataset, point.diameter);
      }
      before = &point;
      point.weights.proximity = std::min(1.0, std::pow(capture / point.velocity, 2));
    }
  }
  Renewal renewal(data);
  auto answers = ask(model, theta, points, renewal);
  if (!answers) return std::nullopt;
  renewal.learn(answers->at, answers->beside);
  renew_settings(answers->at, model.free_count(), data);
  return std::move(answers->at);
}

bool renew_event_spread(const ImpactModel& model, std::span<const double> theta,
                        Observations& data) {
  if (!(data.noise.event_spread > 0.0)) return true;
  Renewal renewal(data, Renewal::What::event_spread);
  PointPredictor points(model, data.conditions());
  const auto answers = ask(model, theta, points, renewal);
  if (answers) renewal.learn(answers->at, answers->beside);
  return answers.has_value();
}

std::vector<double> event_spread_covariance(const ImpactModel& model, std::span<const double> theta,
                                            const Observations& data, std::span<const double> C) {
  if (!(data.noise.event_spread > 0.0) || C.empty()) return {};
  Observations own = data;
  Renewal renewal(own, Renewal::What::event_spread);
  const auto points = std::make_shared<PointPredictor>(model, data.conditions());
  const auto answers = ask(model, theta, *points, renewal);
  if (!answers) return {};
  const std::size_t n = data.points.size();
  const std::size_t p = theta.size();
  constexpr double step = 0.1;
  std::vector<double> deviance;             // T at ln omega - step, 0, + step
  std::vector<std::vector<double>> slopes;  // half of dT / d theta there
  for (const double by : {-step, 0.0, step}) {
    const Observations there = renewal.with_spread(answers->at, answers->beside, std::exp(by));
    const LeastSquaresProblem problem = impact_problem(model, there, nullptr, points);
    std::vector<double> residuals(problem.residual_count);
    std::vector<double> jacobian(problem.residual_count * p);
    if (!problem.evaluate(theta, residuals, jacobian)) return {};
    deviance.push_back(event_spread_offset(there));
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

double event_spread_offset(const Observations& data) {
  double sum = 0.0;
  for (const Observation& point : data.points) {
    if (!(point.weights.scatter > 0.0) || point.censored) continue;
    sum += point.weights.peak.deviance + 2.0 * std::log(point.weights.mean_sd / point.weights.sd);
  }
  return sum;
}

}  // namespace recoil
