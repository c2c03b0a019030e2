// The descents of a search for causes find the strength of a mechanism, whatever its size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/candidate.hpp"
#include "estimate/predictor.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

constexpr int tries = 4;

Refit found(const Candidate& candidate, const std::vector<Dataset>& datasets) {
  const Observations points = gather(datasets);
  return refit_candidate(candidate, points, first_weights(points), candidate.model.initial(),
                         tries);
}

TEST(FoundStrength, OfAHiddenCharge) {
  // With g = 2 U / m = (3/2) eps0 E_s^2 / rho the sphere arrives with V_c^2 = V^2 + g and leaves
  // with e^2 V^2 = e_0^2 V_c^2 - g; e_0 is that of the simulator of the truths.
  synthetic::Design design;
  design.diameters = {0.99e-6};
  design.velocities = {40.0, 65.0, 100.0, 160.0, 250.0};
  design.sd = 1e-4;
  for (const double field : {3.2e7, 1.8e8, 2.9e8}) {
    std::vector<Dataset> datasets = {synthetic::dataset(design)};
    datasets[0].system.conditions.set(Condition::ambient_pressure, 1e-3);
    const double gained = 1.5 * 8.8541878128e-12 * field * field / 1350.0;
    for (ImpactPoint& point : datasets[0].points) {
      const double square = point.incident_velocity * point.incident_velocity;
      const double e =
          true_restitution(synthetic::truth_of(design), point.diameter, std::sqrt(square + gained));
      point.restitution = std::sqrt((e * e * (square + gained) - gained) / square);
    }
    const Candidate candidate =
        make_candidate(synthetic::spec(), datasets, {"electrostatic_image"}, false, true);
    const Refit refit = found(candidate, datasets);
    ASSERT_TRUE(refit.usable);
    EXPECT_NEAR(refit.theta[3] / field, 1.0, 1e-2);
  }
}

TEST(FoundStrength, OfEveryMechanismInEveryDecadeOfItsPlausibleRange) {
  synthetic::Design design;
  design.sd = 1e-3;
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    const std::string id(mechanism.info.id);
    std::vector<Dataset> datasets = {synthetic::dataset(design)};
    const Candidate candidate = make_candidate(synthetic::spec(), datasets, {id}, false, true);
    const ImpactModel& model = candidate.model;
    const AllowedValues allowed = allowed_values(candidate, model.initial(), 3);
    if (!std::isnormal(allowed.upper)) continue;  // such spheres have none of it
    for (double value = 0.7 * allowed.upper; value > std::max(allowed.lower, 1e-6 * allowed.upper);
         value *= 0.1) {
      std::vector<double> theta = model.initial();
      theta[3] = value;
      for (ImpactPoint& point : datasets[0].points) {
        const double square =
            predict(model, theta, 0, point.diameter, point.incident_velocity, false)
                .restitution_squared;
        point.restitution = std::sqrt(std::max(square, 0.0));
        point.captured = square > 0.0 ? 0 : 1;
      }
      const Refit refit = found(candidate, datasets);
      ASSERT_TRUE(refit.usable) << id << ' ' << value;
      EXPECT_LT(refit.chi2, 0.1) << id << ' ' << value;
    }
  }
}

}  // namespace
}  // namespace recoil
