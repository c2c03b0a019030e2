#include "validation/studies/coverage_grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "core/random.hpp"
#include "coverage/simulated_impacts.hpp"
#include "validation/studies/independent_coverage.hpp"

namespace recoil {
namespace {

constexpr double lowest = 1.05;           // of the capture velocity, without captures
constexpr double lowest_captured = 0.85;  // with captures
constexpr double highest = 50.0;
constexpr int impacts_per_point = 40;
constexpr double velocity_scatter = 0.03;  // of the impacts that one point averages

double standard_deviation(GridNoise noise, double e, double velocity_ratio) {
  switch (noise) {
    case GridNoise::equal:
      return 0.02;
    case GridNoise::near_capture:
      return 0.01 * (1.0 + 4.0 / (velocity_ratio * velocity_ratio));
    case GridNoise::proportional:
      return 0.1 * e;
  }
  return 0.0;
}

/// One point as an experiment would find it.
ImpactPoint measured_point(const TrueCurve& curve, const GridDesign& design, double diameter,
                           double velocity, double capture, RandomStream& random) {
  ImpactPoint point;
  point.diameter = diameter;
  point.incident_velocity = velocity;
  double e = curve(velocity);
  double variance_of_mean = 0.0;
  if (design.captures) {
    const CountedImpacts found = count_impacts(impacts_per_point, [&] {
      return curve(velocity * (1.0 + velocity_scatter * random.normal()));
    });
    point.events = impacts_per_point;
    point.counted = true;
    point.captured = found.captured;
    if (found.captured == impacts_per_point) return point;
    e = found.restitution;
    variance_of_mean = found.variance_of_mean;
  }
  const double sd = standard_deviation(design.noise, e, velocity / capture);
  point.restitution = std::clamp(e + sd * random.normal(), 0.0, 1.2);
  if (design.sd_stated) point.restitution_sd = std::sqrt(sd * sd + variance_of_mean);
  return point;
}

}  // namespace

std::string GridDesign::name() const {
  return fmt::format("n{} {} {} {}{}", points, to_string(noise), sd_stated ? "stated" : "estimated",
                     adhesion_free ? "f0-free" : "f0-fixed", captures ? " captures" : "");
}

std::vector<GridDesign> coverage_grid() {
  std::vector<GridDesign> designs;
  for (const int points : {10, 20, 60}) {
    for (const GridNoise noise :
         {GridNoise::equal, GridNoise::near_capture, GridNoise::proportional}) {
      for (const bool sd_stated : {true, false}) {
        for (const bool adhesion_free : {false, true}) {
          for (const bool captures : {false, true}) {
            designs.push_back({points, noise, sd_stated, adhesion_free, captures});
          }
        }
      }
    }
  }
  return designs;
}

std::vector<GridDesign> designs_named(const std::vector<std::string>& words) {
  const auto has = [](const GridDesign& design, const std::string& word) {
    return fmt::format(" {} ", design.name()).find(fmt::format(" {} ", word)) != std::string::npos;
  };
  std::vector<GridDesign> left = coverage_grid();
  const std::vector<std::string> known = {"n10",          "n20",     "n60",     "equal",
                                          "near-capture", "10 %",    "stated",  "estimated",
                                          "f0-fixed",     "f0-free", "captures"};
  for (const std::string& word : words) {
    const std::vector<GridDesign> all = coverage_grid();
    if (std::none_of(all.begin(), all.end(), [&](const GridDesign& d) { return has(d, word); })) {
      const std::string near = nearest_word(word, known);
      throw InputError(
          {}, fmt::format("--designs: no design has the word '{}'", word),
          fmt::format("the words are {}", fmt::join(known, ", ")),
          near.empty() ? "take words of this list" : fmt::format("did you mean '{}'?", near));
    }
    std::erase_if(left, [&](const GridDesign& design) { return !has(design, word); });
  }
  if (left.empty()) {
    throw InputError({}, fmt::format("--designs: no design is all of {}", fmt::join(words, ", ")),
                     "a design has one number of points, one kind of scatter and so on",
                     "leave one of them out");
  }
  return left;
}

FitSpec grid_spec(const FitSpec& spec, const GridDesign& design) {
  FitSpec own = spec;
  own.uncertainty.materials = Materials::exact;  // one truth for all data sets
  for (ParameterSpec& parameter : own.parameters) {
    if (parameter.parameter->role != ParameterRole::adhesion_force) continue;
    parameter.free = design.adhesion_free;
    if (parameter.free && !(parameter.upper > parameter.lower)) {
      parameter.lower = 1e-6;
      parameter.upper = 1e6;
    }
  }
  return own;
}

CoverageTruth grid_truth(const FitSpec& spec, const Dataset& base, const GridDesign& design,
                         std::uint64_t seed) {
  // With f0 free the fit ends at C_A = 0, at its bound, where no interval of C_A can be judged.
  GridDesign fixed = design;
  fixed.adhesion_free = false;
  const FitSpec exact = grid_spec(spec, fixed);
  const FitResult fitted = fit(make_model(exact, {base}), gather({base}, exact));
  if (!fitted.usable) throw ComputationError("no truth to simulate: " + fitted.failure);
  const Truth truth = truth_at(fitted.model, fitted.theta, 0);
  CoverageTruth study;
  study.origin = TruthOrigin::estimate;
  study.theta = fitted.theta;
  const std::vector<double> diameters = distinct_diameters(base);
  const double diameter = diameters[diameters.size() / 2];
  const double capture = true_capture_velocity(truth, diameter);
  study.capture = {{diameter, capture}};
  Dataset empty = base;
  empty.points.clear();
  empty.series = {"simulated"};
  const auto curve = std::make_shared<const TrueCurve>(
      [&](double velocity) { return true_restitution(truth, diameter, velocity); }, capture,
      1.3 * highest * capture);
  study.simulate = [empty, design, seed, diameter, capture, curve](std::uint64_t index) {
    RandomStream random(seed, RandomPurpose::coverage, index);
    Dataset made = empty;
    const double first = design.captures ? lowest_captured : lowest;
    for (int i = 0; i < design.points; ++i) {
      const double velocity =
          capture * first * std::pow(highest / first, i / (design.points - 1.0));
      made.points.push_back(measured_point(*curve, design, diameter, velocity, capture, random));
    }
    return std::vector<Dataset>{made};
  };
  return study;
}

}  // namespace recoil
