#include "estimate/residual.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_sf_erf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/numerics.hpp"

namespace recoil {

namespace {

/// E sqrt(u + z) expanded in 1 / u^2; the part of z with u + z < 0 has a probability below 1e-30.
RootMoments far_above_capture(double u) {
  const double q = 1.0 / (u * u);
  const double root = std::sqrt(u);
  constexpr double a = 1.0 / 8.0;
  constexpr double b = 15.0 / 128.0;
  constexpr double c = 315.0 / 1024.0;
  constexpr double d = 45045.0 / 32768.0;
  const double mean = root * (1.0 - q * (a + q * (b + q * (c + q * d))));
  const double slope = (0.5 + q * (1.5 * a + q * (3.5 * b + q * (5.5 * c + q * 7.5 * d)))) / root;
  // u - mean^2 without cancellation: u (1 - (1 - s)^2) with s the sum in mean.
  const double s = q * (a + q * (b + q * (c + q * d)));
  return {mean, slope, u * s * (2.0 - s)};
}

RootMoments by_quadrature(double u) {
  const double lambda = gsl_sf_hazard(-u);
  // Density of y = u + z given y > 0, in a form that does not overflow on either side.
  const double inverse_norm =
      u > 0.0 ? 1.0 / (std::sqrt(2.0 * std::numbers::pi) * gsl_cdf_ugaussian_P(u)) : lambda;
  const auto density = [&](double y) {
    const double exponent = u > 0.0 ? -0.5 * (y - u) * (y - u) : y * (u - 0.5 * y);
    return std::exp(exponent) * inverse_norm;
  };
  constexpr int nodes = 64;
  const double reach = std::sqrt(u < 0.0 ? std::min(9.0, 40.0 / -u) : u + 9.0);
  const double step = reach / nodes;
  double half = 0.0;   // E y^(1/2)
  double three = 0.0;  // E y^(3/2)
  for (int i = 1; i <= nodes; ++i) {
    const double t = i * step;
    const double weight = 2.0 * t * density(t * t) * step;
    half += t * weight;
    three += t * t * t * weight;
  }
  return {half, three - (u + lambda) * half, u + lambda - half * half};
}

/// `by_quadrature` on an even grid, for interpolation through six neighbours.
class Table {
 public:
  static constexpr double from = -12.0;
  static constexpr double to = 12.0;

  Table() {
    for (int i = 0; i < count; ++i) nodes_[static_cast<std::size_t>(i)] = by_quadrature(place(i));
  }

  /// @pre from <= u <= to. Error below 1e-11.
  RootMoments operator()(double u) const {
    const double at = (u - from) / step + margin;
    const int below = static_cast<int>(at);
    const double x = at - below;  // the neighbours lie at -2, -1, 0, 1, 2, 3
    const std::array<double, 6> d = {x + 2.0, x + 1.0, x, x - 1.0, x - 2.0, x - 3.0};
    constexpr std::array<double, 6> norm = {-120.0, 24.0, -12.0, 12.0, -24.0, 120.0};
    RootMoments sum;
    for (std::size_t k = 0; k < d.size(); ++k) {
      double weight = 1.0 / norm[k];
      for (std::size_t j = 0; j < d.size(); ++j) weight *= j == k ? 1.0 : d[j];
      const RootMoments& node = nodes_[static_cast<std::size_t>(below - 2) + k];
      sum.mean += weight * node.mean;
      sum.slope += weight * node.slope;
      sum.variance += weight * node.variance;
    }
    return sum;
  }

 private:
  static constexpr double step = 1.0 / 32.0;
  static constexpr int margin = 3;
  static constexpr int count = static_cast<int>((to - from) / step) + 2 * margin + 1;
  static double place(int i) { return from + (i - margin) * step; }

