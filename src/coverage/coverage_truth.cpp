#include "coverage/coverage_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "core/error.hpp"
#include "core/random.hpp"
#include "coverage/simulated_impacts.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/pooled_deviations.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "estimate/shared_errors.hpp"

namespace recoil {
namespace {

/// A point of the design, to be simulated at the estimate.
struct DesignPoint {
  double restitution = 0.0;  ///< e of the typical impact [1]
  double velocity = 0.0;     ///< its true velocity [m/s]
  double sd = 0.0;           ///< sd of the mean e, stated or estimated [1]
  double own_sd = 0.0;       ///< the part of sd that is not due to differences between impacts [1]
  std::shared_ptr<const TrueCurve> curve;      ///< set if impacts differ and captures were counted
  std::shared_ptr<const TrueMixture> mixture;  ///< set if the point averages over sizes
};

/// The velocity of one impact among impacts that differ in their capture velocity: only V / V*
/// matters.
double differing_velocity(double velocity, double spread, RandomStream& random) {
  return velocity * std::exp(spread * random.normal());
}

/// The variance of the mean e from differences between impacts, averaged over many such points.
/// @param restitution draws e of one impact
double mean_variance(int events, const std::function<double()>& restitution) {
  constexpr int points = 400;
  double sum = 0.0;
  for (int k = 0; k < points; ++k) sum += count_impacts(events, restitution).variance_of_mean;
  return sum / points;
}

/// What the points really were, and what was misread.
struct TrueErrors {
  std::vector<PointConditions> spheres;  ///< with the true V and d of every point
  std::vector<double> of_restitution;    ///< errors of e beside the scatter of the points [1]
  /// The scatter of points that share it, in their standard deviations; NaN for the others.
  std::vector<double> scatter;
};

/// Draws the errors of all sources: an error of V or d moves the sphere, so that its impact is
/// simulated where it really was; what else the error changes is an error of e.
TrueErrors draw_errors(const FitResult& fitted, RandomStream& random) {
  const std::size_t count = fitted.data.points.size();
  TrueErrors errors{fitted.data.conditions(), std::vector<double>(count, 0.0),
                    std::vector<double>(count, NAN)};
  ErrorDraws draws(random);
  for (const ErrorSource* source : fitted.data.sources) {
    for (std::size_t i = 0; i < errors.spheres.size(); ++i) {
      const Observation& point = fitted.data.points[i];
      const double z = draws(*source, point, i);
      if (source->is_scatter()) {
        if (!source->parts(point).empty()) errors.scatter[i] = z;
        continue;
      }
      const InputShift by = source->shift(point);
      errors.spheres[i].velocity *= std::exp(by.velocity * z);
      errors.spheres[i].diameter *= std::exp(by.diameter * z);
      const double square = fitted.prediction_squared[i];
      if (!(square > 0.0)) continue;
      const double direct = source->effect(point, {square, 0.0, 0.0}, fitted.weights.noise);
      errors.of_restitution[i] += z * direct / (2.0 * std::sqrt(square));
    }
  }
  return errors;
}

std::vector<DesignPoint> design_points(const FitResult& fitted,
                                       const std::vector<Dataset>& datasets,
                                       const TrueImpacts& impacts, std::span<const double> theta,
                                       const std::vector<PointConditions>& spheres,
                                       RandomStream& random) {
  const double spread = fitted.weights.noise.event_spread;
  const double reach = std::exp(6.0 * spread);
  std::map<std::pair<std::size_t, double>, double> fastest;
  for (const PointConditions& sphere : spheres) {
    double& most = fastest[{sphere.dataset, sphere.diameter}];
    most = std::max(most, sphere.velocity * reach);
  }
  std::map<std::pair<std::size_t, double>, std::shared_ptr<const TrueCurve>> curves;
  std::vector<DesignPoint> design;
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const Observation& point = fitted.data.points[i];
    const double sd = fitted.weights.points[i].sd;
    PointConditions sphere = spheres[i];
    const double velocity_here = sphere.velocity;
    const double diameter_here = sphere.diameter;
    const auto at_velocity = [&](double velocity) {
      sphere.velocity = velocity;
      return impacts.restitution(theta, sphere);
    };
    DesignPoint made{at_velocity(velocity_here), velocity_here, sd, sd, nullptr, nullptr};
    const auto without = [&](double variance) {
      return std::sqrt(std::max(0.0, sd * sd - variance));
    };
    if (averages_over_sizes(fitted.model, point.dataset)) {
      const auto of_diameter = [&](double diameter) {
        sphere.diameter = diameter;
        return impacts.restitution(theta, sphere);
      };
      made.mixture = std::make_shared<const TrueMixture>(
          of_diameter, *datasets[point.dataset].mixed_sizes, diameter_here, velocity_here);
      made.own_sd =
          without(mean_variance(point.events, [&] { return made.mixture->draw(random); }));
    } else if (spread > 0.0 && point.counted) {
      auto& curve = curves[{point.dataset, diameter_here}];
      if (!curve) {
        curve = std::make_shared<const TrueCurve>(
            at_velocity, impacts.capture_velocity(theta, point.dataset, diameter_here),
            fastest[{point.dataset, diameter_here}]);
      }
      made.curve = curve;
      made.own_sd = without(mean_variance(point.events, [&] {
        return (*curve)(differing_velocity(velocity_here, spread, random));
      }));
    }
    design.push_back(std::move(made));
  }
  return design;
}

/// The sd of a mean as computed from the `impacts` that it averages, if the true one is `sd`.
double sample_deviation(double sd, int impacts, RandomStream& random) {
  double square = 0.0;
  for (int k = 1; k < impacts; ++k) square += std::pow(random.normal(), 2);
  return sd * std::sqrt(square / (impacts - 1));
}

/// Simulates a repeated measurement of the point at the truth.
/// @param other_truth true: the truth differs from the estimate, so that captured points may
///   rebound and the reverse
/// @param shared the scatter that the point shares, in its standard deviations; NaN: it has its own
void simulate_point(const DesignPoint& design, double spread, bool other_truth, bool sd_stated,
                    double shared, RandomStream& random, ImpactPoint& point) {
  const double own = random.normal();
  const double noise = std::isnan(shared) ? own : shared;
  const bool differing = design.curve || design.mixture;
  if (!differing && other_truth) {
    const bool back = design.restitution > 0.0;
    point.captured = back ? 0 : point.events;
    point.restitution = back ? std::max(0.0, design.restitution + design.sd * noise) : 0.0;
    if (back && sd_stated) point.restitution_sd = design.sd;
    return;
  }
  if (!differing) {
    if (!point.all_captured() && !point.counts_only) {
      point.restitution = std::max(0.0, design.restitution + design.sd * noise);
    }
    return;
  }
  const CountedImpacts found = count_impacts(point.events, [&] {
    return design.mixture ? design.mixture->draw(random)
                          : (*design.curve)(differing_velocity(design.velocity, spread, random));
  });
  const bool stated = point.restitution_sd.has_value();
  point.captured = found.captured;
  point.restitution = 0.0;
  point.restitution_sd.reset();
  if (point.all_captured() || point.counts_only) return;
  point.restitution = std::max(0.0, found.restitution + design.own_sd * noise);
  if (stated) {
    point.restitution_sd = std::sqrt(design.own_sd * design.own_sd + found.variance_of_mean);
  }
}

/// The design with the errors, the noise and the counts of simulation number `index`.
std::vector<Dataset> with_noise(const FitResult& fit, std::vector<Dataset> made,
                                const std::vector<DesignPoint>& design, const TrueErrors& errors,
                                bool other_truth, std::uint64_t seed, std::uint64_t index) {
  RandomStream noise(seed, RandomPurpose::coverage, index);
  std::size_t i = 0;
  for (Dataset& dataset : made) {
    for (ImpactPoint& point : dataset.points) {
      simulate_point(design[i], fit.weights.noise.event_spread, other_truth,
                     fit.data.noise.sd_stated, errors.scatter[i], noise, point);
      if (!point.all_captured() && !point.counts_only) {
        point.restitution = std::max(0.0, point.restitution + errors.of_restitution[i]);
        if (fit.weights.noise.pooled_dof > 0 && pools_deviation(fit.data.points[i])) {
          point.restitution_sd = sample_deviation(design[i].sd, point.events, noise);
        }
      }
      ++i;
    }
  }
  return made;
}

}  // namespace

