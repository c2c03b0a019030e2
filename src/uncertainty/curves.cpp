#include "uncertainty/curves.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics.hpp"
#include "core/parallel.hpp"
#include "core/statistics.hpp"
#include "estimate/observation.hpp"
#include "estimate/predictor.hpp"

namespace recoil {
namespace {

constexpr int even_velocities = 48;  // log-spaced over the range
constexpr int rising_velocities = 56;
constexpr int captured_velocities = 16;
constexpr std::size_t most_band_replicates = 999;

std::vector<double> velocity_grid(double slowest, double fastest, const CaptureEstimate& capture) {
  const double last = 1.2 * fastest, rise = capture.value;
  const bool rises = capture.found && rise > 0.0;
  const double first = rises ? std::min(slowest, 0.9 * rise) : 0.8 * slowest;
  if (!rises || !(rise < last)) return log_spaced(first, last, even_velocities);
  // Above V*, e rises like sqrt(V - V*): steps that grow with the distance from V* show no corners.
  std::vector<double> grid = log_spaced(first, rise, captured_velocities);
  for (int i = 1; i <= rising_velocities; ++i) {
    grid.push_back(rise * std::pow(last / rise, std::pow(double(i) / rising_velocities, 2)));
  }
  return grid;
}

/// e at every velocity [1]; NaN if the impact cannot be solved.
std::vector<double> evaluate(const ImpactModel& model, std::span<const double> theta,
                             const RestitutionCurve& curve) {
  return restitution_curve(model, theta, {curve.dataset, curve.diameter, 0.0, curve.series_number},
                           curve.velocity);
}

void add_band(const ImpactModel& model, const BandSource& band, RestitutionCurve& curve) {
  const auto& replicates = band.theta;
  const std::size_t count = std::min(replicates.size(), most_band_replicates);
  if (count < fewest_replicates(band.level)) return;
  std::vector<std::vector<double>> values(count);
  parallel_over(count, band.threads,
                [&](std::size_t i) { values[i] = evaluate(model, replicates[i], curve); });
  const double tail = (1.0 - band.level) / 2.0;
  for (std::size_t k = 0; k < curve.velocity.size(); ++k) {
    std::vector<double> column;
    for (const std::vector<double>& row : values) {
      if (std::isfinite(row[k])) column.push_back(row[k]);
    }
    if (column.empty()) {  // no replicate has a value here: the band has no width
      column.push_back(curve.restitution[k]);
    }
    std::sort(column.begin(), column.end());
    curve.lower.push_back(sorted_quantile(column, tail));
    curve.upper.push_back(sorted_quantile(column, 1.0 - tail));
  }
}

/// Removes velocities at which the impact of the fit cannot be solved.
void drop_unanswered(RestitutionCurve& curve) {
  std::vector<double> v;
  std::vector<double> e;
  for (std::size_t k = 0; k < curve.velocity.size(); ++k) {
    if (!std::isfinite(curve.restitution[k])) continue;
    v.push_back(curve.velocity[k]);
    e.push_back(curve.restitution[k]);
  }
  curve.velocity = std::move(v);
  curve.restitution = std::move(e);
}

}  // namespace

void add_restitution(const ImpactModel& model, std::span<const double> theta,
                     const BandSource& band, RestitutionCurve& curve) {
  curve.restitution = evaluate(model, theta, curve);
  add_band(model, band, curve);
}

std::vector<RestitutionCurve> restitution_curves(const FitResult& fitted,
                                                 const std::vector<Dataset>& datasets,
                                                 const std::vector<CaptureEstimate>& captures,
                                                 const std::vector<TwoPointComparison>& two_points,
                                                 const BandSource& band) {
  std::vector<RestitutionCurve> curves;
  for (const CaptureEstimate& capture : captures) {
    RestitutionCurve curve;
    curve.dataset = capture.dataset;
    curve.diameter = capture.diameter;
    double slowest = 0.0;
    double fastest = 0.0;
    for (const Observation& point : fitted.data.points) {
      if (point.dataset != capture.dataset || point.diameter != capture.diameter) continue;
      if (curve.series.empty()) {
        curve.series = datasets[point.dataset].series[point.series];
        curve.series_number = point.series;
      }
      slowest = slowest == 0.0 ? point.velocity : std::min(slowest, point.velocity);
      fastest = std::max(fastest, point.velocity);
    }
    curve.velocity = velocity_grid(slowest, fastest, capture);
    curve.restitution = evaluate(fitted.model, fitted.theta, curve);
    drop_unanswered(curve);
    add_band(fitted.model, band, curve);
    const TwoPointResult two_point =
        two_points.empty() ? TwoPointResult{} : two_points[capture.dataset].result;
    if (two_point.status == TwoPointStatus::converged) {
      curve.two_point = evaluate(fitted.model, two_point.theta, curve);
      const bool sound = std::all_of(curve.two_point.begin(), curve.two_point.end(),
                                     [](double e) { return std::isfinite(e); });
      if (!sound) curve.two_point.clear();
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace recoil