  std::array<RootMoments, count> nodes_;
};

/// Tails of the standard normal distribution at z: ln P, and the density divided by P, for P(x > z)
/// and P(x < z).
struct NormalTails {
  double log_above, log_below;
  double hazard_above, hazard_below;
};

/// @param logarithms whether the logarithms are needed; else they are 0
NormalTails normal_tails_at(double z, bool logarithms) {
  const double distance = std::abs(z);
  NormalTails t{};
  constexpr double far = 25.0;  // std::erfc underflows at 38
  if (distance > far) {
    gsl_errors_are_values();
    t.hazard_above = gsl_sf_hazard(distance);
    if (logarithms) {
      t.log_above = gsl_sf_log_erfc(distance / std::numbers::sqrt2) - std::numbers::ln2;
    }
  } else {
    const double above = 0.5 * std::erfc(distance / std::numbers::sqrt2);
    const double density =
        std::exp(-0.5 * z * z) * 0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2;
    t.hazard_above = density / above;
    t.hazard_below = density / (1.0 - above);
    if (logarithms) {
      t.log_above = std::log(above);
      t.log_below = std::log1p(-above);
    }
  }
  return z < 0.0 ? NormalTails{t.log_below, t.log_above, t.hazard_below, t.hazard_above} : t;
}

/// `normal_tails_at` with a cache of one value: rows of one setting need the same z in succession.
NormalTails normal_tails(double z, bool logarithms) {
  static thread_local double last = NAN;
  static thread_local bool with_logarithms = false;
  static thread_local NormalTails tails;
  if (z != last || (logarithms && !with_logarithms)) {
    tails = normal_tails_at(z, logarithms);
    last = z;
    with_logarithms = logarithms;
  }
  return tails;
}

/// The scatter of e^2 that decides how many impacts of a point are captured. One part is
/// independent from impact to impact; the errors of V and d are common to all impacts of the point.
/// If the scatter of the impacts is unknown, the error of the mean is taken as common to all: they
/// count as one.
struct CaptureSpread {
  double scale;   ///< sd of e^2, both parts
  double weight;  ///< effective number of independent impacts over their number
};
CaptureSpread capture_spread(const Observation& point, const PointWeights& weights) {
  const double n = point.events;
  const double shared = weights.input_sd * weights.input_sd;
  if (!(weights.scatter > 0.0)) return {std::sqrt(2.0 * std::pow(weights.sd, 4) + shared), 1.0 / n};
  const double own = weights.scatter;
  const double square = own * own + shared;
  return {std::sqrt(square), (1.0 + (n - 1.0) * own * own / square) / n};
}

/// Residual of a point with all or no impacts captured.
WeightedResidual tobit_residual(const Observation& point, const PointWeights& weights, double m) {
  CaptureSpread spread = capture_spread(point, weights);
  if (point.captured == 0) spread.scale = -spread.scale;
  const double n = spread.weight * point.events;
  const NormalTails tails = normal_tails((m + weights.shift) / spread.scale, true);
  const double deviance = -2.0 * n * tails.log_above;
  if (deviance < 1e-280) return {0.0, 0.0};
  const double value = std::sqrt(deviance);
  return {value, n * tails.hazard_above / (value * spread.scale)};
}

struct Deviance {
  double value;
  double slope;
  double curvature;  // omits the second derivative of the survivors' mean
};

/// The deviance D of a point with scatter, and its derivatives in m.
/// @param slope_only the value is not needed
Deviance event_deviance(const Observation& point, const PointWeights& weights, double m,
                        bool slope_only) {
  const double x = m + weights.shift;
  Deviance d{0.0, 0.0, 0.0};
  if (!point.censored) {
    const RootMoments root = root_of_positive_normal(x / weights.scatter);
    const double unit = std::sqrt(weights.scatter);
    const double r = (point.restitution - unit * root.mean) / weights.mean_sd;
    const double r_slope = -root.slope / (unit * weights.mean_sd);
    d = {r * r, 2.0 * r * r_slope, 2.0 * r_slope * r_slope};
  }
  if (!point.counted) return d;
  const CaptureSpread spread = capture_spread(point, weights);
  const double z = x / spread.scale;
  constexpr double none_sticks = 9.0;  // Phi(-9) = 1e-19 changes no digit
  if (point.captured == 0 && z > none_sticks) return d;
  const NormalTails tails = normal_tails(z, !slope_only);
  const double captured = spread.weight * point.captured;
  const double rebounds = spread.weight * point.rebounds();
  d.value -= 2.0 * (captured * tails.log_above + rebounds * tails.log_below);
  d.slope += 2.0 / spread.scale * (captured * tails.hazard_above - rebounds * tails.hazard_below);
  d.curvature += 2.0 / (spread.scale * spread.scale) *
                 (captured * tails.hazard_above * (tails.hazard_above - z) +
                  rebounds * tails.hazard_below * (tails.hazard_below + z));
  return d;
}

WeightedResidual event_residual(const Observation& point, const PointWeights& weights, double m) {
  const DeviancePeak& peak = weights.peak;
  const double away = m - peak.at;
  const double unit = std::sqrt(0.5 * peak.curvature);
  constexpr double close = 1e-3;
  if (std::abs(away) * unit < close) {
    // D - D(at) would cancel here. Two terms of its series have a relative error of about close^2.
    const double skew = peak.third / (3.0 * peak.curvature);
    return {-unit * away * (1.0 + 0.5 * skew * away), -unit * (1.0 + skew * away)};
  }
  const Deviance d = event_deviance(point, weights, m, false);
  const double value = std::copysign(std::sqrt(std::max(0.0, d.value - peak.deviance)), -away);
  return {value, d.slope / (2.0 * value)};
}

WeightedResidual mean_residual(const Observation& point, const PointWeights& weights, double m) {
  const double variance = weights.sd * weights.sd;
  const double y = point.restitution * point.restitution - variance;
  const double hypotenuse = std::sqrt(m * m + variance * variance);
  // For m far below zero, m + hypotenuse cancels; the conjugate form does not.
  const double psi_squared =
      m >= 0.0 ? 0.5 * (m + hypotenuse) : 0.5 * variance * variance / (hypotenuse - m);
  const double psi = std::sqrt(psi_squared);
  const double psi_slope = psi / (2.0 * hypotenuse);  // d psi / d m
  const double sum = point.restitution + psi;
  const double width =
      std::sqrt(variance * (sum * sum + 2.0 * variance) + weights.input_sd * weights.input_sd);
  const double width_slope = variance * sum * psi_slope / width;
  return {(y - m) / width, (-1.0 - (y - m) / width * width_slope) / width};
}

WeightedResidual normal_residual(const Observation& point, const PointWeights& weights, double m) {
  if (weights.peaks(point)) return event_residual(point, weights, m);
  return point.censored ? tobit_residual(point, weights, m) : mean_residual(point, weights, m);
}

/// The smallest k with P(captured <= k) >= `uniform` among `n` impacts.
int binomial_quantile(double uniform, double p, int n) {
  gsl_errors_are_values();
  int below = -1;
  int reached = n;
  while (reached - below > 1) {
    const int middle = below + (reached - below) / 2;
    const bool enough =
        gsl_cdf_binomial_P(static_cast<unsigned>(middle), p, static_cast<unsigned>(n)) >= uniform;
    (enough ? reached : below) = middle;
  }
  return reached;
}

}  // namespace

RootMoments root_of_positive_normal(double u) {
  // Cache of one value: rows of one setting, and the parts of one deviance, need the same u in
  // succession.
  static thread_local double last = NAN;
  static thread_local RootMoments moments;
  if (u != last) {
    static const Table table;
    moments = u > Table::to ? far_above_capture(u) : u >= Table::from ? table(u) : by_quadrature(u);
    last = u;
  }
  return moments;
}

WeightedResidual weighted_residual(const Observation& point, const PointWeights& weights, double m,
                                   const std::optional<StudentNoise>& student) {
  const WeightedResidual r = normal_residual(point, weights, m);
  return student ? student->transformed(r) : r;
}

double event_deviance(const Observation& point, const PointWeights& weights, double m) {
  return event_deviance(point, weights, m, false).value;
}

CountMoments count_moments(const Observation& point, const PointWeights& weights, double m) {
  const double z = (m + weights.shift) / capture_spread(point, weights).scale;
  const NormalTails tails = normal_tails(z, true);
  const auto n = static_cast<double>(point.events);
  double mean = 0.0;
  double square = 0.0;
  for (int captured = 0; captured <= point.events; ++captured) {
    const double k = captured;
    const double ln_likelihood = k * tails.log_above + (n - k) * tails.log_below;
    const double probability = std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) -
                                        std::lgamma(n - k + 1.0) + ln_likelihood);
    const double of_peak =
        (k > 0.0 ? k * std::log(k / n) : 0.0) + (k < n ? (n - k) * std::log((n - k) / n) : 0.0);
    const double deviance = 2.0 * (of_peak - ln_likelihood);
    mean += probability * deviance;
    square += probability * deviance * deviance;
  }
  return {mean, square - mean * mean};
}