TrueImpacts impacts_of(const ImpactModel& model) {
  TrueImpacts impacts;
  impacts.restitution = [model](TrueImpacts::Theta theta, const PointConditions& sphere) {
    const Prediction answer = predict(model, theta, {sphere}, false).front();
    if (!answer.usable()) {
      throw ComputationError(fmt::format("no truth to simulate at V = {:.4g} m/s: {}",
                                         sphere.velocity, to_string(answer.outcome)));
    }
    return answer.restitution();
  };
  impacts.capture_velocity = [model](TrueImpacts::Theta theta, std::size_t dataset,
                                     double diameter) {
    return capture_velocity(model, theta, dataset, diameter).value;
  };
  return impacts;
}

std::vector<CoverageTruth::Capture> true_captures(const TrueImpacts& impacts,
                                                  std::span<const double> theta,
                                                  const std::vector<Dataset>& datasets) {
  std::vector<CoverageTruth::Capture> captures;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const double diameter : distinct_diameters(datasets[d])) {
      captures.push_back({diameter, impacts.capture_velocity(theta, d, diameter)});
    }
  }
  return captures;
}

std::vector<double> with_drawn_constants(const ImpactModel& model, std::vector<double> theta,
                                         std::uint64_t seed, std::uint64_t index) {
  RandomStream random(seed, RandomPurpose::constants, ~index);
  for (std::size_t k = 0; k < model.constants.size(); ++k) {
    const UncertainConstant& constant = model.constants[k];
    const std::size_t slot = model.first_constant() + k;
    const double value = constant.moved(constant.stated, random.normal());
    theta[slot] = std::clamp(value, model.slots[slot].lower, model.slots[slot].upper);
  }
  return theta;
}

