#include "validation/studies/coverage_noise.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/random.hpp"
#include "core/statistics.hpp"
#include "coverage/simulated_impacts.hpp"
#include "estimate/fit.hpp"
#include "report/words_fit.hpp"
#include "validation/studies/rank_study.hpp"
#include "validation/truth/truth.hpp"

namespace recoil {
namespace {

constexpr double true_C_H = 0.0025, true_C_A = 0.05;        // [s/m]
constexpr double diameters[] = {4.9e-6, 2.58e-6, 6.89e-6};  // [m]
constexpr double second_noise = 3.0;                        // of the second target

/// The truth on one target: ammonium fluorescein on molybdenum or, as the second, on silicon.
struct Target {
  Dataset empty;
  Truth truth;
  std::vector<TrueCurve> curves;  // of the sizes
};

Target target_of(const NoiseDesign& design, int number) {
  Target target;
  target.empty = fluorescein_on_molybdenum();
  if (number == 1) target.empty.system.surface = {"silicon", 0.0, 170e9, 0.28, std::nullopt};
  target.empty.id = fmt::format("target-{}", number + 1);
  const ImpactSystem& system = target.empty.system;
  target.truth = undamped_truth(system.particle, system.surface, *system.reference_diameter);
  target.truth.C_H = true_C_H;
  target.truth.C_A = true_C_A;
  if (design.jkr) {
    target.truth.law = TrueAdhesion::jkr;
    target.truth.work = derive_recipe_contact(system.particle, system.surface).adhesion_energy;
  }
  for (int s = 0; s < design.sizes; ++s) {
    const double capture = true_capture_velocity(target.truth, diameters[s]);
    target.curves.emplace_back(
        [&](double velocity) { return true_restitution(target.truth, diameters[s], velocity); },
        capture, 1.5 * design.fastest * capture);
    target.empty.series.push_back(fmt::format("{}", s + 1));
  }
  return target;
}

double reading_sd(const NoiseDesign& design, double capture, double velocity, std::size_t target) {
  const double nearness = std::pow(capture / velocity, 2);
  return design.sd * (target == 0 ? 1.0 : second_noise) * (1.0 + (design.growth - 1.0) * nearness);
}

/// A row of the data: the mean of impacts, each read with its own error.
/// @param height error of V / V stated; `offset` of e; `restitution` e of the size of this row
template <class Restitution>
void read_row(const NoiseDesign& design, double height, double offset, double sd,
              const Restitution& restitution, RandomStream& random, ImpactPoint& point) {
  const double span = std::log(static_cast<double>(design.most_events) / design.fewest_events);
  point.events =
      static_cast<int>(std::lround(design.fewest_events * std::exp(span * random.uniform())));
  point.counted = design.spread > 0.0;
  std::vector<double> readings;
  for (int k = 0; k < point.events; ++k) {
    const double velocity = point.incident_velocity * (1.0 + height);
    const double e = restitution(velocity * std::exp(design.spread * random.normal()));
    const double error = sd * random.normal() + offset;
    if (e > 0.0) readings.push_back(std::max(0.0, e * (1.0 + height) + error));
  }
  point.captured = point.events - static_cast<int>(readings.size());
  if (readings.empty()) return;
  const double count = static_cast<double>(readings.size());
  for (const double e : readings) point.restitution += e / count;
  if (!design.stated) return;
  point.restitution_sd =
      (design.of_sample ? recoil::standard_deviation(readings) : sd) / std::sqrt(count);
}

std::vector<Dataset> made_data(const NoiseDesign& design, const std::vector<Target>& targets,
                               RandomStream& random) {
  std::vector<Dataset> all;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    Dataset data = targets[t].empty;
    for (std::size_t s = 0; s < targets[t].curves.size(); ++s) {
      const double diameter = diameters[s];
      const double true_diameter = diameter * (1.0 + design.batch_sd * random.normal());
      const double capture = true_capture_velocity(targets[t].truth, diameter);
      const auto restitution = [&](double velocity) {
        return design.batch_sd > 0.0 ? true_restitution(targets[t].truth, true_diameter, velocity)
                                     : targets[t].curves[s](velocity);
      };
      for (int i = 0; i < design.velocities; ++i) {
        const double velocity =
            capture * design.slowest *
            std::pow(design.fastest / design.slowest, i / (design.velocities - 1.0));
        const double height = 0.5 * design.height_sd * random.normal();  // V ~ h^(1/2)
        const double offset = design.setting_sd * random.normal();
        for (int r = 0; r < design.rows; ++r) {
          ImpactPoint point;
          point.series = s;
          point.diameter = diameter;
          point.incident_velocity = velocity;
          if (design.rows > 1) point.setting = fmt::format("{} {}", s, i);
          if (design.height_stated) point.setting_velocity_sd = 0.5 * design.height_sd * velocity;
          if (design.batch_sd > 0.0) point.series_diameter_sd = design.batch_sd * diameter;
          read_row(design, height, offset, reading_sd(design, capture, velocity, t), restitution,
                   random, point);
          data.points.push_back(point);
        }
      }
    }
    all.push_back(std::move(data));
  }
  return all;
}

FitSpec noise_spec(const NoiseDesign& design) {
  FitSpec spec;
  spec.id = "noise";
  spec.uncertainty.materials = Materials::exact;
  for (const Parameter& parameter : base_parameters()) {
    ParameterSpec& own = spec.parameters.emplace_back(default_of(parameter));
    own.per_dataset = design.targets > 1 && parameter.name == "C_A";
  }
  return spec;
}

/// The truth of a design, and its data sets.
CoverageTruth noise_truth(const NoiseDesign& design, std::uint64_t seed) {
  auto targets = std::make_shared<std::vector<Target>>();
  for (int t = 0; t < design.targets; ++t) targets->push_back(target_of(design, t));
  CoverageTruth truth;
  truth.origin = TruthOrigin::recipe;
  truth.simulate = [design, targets, seed](std::uint64_t index) {
    RandomStream random(seed, RandomPurpose::coverage, index);
    return made_data(design, *targets, random);
  };
  const ImpactModel model = make_model(noise_spec(design), truth.simulate(0));
  truth.theta = model.initial();
  for (std::size_t t = 0; t < targets->size(); ++t) {
    truth.theta[model.slot_C_H[t]] = true_C_H;
    truth.theta[model.slot_C_A[t]] = true_C_A;
    for (const double diameter : distinct_diameters(truth.simulate(0)[t])) {
      truth.capture.push_back({diameter, true_capture_velocity((*targets)[t].truth, diameter)});
    }
  }
  return truth;
}

std::string noise_key(const NoiseDesign& design, const CoverageOptions& options) {
  return fmt::format("noise {} {} {} {}", design.name, options.datasets,
                     options.uncertainty.replicates, options.uncertainty.seed);
}

}  // namespace