void locate_peak(const Observation& point, PointWeights& weights) {
  if (!weights.peaks(point)) return;
  // D decreases where all impacts would be captured and increases far above the measured mean.
  const double reach = 10.0 * (weights.scatter + weights.input_sd + weights.mean_sd);
  double low = -weights.shift - reach;
  double high = point.restitution * point.restitution - weights.shift + reach;
  DeviancePeak& peak = weights.peak;
  // Newton's method from the peak of the round before, then secants, and bisection if these are
  // slow. Written here because it runs for every point in every round of every replicate. The error
  // after a secant step is about the product of the two errors before it.
  constexpr int most_steps = 200;
  const double close_enough = 1e-13 * reach;
  const double h =
      1e-3 * std::min(weights.scatter, std::max(weights.mean_sd, 1e-3 * weights.scatter));
  const double last_step = std::max(close_enough, 1e-4 * h);
  if (!(peak.at > low && peak.at < high)) peak.at = 0.5 * (low + high);
  double before = 0.0;
  double slope_before = 0.0;
  for (int i = 0; i < most_steps && high - low > close_enough; ++i) {
    const Deviance d = event_deviance(point, weights, peak.at, true);
    if (d.slope == 0.0) break;
    (d.slope < 0.0 ? low : high) = peak.at;
    const double bend = i == 0 ? d.curvature : (d.slope - slope_before) / (peak.at - before);
    const double guess = peak.at - d.slope / bend;
    before = peak.at;
    slope_before = d.slope;
    const bool halve = i % 8 == 7 || !(guess > low && guess < high);
    peak.at = halve ? 0.5 * (low + high) : guess;
    if (std::abs(peak.at - before) < (halve || i == 0 ? close_enough : last_step)) break;
  }
  peak.deviance = event_deviance(point, weights, peak.at);
  const auto slope = [&](double m) { return event_deviance(point, weights, m, true).slope; };
  const double more = slope(peak.at + h);
  const double less = slope(peak.at - h);
  peak.curvature = (more - less) / (2.0 * h);
  peak.third = (more + less) / (h * h);  // the slope at the peak is 0
}

