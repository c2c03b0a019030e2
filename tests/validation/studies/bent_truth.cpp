#include "validation/studies/bent_truth.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/numerics.hpp"
#include "core/random.hpp"
#include "coverage/coverage_truth.hpp"
#include "validation/studies/independent_coverage.hpp"

namespace recoil {
namespace {

/// Spheres of one size of one simulated data set.
class BentSize {
 public:
  BentSize(const Truth& truth, double diameter, const BentTruth& bent, double phase, double sign)
      : truth_(truth), diameter_(diameter), bent_(bent), phase_(phase), sign_(sign) {
    straight_ = true_capture_velocity(truth, diameter);
    const double above = 1.02;
    const double e = true_restitution(truth, diameter, above * straight_);
    slope_ = e * e * above * above / (above * above - 1.0);
  }

  double square(double velocity) const {
    const double x = velocity / straight_;
    double straight = 0.0;
    if (x > 1.0) {
      straight = std::pow(true_restitution(truth_, diameter_, velocity), 2);
    } else {
      straight = slope_ * (x * x - 1.0) / (x * x);
    }
    return 1.0 - (1.0 - straight) * (1.0 + bend(velocity));
  }

  double capture_velocity() const {
    double low = 0.5 * straight_;
    double high = 2.0 * straight_;
    return find_root([&](double velocity) { return square(velocity); }, low, high);
  }

 private:
  double bend(double velocity) const {
    if (bent_.shape == BendShape::other_law) return 0.0;
    if (bent_.shape == BendShape::near_capture) {
      return sign_ * bent_.amplitude * std::min(4.0, std::pow(straight_ / velocity, 2));
    }
    return bent_.amplitude * std::sin(1.3 * std::log(velocity) + phase_);
  }

  Truth truth_;
  double diameter_;
  BentTruth bent_;
  double phase_, sign_, straight_ = 0.0, slope_ = 0.0;
};

/// The spheres of simulation number `index`, by dataset and diameter.
std::map<std::pair<std::size_t, double>, BentSize> sizes_of(
    const ImpactModel& model, const std::vector<Dataset>& datasets, const BentTruth& bent,
    std::span<const double> theta, std::uint64_t seed, std::uint64_t index) {
  RandomStream random(seed, RandomPurpose::diagnosis, index);
  const auto draw = [&] { return 2.0 * std::numbers::pi * random.uniform(); };
  const double shared = draw();
  const double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
  std::map<std::pair<std::size_t, double>, BentSize> sizes;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const double diameter : distinct_diameters(datasets[d])) {
      const double phase = bent.shape == BendShape::by_size ? draw() : shared;
      Truth truth = truth_at(model, theta, d);
      if (bent.shape == BendShape::other_law) {
        truth.law = TrueAdhesion::jkr;
        truth.work = materials_under(model, theta, d).adhesion_energy;
      }
      sizes.emplace(std::pair(d, diameter), BentSize(truth, diameter, bent, phase, sign));
    }
  }
  return sizes;
}

}  // namespace

std::vector<LawDesign> law_designs(const std::filesystem::path& fits) {
  std::vector<LawDesign> designs;
  for (const char* name : {"wall1990-molybdenum", "dahneke1975-quartz", "li1999-sst125-silicon"}) {
    LawDesign design{name, load_fit(fits / (std::string(name) + ".toml")), {}};
    for (const auto& folder : design.spec.datasets) design.datasets.push_back(load_dataset(folder));
    designs.push_back(std::move(design));
  }
  designs.back().C_H = 1e-2;
  Dataset two = designs.front().datasets.front();
  two.id = "polystyrene-silica";
  two.system.particle = {"polystyrene", 1050.0, 3.4e9, 0.33, std::nullopt};
  two.system.surface = {"fused silica", 2200.0, 73e9, 0.17, std::nullopt};
  two.system.stiffness_K.reset();
  two.system.adhesion_force_f0.reset();
  two.system.reference_diameter = 5e-6;
  two.system.errors = {{Body::particle, Constant::youngs_modulus, 0.3e9}};
  Dataset one = designs.front().datasets.front();
  one.id = "ten-points";
  const auto with_points = [&](const Dataset& empty, std::vector<double> diameters) {
    LawDesign design{empty.id, designs.front().spec, {empty}};
    Dataset& made = design.datasets.front();
    made.points.clear();
    const ImpactModel model = make_model(design.spec, design.datasets);
    std::vector<double> theta = model.initial();
    theta[model.slot_C_H[0]] = design.C_H;
    theta[model.slot_C_A[0]] = design.C_A;
    const Truth truth = truth_at(model, theta, 0);
    for (const double diameter : diameters) {
      const double capture = true_capture_velocity(truth, diameter);
      for (const double over : {1.08, 1.2, 1.4, 1.8, 2.5, 4.0, 7.0, 12.0, 20.0, 30.0}) {
        ImpactPoint point;
        point.diameter = diameter;
        point.incident_velocity = over * capture;
        point.restitution = 0.5;
        point.restitution_sd = 0.01;
        made.points.push_back(point);
      }
    }
    designs.push_back(std::move(design));
  };
  with_points(two, {2e-6, 5e-6});
  with_points(one, {4.9e-6});
  for (LawDesign& design : designs) design.spec.uncertainty.materials = Materials::averaged;
  return designs;
}

CoverageTruth bent_truth(const FitSpec& spec, const std::vector<Dataset>& datasets,
                         const BentTruth& bent, std::uint64_t seed) {
  const ImpactModel model = make_model(spec, datasets);
  CoverageTruth truth;
  truth.theta = model.initial();
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    truth.theta[model.slot_C_H[d]] = bent.C_H;
    truth.theta[model.slot_C_A[d]] = bent.C_A;
  }
  const auto captures = [datasets](const auto& sizes) {
    std::vector<CoverageTruth::Capture> all;
    for (std::size_t d = 0; d < datasets.size(); ++d) {
      for (const double diameter : distinct_diameters(datasets[d])) {
        all.push_back({diameter, sizes.at({d, diameter}).capture_velocity()});
      }
    }
    return all;
  };
  truth.capture = true_captures(independent_impacts(model), truth.theta, datasets);
  truth.at = [=, theta = truth.theta](std::uint64_t index) {
    const auto drawn = with_drawn_constants(model, theta, seed, index);
    return CoverageTruth::At{drawn, captures(sizes_of(model, datasets, bent, drawn, seed, index))};
  };
  truth.simulate = [=, theta = truth.theta](std::uint64_t index) {
    const auto drawn = with_drawn_constants(model, theta, seed, index);
    const auto sizes = sizes_of(model, datasets, bent, drawn, seed, index);
    RandomStream noise(seed, RandomPurpose::coverage, index);
    std::vector<Dataset> made = datasets;
    for (std::size_t d = 0; d < made.size(); ++d) {
      for (ImpactPoint& point : made[d].points) {
        double velocity = point.incident_velocity;
        if (point.velocity_sd) velocity += *point.velocity_sd * noise.normal();
        const double square = sizes.at({d, point.diameter}).square(velocity);
        const double sd = point.restitution_sd.value_or(bent.unstated_sd);
        const double z = noise.normal();
        point.counts_only = false;
        point.captured = square > 0.0 ? 0 : point.events;
        point.restitution = square > 0.0 ? std::max(0.0, std::sqrt(square) + sd * z) : 0.0;
        if (point.restitution == 0.0) point.captured = point.events;
      }
    }
    return made;
  };
  return truth;
}

}  // namespace recoil