const std::vector<NoiseDesign>& noise_designs() {
  static const std::vector<NoiseDesign> all = [] {
    const NoiseDesign singles{.velocities = 60, .slowest = 0.7, .fastest = 10.0, .spread = 0.1};
    const NoiseDesign settings{.velocities = 5, .rows = 8, .sd = 0.01, .setting_sd = 0.015};
    const NoiseDesign heights{.velocities = 5, .rows = 8, .sd = 0.01, .height_sd = 0.03};
    const NoiseDesign batches{.sd = 0.01, .batch_sd = 0.03};
    const NoiseDesign samples{.sd = 0.03, .of_sample = true, .warning = "average fewer than"};
    std::vector<NoiseDesign> designs;
    const auto add = [&](std::string_view name, const NoiseDesign& design) -> NoiseDesign& {
      designs.push_back(design);
      designs.back().name = name;
      return designs.back();
    };
    const auto add_samples = [&](std::string_view name, int fewest, int most) {
      NoiseDesign& design = add(name, samples);
      design.fewest_events = fewest;
      design.most_events = most;
    };
    add("single impacts, captures, sd not stated", singles).stated = false;
    add("single impacts, captures, sd stated", singles).warning = "larger than the stated noise";
    add("5 settings, error of e, sd not stated", settings).stated = false;
    add("5 settings, error of e, sd stated", settings);
    for (const bool known : {false, true}) {
      for (const bool stated : {false, true}) {
        NoiseDesign& design = add(known    ? stated ? "5 heights, error stated, sd stated"
                                                    : "5 heights, error stated, sd not stated"
                                  : stated ? "5 heights, error not stated, sd stated"
                                           : "5 heights, error not stated, sd not stated",
                                  heights);
        design.stated = stated;
        design.height_stated = known;
        if (!known) design.warning = "share an error of this velocity";
      }
    }
    NoiseDesign& three = add("3 batches of 9 points, error of the size", batches);
    three.sizes = 3;
    three.velocities = 9;
    add("1 batch of 18 points, error of the size", batches).velocities = 18;
    add_samples("sd from 3 to 6 events", 3, 6);
    add_samples("sd from 3 to 60 events", 3, 60);
    add_samples("sd from 10 to 40 events", 10, 40);
    add("3 sizes of 8 points of 20 events, captures", {.stated = false,
                                                       .sizes = 3,
                                                       .velocities = 8,
                                                       .slowest = 0.85,
                                                       .fewest_events = 20,
                                                       .most_events = 20,
                                                       .sd = 0.03,
                                                       .spread = 0.08});
    add("2 targets, one three times noisier", {.stated = false, .targets = 2, .sd = 0.01}).warning =
        "one scale of the noise";
    add("jkr data fitted with ring", {.sizes = 3, .velocities = 12, .sd = 0.01, .jkr = true});
    add("3 sizes of 9 points, noise fivefold at capture",
        {.stated = false, .sizes = 3, .velocities = 9, .sd = 0.01, .growth = 5.0});
    return designs;
  }();
  return all;
}

