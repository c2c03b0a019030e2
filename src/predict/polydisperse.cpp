#include "predict/polydisperse.hpp"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/observation.hpp"
#include "estimate/predictor.hpp"
#include "uncertainty/interval.hpp"

namespace recoil {
namespace {

constexpr std::size_t conventions = capture_conventions.size();

/// The averages at one velocity under one set of parameters; NaN: no value.
struct Mixture {
  std::array<double, conventions> average{};
  double captured = 0.0;
  double unseen = 0.0;
};

/// Simulates spheres of all sizes at all velocities in one batch, for many sets of parameters.
class MixtureFlight {
 public:
  MixtureFlight(const ImpactModel& model, std::size_t dataset, const std::vector<SizeBin>& bins,
                const std::vector<double>& velocities, double slowest_seen)
      : bins_(bins),
        velocities_(velocities),
        slowest_seen_(slowest_seen),
        predictor_(model, conditions(dataset, bins, velocities), Effects::of_nature) {}

  std::vector<Mixture> under(std::span<const double> theta) {
    predictor_.evaluate(theta, false);
    std::vector<Mixture> out;
    for (std::size_t k = 0; k < velocities_.size(); ++k) out.push_back(at(k));
    return out;
  }

 private:
  static std::vector<PointConditions> conditions(std::size_t dataset,
                                                 const std::vector<SizeBin>& bins,
                                                 const std::vector<double>& velocities) {
    std::vector<PointConditions> points;
    for (const double v : velocities) {
      for (const SizeBin& bin : bins) points.push_back({dataset, bin.diameter, v});
    }
    return points;
  }

  Mixture at(std::size_t k) const {
    double all = 0.0;
    double back = 0.0;
    double seen = 0.0;
    double sum = 0.0;
    double sum_seen = 0.0;
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      const ImpactResult& impact = predictor_.at(k * bins_.size() + i);
      const double w = bins_[i].weight;
      if (!impact.usable()) {  // without a solution for one size, the mixture has no value
        const double none = std::nan("");
        return {{none, none, none}, none, none};
      }
      const double e = std::sqrt(std::max(0.0, impact.restitution_squared));
      all += w;
      if (!(e > 0.0)) continue;
      back += w;
      sum += w * e;
      if (!(e * velocities_[k] > slowest_seen_)) continue;
      seen += w;
      sum_seen += w * e;
    }
    Mixture out;
    out.average = {sum / all, back > 0.0 ? sum / back : std::nan(""),
                   seen > 0.0 ? sum_seen / seen : std::nan("")};
    out.captured = (all - back) / all;
    out.unseen = (all - seen) / all;
    return out;
  }

  const std::vector<SizeBin>& bins_;
  const std::vector<double>& velocities_;
  double slowest_seen_;
  PointPredictor predictor_;
};

CurveMiss miss(const std::vector<double>& predicted, const std::vector<double>& measured) {
  CurveMiss out;
  double sum = 0.0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (!std::isfinite(predicted[i])) continue;
    sum += std::pow(predicted[i] - measured[i], 2);
    ++out.points;
  }
  if (out.points > 0) out.rmse = std::sqrt(sum / static_cast<double>(out.points));
  return out;
}

/// Velocities from below the first rebound of the largest sphere to above the fastest point.
std::vector<double> velocity_grid(const std::vector<SizeCurve>& sizes, double slowest,
                                  double fastest, int count) {
  double first = slowest;
  double last = fastest;
  for (const SizeCurve& size : sizes) {
    if (!(size.capture_velocity > 0.0)) continue;
    first = std::min(first, 0.8 * size.capture_velocity);
    last = std::max(last, 1.2 * size.capture_velocity);
  }
  last *= 1.1;
  first = std::max(first, 1e-3 * last);
  return log_spaced(first, last, static_cast<std::size_t>(count));
}

}  // namespace

BandedValue banded(double value, std::vector<double> replicates, double level) {
  BandedValue out;
  if (std::isfinite(value)) out.value = value;
  const std::size_t count = replicates.size();
  std::erase_if(replicates, [](double v) { return !std::isfinite(v); });
  const bool enough =
      count >= fewest_replicates(level) &&
      static_cast<double>(replicates.size()) >= share_for_band * static_cast<double>(count);
  if (!out.value || !enough) return out;
  std::sort(replicates.begin(), replicates.end());
  out.lower = sorted_quantile(replicates, (1.0 - level) / 2.0);
  out.upper = sorted_quantile(replicates, (1.0 + level) / 2.0);
  return out;
}

