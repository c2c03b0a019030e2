#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "estimate/impact_problem.hpp"
#include "estimate/noise.hpp"
#include "estimate/survivors.hpp"

namespace recoil {
namespace {

constexpr int most_rounds = 25;
constexpr double settled_parameters = 1e-3;  // of their standard errors
constexpr double settled_scale = 1e-4;       // relative
constexpr double proportional_floor = 0.1;   // e below which relative noise stays as it is
constexpr double least_scale = 1e-6;         // of e: no measurement is better
constexpr double first_spread = 0.05;        // omega of the first round
constexpr double least_spread = 2e-3;
constexpr double largest_spread = 0.6;
// Where e^2 exceeds its scatter so many times, survivors are all there are: sqrt(e^2) is their mean
// to a relative 1 / (8 * 30^2) = 1.4e-4.
constexpr double far_from_capture = 30.0;

/// e^2 at one point and its first two derivatives in the logarithm of V or d.
struct Local {
  double value = 0.0;
  double slope = 0.0;
  double bend = 0.0;
};

/// sd of a mean of `rebounds` impacts at predicted e^2 = m.
double function_sd(VarianceFunction function, double scale, double m, int rebounds) {
  const double s = scale / std::sqrt(static_cast<double>(std::max(1, rebounds)));
  const double square = std::max(m, 0.0);
  if (function == VarianceFunction::proportional) {
    return s * std::sqrt(square + proportional_floor * proportional_floor);
  }
  if (function == VarianceFunction::capture) {
    // 4 e^2 sd^2 + 2 sd^4 = s^2, the variance of e^2 for a normal e.
    return s * std::sqrt(0.5 / (square + std::sqrt(square * square + 0.5 * s * s)));
  }
  return s;
}

/// Renews everything in the weights that depends on the parameters.
class Reweighing {
 public:
  Reweighing(const ImpactModel& model, std::span<const double> theta, Observations& data)
      : model_(model), theta_(theta), data_(data) {
    for (const Observation& point : data.points) {
      mixed_ = mixed_ || (point.captured > 0 && !point.censored);
    }
  }

  /// False when the model has no answer somewhere.
  bool run() {
    for (Observation& point : data_.points) {
      const Prediction at = predict_at(point, 1.0, 1.0);
      if (!at.usable()) return false;
      predicted_.push_back(at.restitution_squared);
      if (!data_.sd_stated) {
        point.sd = function_sd(data_.noise.variance, data_.noise.scale, predicted_.back(),
                               point.censored ? point.events : point.rebounds());
      }
      if (!add_input_errors(point, predicted_.back())) return false;
    }
    return !mixed_ || settle_scatter();
  }

  const std::vector<double>& predicted() const { return predicted_; }

 private:
  Prediction predict_at(const Observation& point, double faster, double larger) const {
    return predict(model_, theta_, point.dataset, point.diameter * larger, point.velocity * faster,
                   false);
  }

  /// Differences over exp(+-h) in V, or in d.
  std::optional<Local> local(const Observation& point, double middle, double h,
                             bool in_velocity) const {
    const double up = std::exp(h);
    const Prediction more = in_velocity ? predict_at(point, up, 1.0) : predict_at(point, 1.0, up);
    const Prediction less =
        in_velocity ? predict_at(point, 1.0 / up, 1.0) : predict_at(point, 1.0, 1.0 / up);
    if (!more.usable() || !less.usable()) return std::nullopt;
    const double a = more.restitution_squared;
    const double b = less.restitution_squared;
    return Local{middle, (a - b) / (2.0 * h), (a - 2.0 * middle + b) / (h * h)};
  }

  bool add_input_errors(Observation& point, double m) const {
    constexpr double shortest_step = 1e-3;
    constexpr double longest_step = 0.3;
    double variance = 0.0;
    point.input_bias = 0.0;
    for (const bool in_velocity : {true, false}) {
      const double relative = in_velocity ? point.velocity_sd / point.velocity
                                          : point.diameter_sd / point.diameter;
      if (!(relative > 0.0)) continue;
      const auto at =
          local(point, m, std::clamp(relative, shortest_step, longest_step), in_velocity);
      if (!at) return false;
      const double shared =
          in_velocity && point.rebound_measured ? 2.0 * std::max(m, 0.0) : 0.0;
      variance += std::pow((at->slope + shared) * relative, 2);
      point.input_bias += 0.5 * at->bend * relative * relative;
    }
    point.input_sd = std::sqrt(variance);
    return true;
  }