CoverageResult measure_noise(const NoiseDesign& design, const CoverageOptions& options) {
  const FitSpec spec = noise_spec(design);
  const CoverageTruth truth = noise_truth(design, options.uncertainty.seed);
  std::vector<CoverageTrial> trials(static_cast<std::size_t>(options.datasets));
  Progress progress(std::string(design.name), trials.size());
  parallel_over(trials.size(), options.uncertainty.threads, [&](std::size_t i) {
    CoverageTrial& trial = trials[i] = run_coverage_trial(spec, truth, options, i);
    progress.advance();
    if (design.warning.empty()) return;
    const std::vector<Dataset> data = truth.simulate(i);
    const auto warnings = fit_warnings(fit(make_model(spec, data), gather(data, spec)));
    const bool warned = std::any_of(warnings.begin(), warnings.end(), [&](const Sentence& one) {
      return plain_text(one).find(design.warning) != std::string::npos;
    });
    for (auto* rows : {&trial.parameters, &trial.capture}) {
      for (CoverageTrial::Row& row : *rows) row.identifiable = row.identifiable && !warned;
    }
  });
  CoverageResult result = count_coverage(spec, truth, options, trials);
  // Another law has no true C_H and C_A of this one.
  if (design.jkr) {
    std::erase_if(result.rows,
                  [](const CoverageRow& row) { return !row.parameter.starts_with("V*"); });
  }
  return result;
}

CoverageStudy study_noise(const CoverageOptions& options, const std::filesystem::path& kept) {
  CoverageStudy study;
  study.exact_materials = true;
  for (const NoiseDesign& design : noise_designs()) {
    add_measured(study, std::string(design.name), options, kept, noise_key(design, options),
                 [&] { return measure_noise(design, options); });
  }
  return study;
}

}  // namespace recoil
