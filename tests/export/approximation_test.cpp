// Is the value that an approximation takes the best one, and is its error the true one?
#include "export/approximation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "jkr_by_time.hpp"
#include "support/synthetic.hpp"

namespace {

using namespace recoil;

ExportedImpact example(const std::vector<std::string>& mechanisms = {}) {
  FitSpec spec = synthetic::spec();
  spec.mechanisms = mechanisms;
  if (!mechanisms.empty()) {
    spec.parameters.clear();
    for (const Parameter* parameter : parameters_with(mechanisms)) {
      spec.parameters.push_back(default_of(*parameter));
    }
  }
  const ImpactModel model = make_model(spec, {synthetic::dataset({})});
  return exported_impact(model, model.initial(), {0, 4.9e-6, 1.5, 60.0});
}

TEST(Approximation, TheConstantRestitutionIsTheMeanOverLogVelocity) {
  const ExportedImpact impact = example();
  ASSERT_EQ(impact.velocity.size(), error_velocities);
  EXPECT_NEAR(impact.velocity[1] / impact.velocity[0], impact.velocity[150] / impact.velocity[149],
              1e-12);
  double mean = 0.0;
  for (const double e : impact.restitution) mean += e / error_velocities;
  double square = 0.0;
  double largest = 0.0;
  for (const double e : impact.restitution) {
    square += (e - mean) * (e - mean) / error_velocities;
    largest = std::max(largest, std::abs(e - mean));
  }
  const Approximation found = nearest(StockModel::constant_restitution, impact);
  EXPECT_NEAR(found.value, mean, 1e-12);
  EXPECT_NEAR(found.error.rms, std::sqrt(square), 1e-12);
  EXPECT_NEAR(found.error.largest, largest, 1e-12);
}

TEST(Approximation, NoOtherValueIsNearer) {
  const ExportedImpact impact = example();
  const Approximation found = nearest(StockModel::hertz_dashpot, impact);
  for (const double factor : {0.9, 0.99, 1.01, 1.1}) {
    Approximation other = found;
    other.value *= factor;
    const auto e = restitution_under(force_of(other, impact), impact.velocity);
    EXPECT_GE(restitution_error(impact, e).rms, found.error.rms - 1e-9) << factor;
  }
}

TEST(Approximation, TheStockJkrHasTheStatedErrorAndKeepsTheCapture) {
  const ExportedImpact impact = example();
  ASSERT_TRUE(impact.captures);
  const Approximation found = nearest_stock(ExportTarget::lammps, impact);
  ASSERT_EQ(found.model, StockModel::jkr);
  const ContactForce& f = impact.force;
  const JkrByTime contact = {f.radius, f.mass(), 0.75 * f.stiffness, found.value, found.energy};
  std::vector<double> e;
  for (const double v : impact.velocity) {
    e.push_back(contact.restitution(v, 500));
    const double square = impact_under(jkr_of(found, impact), v).restitution_squared;
    EXPECT_NEAR(std::sqrt(std::max(square, 0.0)), e.back(), 1e-4) << v;
  }
  const RestitutionError error = restitution_error(impact, e);
  EXPECT_NEAR(found.error.rms, error.rms, 1e-5);
  EXPECT_NEAR(found.error.largest, error.largest, 1e-4);
  EXPECT_EQ(contact.restitution(0.99 * found.capture_velocity), 0.0);
  EXPECT_GT(contact.restitution(1.01 * found.capture_velocity), 0.0);
  EXPECT_LT(error.rms, nearest(StockModel::hertz_dashpot, impact).error.rms);
  for (const double factor : {0.8, 1.25}) {
    for (const bool energy : {false, true}) {
      JkrByTime other = contact;
      (energy ? other.gamma : other.eta) *= factor;
      e.clear();
      for (const double v : impact.velocity) e.push_back(other.restitution(v, 500));
      EXPECT_GT(restitution_error(impact, e).rms, error.rms) << factor << energy;
    }
  }
}

TEST(Approximation, TheStockJkrFindsTheContactThatThereIs) {
  ExportedImpact impact = example();
  const ContactForce& f = impact.force;
  const JkrByTime truth = {f.radius, f.mass(), 0.75 * f.stiffness, 3e13, 0.2};
  for (std::size_t k = 0; k < error_velocities; ++k) {
    impact.restitution[k] = truth.restitution(impact.velocity[k], 500);
  }
  const Approximation found = nearest_stock(ExportTarget::lammps, impact);
  EXPECT_NEAR(found.value / 3e13, 1.0, 1e-3);
  EXPECT_NEAR(found.energy / 0.2, 1.0, 1e-3);
  EXPECT_LT(found.error.largest, 1e-3);
}

// e^2 = 1 - 2 loss / (m V^2). From n = 0 to where it parts, elastic and adhesive energy change by
// [4 (z^10 / 10 - z^7 + 3 z^4 / 2)] K a_p^3 u / R between z = 4^(1/3) and 3^(1/3), z^2 = a / a_p.
TEST(Approximation, AnUndampedStockJkrLosesTheWorkBetweenFormingAndParting) {
  const ContactForce f = example().force;
  const StockJkr contact = {f.radius, f.mass(), f.stiffness, 0.0, 0.1};
  const double R = f.radius;
  const double cube = M_PI * 0.1 * R * R / (3.0 * f.stiffness);
  const double unit = f.stiffness * cube * std::cbrt(cube * cube) / (R * R);
  const auto energy = [](double z) {
    return 4.0 * (std::pow(z, 10) / 10.0 - std::pow(z, 7) + 1.5 * std::pow(z, 4));
  };
  const double loss = unit * (energy(std::cbrt(3.0)) - energy(std::cbrt(4.0)));
  for (const double V : {0.3, 2.0, 40.0}) {
    EXPECT_NEAR(impact_under(contact, V).restitution_squared, 1.0 - 2.0 * loss / (f.mass() * V * V),
                1e-7)
        << V;
  }
}

TEST(Approximation, WithoutAdhesionTheStockModelIsHertz) {
  ExportedImpact impact = example();
  impact.force.adhesion_energy = impact.force.adhesion_force = 0.0;
  EXPECT_EQ(nearest_stock(ExportTarget::lammps, impact).model, StockModel::hertz_dashpot);
  EXPECT_EQ(nearest_stock(ExportTarget::yade, impact).model, StockModel::constant_restitution);
}

TEST(Approximation, AForceIsExactAndAnEnergyIsNot) {
  EXPECT_TRUE(example().force_is_all);
  EXPECT_TRUE(example({"bulk_viscoelastic"}).force_is_all);
  EXPECT_TRUE(example({"size_law"}).force_is_all);
  EXPECT_FALSE(example({"elastic_waves"}).force_is_all);
  EXPECT_EQ(form_for(ExportTarget::lammps, example({"elastic_waves"})), ExportForm::refitted);
  EXPECT_EQ(form_for(ExportTarget::lammps, example({"elastic_waves"}), true),
            ExportForm::approximation);
  EXPECT_EQ(form_for(ExportTarget::lammps, example()), ExportForm::force);
  EXPECT_EQ(form_for(ExportTarget::liggghts, example()), ExportForm::approximation);
  EXPECT_EQ(form_for(ExportTarget::openfoam, example()), ExportForm::lookup);
}

TEST(Approximation, ARefittedForceFindsTheForceThatThereIs) {
  // The ring law with other constants, called a mechanism: what is refitted has to find them.
  ExportedImpact impact = example();
  ContactForce truth = impact.force;
  truth.hertz_damping = 5e-3;
  truth.adhesion_damping = 0.045;
  truth.adhesion_force *= 1.2;
  impact.restitution = restitution_under(truth, impact.velocity);
  const RefittedForce found = refitted_force(impact);
  EXPECT_NEAR(found.force.hertz_damping, 5e-3, 1e-6);
  EXPECT_NEAR(found.force.adhesion_damping, 0.045, 1e-5);
  EXPECT_NEAR(found.force.adhesion_force / truth.adhesion_force, 1.0, 1e-4);
  EXPECT_LT(found.error.largest, 1e-4);
  const double v = found.capture_velocity;
  const auto around = restitution_under(truth, std::vector<double>{0.999 * v, 1.001 * v});
  EXPECT_EQ(around[0], 0.0);
  EXPECT_GT(around[1], 0.0);
}

TEST(Approximation, ErrorsOfTheMeasurementAreLeftOut) {
  const ExportedImpact plain = example();
  const ExportedImpact offset = example({"velocity_offset"});
  ASSERT_EQ(offset.of_measurement.size(), 1U);
  EXPECT_TRUE(offset.of_nature.empty());
  for (std::size_t k = 0; k < error_velocities; ++k) {
    EXPECT_NEAR(offset.restitution[k], plain.restitution[k], 1e-9);
  }
}

}  // namespace