double survivors_sd(const Observation& point, const PointWeights& weights, double m) {
  if (point.censored) return weights.sd;
  const double variance = root_of_positive_normal((m + weights.shift) / weights.scatter).variance;
  const double of_scatter = std::sqrt(weights.scatter * variance / point.rebounds());
  const double sd = weights.sd;
  return point.rebounds() == 1 ? std::sqrt(sd * sd + of_scatter * of_scatter)
                               : std::max(sd, of_scatter);
}

double expected_restitution(const Observation& point, const PointWeights& weights, double m) {
  if (point.censored || !(weights.scatter > 0.0)) return std::sqrt(std::max(m, 0.0));
  return std::sqrt(weights.scatter) *
         root_of_positive_normal((m + weights.shift) / weights.scatter).mean;
}

double slope_in_restitution(const WeightedResidual& residual, double restitution_squared) {
  return std::abs(residual.slope) * 2.0 * std::sqrt(std::max(restitution_squared, 0.0));
}

DrawnPoint redraw_captures(const Observation& point, const PointWeights& weights,
                           double restitution_squared, double uniform) {
  const double u = (restitution_squared + weights.shift) / weights.scatter;
  DrawnPoint drawn{point, weights};
  Observation& own = drawn.point;
  // If captures were not counted, the point is a mean of rebounds without a count to draw.
  own.captured =
      point.counted ? binomial_quantile(uniform, gsl_cdf_ugaussian_Q(u), point.events) : 0;
  own.censored = point.counts_only() || own.rebounds() == 0;
  own.sd = point.event_sd(weights.sd) / std::sqrt(static_cast<double>(own.averaged()));
  drawn.weights.sd = own.sd;
  return drawn;
}

DrawnPoint simulate_observation(const Observation& point, const PointWeights& weights,
                                double restitution_squared, double noise_scale,
                                const std::optional<StudentNoise>& student, RandomStream& random) {
  const double common = weights.input_sd * random.normal();
  const double uniform = random.uniform();
  const double normal = random.normal();
  const double noise =
      noise_scale *
      (student ? student->core * gsl_cdf_tdist_Pinv(gsl_cdf_ugaussian_P(normal), student->dof)
               : normal);
  const double m = restitution_squared + common;
  if (!(weights.scatter > 0.0)) {
    DrawnPoint drawn{point, weights};
    if (!point.censored) {
      drawn.point.restitution = std::max(0.0, std::sqrt(std::max(m, 0.0)) + weights.sd * noise);
    }
    return drawn;
  }
  DrawnPoint drawn = redraw_captures(point, weights, m, uniform);
  drawn.point.restitution =
      drawn.point.censored ? 0.0
                           : std::max(0.0, expected_restitution(drawn.point, drawn.weights, m) +
                                               survivors_sd(drawn.point, drawn.weights, m) * noise);
  return drawn;
}

}  // namespace recoil