  void set_scatter(Observation& point, const Local& at, double spread) const {
    const double square = spread * spread;
    point.shift = 0.5 * square * at.bend;
    point.scatter =
        std::sqrt(square * at.slope * at.slope + 0.5 * square * square * at.bend * at.bend);
    const double u = (at.value + point.shift) / point.scatter;
    if (!(u < far_from_capture) && point.captured == 0) {
      point.scatter = 0.0;
      point.shift = 0.0;
      return;
    }
    const double slope = root_of_positive_normal(u).slope / std::sqrt(point.scatter);
    point.mean_sd = std::hypot(point.sd, slope * point.input_sd);
  }

  double deviance(const std::vector<Local>& locals, double log_spread) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < locals.size(); ++i) {
      Observation point = data_.points[i];
      set_scatter(point, locals[i], std::exp(log_spread));
      if (point.scatter > 0.0) {
        sum += event_deviance(point, locals[i].value);
      } else {
        sum += std::pow((point.restitution - expected_restitution(point, locals[i].value)) /
                            point.sd, 2);
      }
    }
    return sum;
  }

  /// omega by maximum likelihood at these parameters, and what follows for every point.
  bool settle_scatter() {
    double& spread = data_.noise.event_spread;
    if (!(spread > 0.0)) spread = first_spread;
    std::vector<Local> locals;
    for (std::size_t i = 0; i < data_.points.size(); ++i) {
      const auto at = local(data_.points[i], predicted_[i], std::sqrt(3.0) * spread, true);
      if (!at) return false;
      locals.push_back(*at);
    }
    spread = std::exp(lowest(locals));
    for (std::size_t i = 0; i < locals.size(); ++i) {
      Observation& point = data_.points[i];
      set_scatter(point, locals[i], spread);
      if (point.scatter > 0.0 && !point.censored) locate_peak(point);
    }
    return true;
  }

  /// The minimum of the deviance in ln omega: a grid, then the golden section about its best.
  double lowest(const std::vector<Local>& locals) const {
    constexpr int grid = 12;
    const double from = std::log(least_spread);
    const double stride = (std::log(largest_spread) - from) / grid;
    int best = 0;
    double best_value = INFINITY;
    for (int i = 0; i <= grid; ++i) {
      const double value = deviance(locals, from + i * stride);
      if (value < best_value) {
        best = i;
        best_value = value;
      }
    }
    double low = from + std::max(best - 1, 0) * stride;
    double high = from + std::min(best + 1, grid) * stride;
    constexpr double golden = 0.6180339887498949;
    double x1 = high - golden * (high - low);
    double x2 = low + golden * (high - low);
    double f1 = deviance(locals, x1);
    double f2 = deviance(locals, x2);
    constexpr double tolerance = 1e-4;  // of omega, relative
    while (high - low > tolerance) {
      if (f1 < f2) {
        high = x2;
        x2 = x1;
        f2 = f1;
        x1 = high - golden * (high - low);
        f1 = deviance(locals, x1);
      } else {
        low = x1;
        x1 = x2;
        f1 = f2;
        x2 = low + golden * (high - low);
        f2 = deviance(locals, x2);
      }
    }
    return 0.5 * (low + high);
  }

  const ImpactModel& model_;
  std::span<const double> theta_;
  Observations& data_;
  bool mixed_ = false;
  std::vector<double> predicted_;
};

int free_count(const ImpactModel& model) {
  return static_cast<int>(std::count_if(model.slots.begin(), model.slots.end(),
                                        [](const ParameterSlot& slot) { return slot.free; }));
}

/// The largest step of a free parameter in units of its standard error (of its value, without one).
double largest_step(const LeastSquaresResult& run, const std::vector<double>& before) {
  double largest = 0.0;
  const std::size_t p = before.size();
  for (std::size_t j = 0; j < p; ++j) {
    const double error = run.covariance.empty() ? 0.0 : std::sqrt(run.covariance[j * p + j]);
    const double unit = error > 0.0 ? error : std::abs(run.theta[j]);
    const double step = std::abs(run.theta[j] - before[j]);
    if (step > 0.0) largest = std::max(largest, step / unit);
  }
  return largest;
}