std::vector<Dataset> simulate_at(const FitResult& fitted, const std::vector<Dataset>& datasets,
                                 const TrueImpacts& impacts, std::span<const double> theta,
                                 std::uint64_t seed, std::uint64_t index) {
  RandomStream of_sources(seed, RandomPurpose::settings, index);
  const TrueErrors errors = draw_errors(fitted, of_sources);
  RandomStream own(seed, RandomPurpose::coverage, ~index);
  const auto design = design_points(fitted, datasets, impacts, theta, errors.spheres, own);
  return with_noise(fitted, datasets, design, errors, true, seed, index);
}

CoverageTruth coverage_truth(const FitSpec& spec, const std::vector<Dataset>& datasets,
                             std::uint64_t seed, const MakeImpacts& make_impacts) {
  const FitResult fitted = fit(make_model(spec, datasets), gather(datasets, spec));
  if (!fitted.usable) throw ComputationError("no truth to simulate: " + fitted.failure);
  return coverage_truth(fitted, datasets, seed, make_impacts);
}

CoverageTruth coverage_truth(const FitResult& fitted, const std::vector<Dataset>& datasets,
                             std::uint64_t seed, const MakeImpacts& make_impacts) {
  const TrueImpacts impacts = make_impacts(fitted.model);
  CoverageTruth truth;
  truth.origin = TruthOrigin::estimate;
  truth.theta = fitted.theta;
  truth.capture = true_captures(impacts, fitted.theta, datasets);
  RandomStream random(seed, RandomPurpose::coverage, ~std::uint64_t{0});
  const auto known = std::make_shared<const std::vector<DesignPoint>>(
      design_points(fitted, datasets, impacts, fitted.theta, fitted.data.conditions(), random));
  truth.simulate = [datasets, seed, known, impacts, fit = fitted](std::uint64_t index) {
    if (!fit.model.constants.empty() || !fit.data.sources.empty()) {
      const auto theta = with_drawn_constants(fit.model, fit.theta, seed, index);
      return simulate_at(fit, datasets, impacts, theta, seed, index);
    }
    RandomStream none(seed, RandomPurpose::settings, index);
    return with_noise(fit, datasets, *known, draw_errors(fit, none), false, seed, index);
  };
  if (!fitted.model.constants.empty()) {
    truth.at = [datasets, seed, impacts, fit = fitted](std::uint64_t index) {
      const auto theta = with_drawn_constants(fit.model, fit.theta, seed, index);
      return CoverageTruth::At{theta, true_captures(impacts, theta, datasets)};
    };
  }
  return truth;
}

}  // namespace recoil