PolydispersePrediction predict_mixture(const FitResult& fitted, std::size_t dataset,
                                       const BootstrapResult& bootstrap, const MeasuredSizes& sizes,
                                       const PolydisperseOptions& options) {
  PolydispersePrediction out;
  out.dataset = dataset;
  out.sizes = sizes;
  out.probe_height = options.probe_height;
  out.slowest_seen = std::sqrt(2.0 * standard_gravity * options.probe_height);
  out.level = options.level;

  std::vector<double> point_velocity;
  std::vector<double> point_restitution;
  double slowest = INFINITY;
  double fastest = 0.0;
  for (const Observation& point : fitted.data.points) {
    if (point.dataset != dataset) continue;
    slowest = std::min(slowest, point.velocity);
    fastest = std::max(fastest, point.velocity);
    if (point.censored) continue;
    point_velocity.push_back(point.velocity);
    point_restitution.push_back(point.restitution);
  }
  const ImpactModel& model = fitted.model;
  const double d10 = sizes.mean_diameter();
  out.size_curves = {{"smallest", sizes.smallest, 0.0, {}},
                     {"d10", d10, 0.0, {}},
                     {"largest", sizes.largest, 0.0, {}}};
  for (SizeCurve& size : out.size_curves) {
    const CaptureVelocity found = capture_velocity(model, fitted.theta, dataset, size.diameter);
    if (found.found) size.capture_velocity = found.value;
  }
  out.velocity = velocity_grid(out.size_curves, slowest, fastest, options.velocities);
  for (SizeCurve& size : out.size_curves) {
    size.restitution = restitution_curve(model, fitted.theta, {dataset, size.diameter},
                                         out.velocity, Effects::of_nature);
  }

  const std::vector<SizeBin> bins = spread_within_bins(sizes.bins, options.parts);
  out.simulated = bins.size();
  const std::vector<Mixture> estimate =
      MixtureFlight(model, dataset, bins, out.velocity, out.slowest_seen).under(fitted.theta);
  out.replicates =
      std::min(bootstrap.theta.size(), static_cast<std::size_t>(std::max(0, options.replicates)));
  std::vector<std::vector<Mixture>> replicates(out.replicates);
  tbb::enumerable_thread_specific<MixtureFlight> flights(
      [&] { return MixtureFlight(model, dataset, bins, out.velocity, out.slowest_seen); });
  {
    Progress progress("mixture", out.replicates);
    parallel_over(out.replicates, options.threads, [&](std::size_t i) {
      replicates[i] = flights.local().under(bootstrap.theta[i]);
      progress.advance();
    });
  }
  for (std::size_t k = 0; k < out.velocity.size(); ++k) {
    const auto band_of = [&](const auto& quantity) {
      std::vector<double> values;
      for (const auto& replicate : replicates) values.push_back(quantity(replicate[k]));
      return banded(quantity(estimate[k]), std::move(values), options.level);
    };
    for (std::size_t c = 0; c < conventions; ++c) {
      out.average[c].push_back(band_of([c](const Mixture& m) { return m.average[c]; }));
    }
    out.captured.push_back(band_of([](const Mixture& m) { return m.captured; }));
    out.unseen.push_back(band_of([](const Mixture& m) { return m.unseen; }));
  }

  if (point_velocity.empty()) return out;
  const std::vector<Mixture> at_points =
      MixtureFlight(model, dataset, bins, point_velocity, out.slowest_seen).under(fitted.theta);
  for (std::size_t c = 0; c < conventions; ++c) {
    std::vector<double> predicted;
    for (const Mixture& m : at_points) predicted.push_back(m.average[c]);
    out.miss[c] = miss(predicted, point_restitution);
  }
  out.miss_single = miss(
      restitution_curve(model, fitted.theta, {dataset, d10}, point_velocity, Effects::of_nature),
      point_restitution);
  return out;
}

}  // namespace recoil
