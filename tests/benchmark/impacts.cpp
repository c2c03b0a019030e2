#include "impacts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/error.hpp"
#include "core/random.hpp"
#include "design.hpp"
#include "impact/impact.hpp"

namespace recoil::bench {
namespace {

constexpr std::uint64_t impact_seed = 3;

/// A shipped fit of one dataset with its estimates.
struct ShippedFit {
  Case the_case;
  std::vector<double> theta;
  double slowest = 0.0;
  double fastest = 0.0;
};

std::vector<ShippedFit> shipped_fits(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(root / "fits")) {
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<ShippedFit> fits;
  for (const std::filesystem::path& file : files) {
    ShippedFit shipped{load_case(file), {}, 0.0, 0.0};
    if (shipped.the_case.datasets.size() != 1) continue;  // its datasets have fits of their own
    const auto& points = shipped.the_case.data.points;
    const auto [slowest, fastest] =
        std::minmax_element(points.begin(), points.end(),
                            [](const auto& a, const auto& b) { return a.velocity < b.velocity; });
    shipped.slowest = slowest->velocity;
    shipped.fastest = fastest->velocity;
    FitOptions options;
    options.several_starts = false;
    const FitResult fitted = fit(shipped.the_case.model, shipped.the_case.data, options);
    if (!fitted.usable) throw ComputationError(file.string() + ": " + fitted.failure);
    shipped.theta = fitted.theta;
    // A damping that rests on zero would leave half of the equation idle.
    for (std::size_t j = 0; j < shipped.theta.size(); ++j) {
      if (fitted.at_bound[j]) shipped.theta[j] = shipped.the_case.model.slots[j].initial;
    }
    fits.push_back(std::move(shipped));
  }
  return fits;
}

double between(RandomStream& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

Json range_of(std::vector<double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

}  // namespace

std::vector<ImpactGroups> representative_impacts(const std::filesystem::path& root,
                                                 std::size_t count) {
  const std::vector<ShippedFit> fits = shipped_fits(root);
  std::vector<ImpactGroups> impacts;
  for (std::size_t i = 0; i < count; ++i) {
    RandomStream random(impact_seed, RandomPurpose::reconstruction, i);
    const ShippedFit& from = fits[random.below(fits.size())];
    const auto& points = from.the_case.data.points;
    const double diameter = points[random.below(points.size())].diameter;
    const double velocity = between(random, 0.6 * from.slowest, from.fastest);
    std::vector<double> theta = from.theta;
    theta[from.the_case.model.slot_C_H[0]] *= between(random, 0.5, 2.0);
    theta[from.the_case.model.slot_C_A[0]] *= between(random, 0.5, 2.0);
    impacts.push_back(
        impact_groups(conditions_at(from.the_case.model, theta, 0, diameter, velocity)));
  }
  return impacts;
}

void run_fast(const std::vector<ImpactGroups>& impacts, AdhesionLaw law, bool gradient,
              std::vector<ImpactResult>& results) {
  ImpactOptions options;
  options.adhesion = law;
  options.gradient = gradient;
  results.resize(impacts.size());
  simulate_impacts_fast(impacts, options, results);
}

void run_reference(const std::vector<ImpactGroups>& impacts, AdhesionLaw law, bool gradient,
                   std::vector<ImpactResult>& results) {
  ImpactOptions options;
  options.adhesion = law;
  options.gradient = gradient;
  results.resize(impacts.size());
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    results[i] = simulate_impact(impacts[i], options);
  }
}

Json describe_impacts(const std::vector<ImpactGroups>& impacts) {
  ImpactOptions options;
  options.gradient = true;
  std::vector<ImpactResult> fast(impacts.size());
  std::vector<ImpactResult> reference;
  const long handovers = simulate_impacts_fast(impacts, options, fast);
  run_reference(impacts, AdhesionLaw::ring, true, reference);

  std::vector<double> velocity, alpha, gamma;
  int captured = 0;
  double difference = 0.0;
  double gradient_difference = 0.0;
  const auto worse = [](double old, double a, double b) {
    return std::max(old, std::abs(a - b) / std::max(1.0, std::abs(b)));
  };
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    if (!fast[i].usable() || !reference[i].usable()) {
      throw ComputationError("an impact of the benchmark's set has no answer");
    }
    velocity.push_back(std::pow(impacts[i].beta, -1.25));
    alpha.push_back(impacts[i].alpha);
    gamma.push_back(impacts[i].gamma);
    if (reference[i].outcome == ImpactOutcome::captured) ++captured;
    difference = worse(difference, fast[i].restitution_squared, reference[i].restitution_squared);
    for (std::size_t j = 0; j < 3; ++j) {
      gradient_difference =
          worse(gradient_difference, fast[i].gradient[j], reference[i].gradient[j]);
    }
  }
  return {{"impacts", impacts.size()},
          {"captured", captured},
          {"velocity_over_adhesion_velocity", range_of(velocity)},
          {"C_H_V", range_of(alpha)},
          {"C_A_V", range_of(gamma)},
          {"reference_tolerance", ImpactOptions().tolerance},
          {"handed_over_to_reference", handovers},
          {"largest_difference", difference},
          {"largest_gradient_difference", gradient_difference}};
}

}  // namespace recoil::bench