Settled settle_with(const ImpactModel& model, Observations data, std::span<const double> start,
                    const LeastSquaresOptions& options) {
  Settled settled;
  settled.data = std::move(data);
  std::vector<double> theta(start.begin(), start.end());
  for (int round = 0; round < most_rounds; ++round) {
    Reweighing weights(model, theta, settled.data);
    if (!weights.run()) {
      settled.run.converged = false;
      settled.run.message = "the model has no answer beside a point, where the weights need one";
      return settled;
    }
    settled.run = minimise(impact_problem(model, settled.data), theta, options);
    if (!settled.run.converged) return settled;
    double scale = 1.0;
    if (!settled.data.sd_stated) {
      scale = misfit(settled.data, settled.run.residuals, weights.predicted(), free_count(model))
                  .scale();
    }
    const bool still = largest_step(settled.run, theta) < settled_parameters &&
                       std::abs(scale - 1.0) < settled_scale;
    theta = settled.run.theta;
    if (still) break;
    if (settled.data.sd_stated) continue;
    // Data without noise would let the scale shrink for ever.
    if (settled.data.noise.scale * scale < least_scale) break;
    settled.data.noise.scale *= scale;
  }
  return settled;
}

/// -2 ln restricted likelihood but for a constant that the variance functions share.
double restricted_criterion(const ImpactModel& model, const Settled& settled) {
  const LeastSquaresResult& run = settled.run;
  const auto& points = settled.data.points;
  const double unit =
      !points.empty() && points.front().student ? points.front().student->calibration() : 1.0;
  double criterion = run.sum_of_squares / unit;
  for (const Observation& point : points) {
    if (!point.censored) criterion += 2.0 * std::log(point.sd);
  }
  const std::size_t p = run.theta.size();
  std::vector<std::size_t> free;
  for (std::size_t j = 0; j < p; ++j) {
    if (model.slots[j].free) free.push_back(j);
  }
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(points.size()),
                           static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < free.size(); ++k) {
      jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          run.jacobian[i * p + free[k]];
    }
  }
  if (free.empty()) return criterion;
  const Eigen::VectorXd diagonal =
      jacobian.householderQr().matrixQR().diagonal().cwiseAbs().array().log();
  const double log_determinant = 2.0 * diagonal.sum();
  return std::isfinite(log_determinant) ? criterion + log_determinant : criterion;
}

}  // namespace

double handicap(VarianceFunction function) {
  switch (function) {
    case VarianceFunction::constant:
      return 1.0;
    case VarianceFunction::proportional:
      return 3.0;
    case VarianceFunction::capture:
    case VarianceFunction::stated:
      break;
  }
  return 0.0;
}

Settled settle(const ImpactModel& model, Observations data, std::span<const double> start,
               const LeastSquaresOptions& options) {
  if (!data.weights_depend_on_fit()) {
    Settled settled{{}, std::move(data)};
    settled.run = minimise(impact_problem(model, settled.data), start, options);
    return settled;
  }
  if (data.sd_stated || data.spec.variance) {
    return settle_with(model, std::move(data), start, options);
  }
  std::optional<Settled> best;
  double best_criterion = INFINITY;
  std::vector<VarianceCandidate> candidates;
  for (const VarianceFunction function :
       {VarianceFunction::constant, VarianceFunction::proportional, VarianceFunction::capture}) {
    Observations own = data;
    own.noise.variance = function;
    Settled settled = settle_with(model, std::move(own), start, options);
    if (!settled.run.converged) {
      if (!best) best = std::move(settled);
      continue;
    }
    const double criterion = restricted_criterion(model, settled);
    candidates.push_back({function, settled.data.noise.scale, criterion});
    if (criterion + handicap(function) < best_criterion) {
      best_criterion = criterion + handicap(function);
      best = std::move(settled);
    }
  }
  best->data.noise.candidates = std::move(candidates);
  return std::move(*best);
}

}  // namespace recoil
