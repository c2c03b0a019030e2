// Fits in which constants of the materials are known with an error only.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/fit.hpp"
#include "estimate/predictor.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

/// Ammonium fluorescein on molybdenum where everything is derived, and nothing is exact.
Dataset uncertain_dataset() {
  Dataset data = synthetic::dataset(synthetic::Design{});
  data.system.stiffness_K.reset();
  data.system.adhesion_force_f0.reset();
  data.system.particle.surface_energy = 0.05;
  data.system.surface.surface_energy = 0.9;
  data.system.surface.density = 10220.0;
  data.system.errors = {{Body::particle, Constant::density, 27.0},
                        {Body::particle, Constant::youngs_modulus, 0.24e9},
                        {Body::particle, Constant::poisson_ratio, 0.03},
                        {Body::particle, Constant::surface_energy, 0.01},
                        {Body::surface, Constant::density, 20.0},
                        {Body::surface, Constant::youngs_modulus, 10e9},
                        {Body::surface, Constant::poisson_ratio, 0.01},
                        {Body::surface, Constant::surface_energy, 0.3}};
  return data;
}

FitSpec with_mechanisms(const std::string& mechanisms) {
  return parse_fit("dataset = \"d\"\n[model]\nmechanisms = [" + mechanisms + "]\n", "fits/x.toml");
}

std::size_t slot_of(const ImpactModel& model, const std::string& label) {
  for (std::size_t j = 0; j < model.slots.size(); ++j) {
    if (model.slots[j].label() == label) return j;
  }
  ADD_FAILURE() << "no slot " << label;
  return 0;
}

/// The dataset as if it stated the constants of `theta`, exactly.
Dataset stating(Dataset data, const ImpactModel& model, std::span<const double> theta) {
  const auto at = [&](const char* label) { return theta[slot_of(model, label)]; };
  data.system.particle.density = at("particle.density");
  data.system.particle.youngs_modulus = at("particle.youngs_modulus");
  data.system.particle.poisson_ratio = at("particle.poisson_ratio");
  data.system.particle.surface_energy = at("particle.surface_energy");
  data.system.surface.youngs_modulus = at("surface.youngs_modulus");
  data.system.surface.poisson_ratio = at("surface.poisson_ratio");
  data.system.surface.surface_energy = at("surface.surface_energy");
  data.system.errors.clear();
  return data;
}

TEST(Materials, MovedConstantsAreThoseOfADatasetThatStatesThem) {
  for (const char* mechanisms : {"", "\"jkr_hysteresis\", \"plastic_yield\""}) {
    const FitSpec spec = with_mechanisms(mechanisms);
    const Dataset data = uncertain_dataset();
    const ImpactModel model = make_model(spec, {data});
    std::vector<double> theta = model.initial();
    double by = 0.02;
    for (std::size_t j = model.first_constant(); j < theta.size(); ++j)
      theta[j] *= 1.0 + (by += 0.01);
    const ImpactModel other = make_model(spec, {stating(data, model, theta)});
    ASSERT_TRUE(other.constants.empty());
    std::vector<double> plain = other.initial();
    for (std::size_t j = 0; j < plain.size(); ++j) {
      if (j != other.slot_adhesion[0]) plain[j] = theta[j];
    }
    for (const double v : {3.0, 12.0, 60.0}) {
      EXPECT_NEAR(predict(model, theta, 0, 4.9e-6, v, false).restitution_squared,
                  predict(other, plain, 0, 4.9e-6, v, false).restitution_squared, 1e-9)
          << mechanisms << " at " << v;
    }
    EXPECT_NEAR(capture_velocity(model, theta, 0, 4.9e-6).value /
                    capture_velocity(other, plain, 0, 4.9e-6).value,
                1.0, 1e-8);
  }
}

TEST(Materials, DerivativesAreFiniteDifferencesOfTheReferenceSolver) {
  for (const char* mechanisms :
       {"", "\"jkr_hysteresis\"", "\"plastic_yield\"", "\"elastic_waves\"", "\"crack_rate\"",
        "\"adhesion_hysteresis\", \"hysteretic_loss\"", "\"gas_film\"",
        "\"electrostatic_image\", \"polydispersity\"", "\"bulk_viscoelastic\""}) {
    for (const bool f0_free : {false, true}) {
      FitSpec spec = with_mechanisms(mechanisms);
      spec.parameters[2].free = f0_free;
      for (ParameterSpec& parameter : spec.parameters) {
        if (parameter.parameter->mechanism == nullptr) continue;
        const auto& starts = parameter.parameter->starts;
        parameter.initial = starts.empty() ? parameter.parameter->initial : starts.front();
        if (parameter.parameter->name == "yield_pressure") parameter.initial = 5e7;
      }
      ImpactModel model = make_model(spec, {uncertain_dataset()});
      const std::vector<double> theta = model.initial();
      const std::vector<PointConditions> points = {
          {0, 4.9e-6, 3.0}, {0, 2.58e-6, 12.0}, {0, 4.9e-6, 60.0}};
      const std::vector<Prediction> exact = predict(model, theta, points, true);
      model.solver.kind = Solver::reference;
      for (std::size_t j = model.first_constant(); j < theta.size(); ++j) {
        const double h = 2e-4;
        std::vector<double> more = theta;
        std::vector<double> less = theta;
        more[j] *= 1.0 + h;
        less[j] *= 1.0 - h;
        const std::vector<Prediction> high = predict(model, more, points, false);
        const std::vector<Prediction> low = predict(model, less, points, false);
        for (std::size_t i = 0; i < points.size(); ++i) {
          const double slope =
              (high[i].restitution_squared - low[i].restitution_squared) / (2.0 * h);
          const double found = exact[i].gradient[j] * theta[j];
          EXPECT_NEAR(found, slope, 2e-6 + 2e-5 * std::abs(slope))
              << mechanisms << ", " << model.slots[j].label() << ", V = " << points[i].velocity;
        }
      }
    }
  }
}

TEST(Materials, UnderJkrTheForceOfTheContactFollowsThemToo) {
  for (const char* free : {"false", "true"}) {
    const FitSpec spec = parse_fit(
        std::string("dataset = \"d\"\n[model]\nadhesion = \"jkr\"\n[parameters]\nW = { free = ") +
            free + " }\n",
        "fits/x.toml");
    const ImpactModel model = make_model(spec, {uncertain_dataset()});
    const std::vector<double> theta = model.initial();
    const std::vector<MaterialSlope> slopes = material_slopes(model, theta, 0);
    EXPECT_EQ(slopes.size(), model.constants.size());
    for (const MaterialSlope& slope : slopes) {
      const std::size_t j = model.first_constant() + slope.index;
      std::vector<double> more = theta, less = theta;
      more[j] *= 1.0 + 1e-4;
      less[j] *= 1.0 - 1e-4;
      const double difference =
          std::log(adhesion_force_under(model, more, 0) / adhesion_force_under(model, less, 0)) /
          2e-4;
      EXPECT_NEAR(slope.adhesion_force * theta[j], difference, 1e-6) << model.slots[j].label();
    }
  }
}

TEST(Materials, OnlyThoseThatCountAreParameters) {
  const auto labels = [](const FitSpec& spec, const Dataset& data) {
    std::vector<std::string> found;
    const ImpactModel model = make_model(spec, {data});
    for (std::size_t j = model.first_constant(); j < model.slots.size(); ++j) {
      found.push_back(model.slots[j].label());
      EXPECT_FALSE(model.slots[j].free);
    }
    EXPECT_EQ(model.free_count(), spec.parameters[2].free ? 3 : 2);
    return found;
  };
  using Labels = std::vector<std::string>;
  const Dataset data = uncertain_dataset();
  const Labels all = {"particle.density",       "particle.youngs_modulus",
                      "particle.poisson_ratio", "particle.surface_energy",
                      "surface.youngs_modulus", "surface.poisson_ratio",
                      "surface.surface_energy"};
  EXPECT_EQ(labels(synthetic::spec(), data), all);
  // With f0 fitted nothing depends on the surface energies.
  EXPECT_EQ(labels(synthetic::spec(true), data),
            (Labels{"particle.density", "particle.youngs_modulus", "particle.poisson_ratio",
                    "surface.youngs_modulus", "surface.poisson_ratio"}));
  Dataset stated = data;
  stated.system.stiffness_K = 1.789e9;
  stated.system.adhesion_force_f0 = 8.9;
  EXPECT_EQ(labels(synthetic::spec(), stated), Labels{"particle.density"});
  stated.system.errors.push_back({Body::pair, Constant::adhesion_force_f0, 1.0});
  EXPECT_EQ(labels(synthetic::spec(), stated), (Labels{"particle.density", "adhesion_force_f0"}));
  FitSpec off = synthetic::spec();
  off.uncertainty.materials = Materials::exact;
  EXPECT_EQ(labels(off, data), Labels{});
}

TEST(Materials, TakenAsExactGiveTheDigitsOfExactOnes) {
  FitSpec off = synthetic::spec();
  off.uncertainty.materials = Materials::exact;
  const Dataset uncertain = uncertain_dataset();
  Dataset exact = uncertain;
  exact.system.errors.clear();
  const FitResult a = fit(make_model(off, {uncertain}), gather({uncertain}));
  const FitResult b = fit(make_model(synthetic::spec(), {exact}), gather({exact}));
  ASSERT_TRUE(a.usable && b.usable);
  EXPECT_EQ(a.theta, b.theta);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.chi2, b.chi2);
}

// A model may start where another fit ended; what it says at theta does not depend on that.
TEST(Materials, AreThoseOfThetaWhereverTheModelStarts) {
  const Dataset data = uncertain_dataset();
  const ImpactModel stated = make_model(synthetic::spec(), {data});
  std::vector<double> theta = stated.initial();
  theta[slot_of(stated, "particle.youngs_modulus")] *= 1.4;
  theta[slot_of(stated, "particle.density")] *= 0.9;
  ImpactModel moved = stated;
  for (std::size_t j = moved.first_constant(); j < theta.size(); ++j) {
    moved.slots[j].initial = theta[j];
  }
  const auto square = [&](const ImpactModel& model) {
    return predict(model, theta, 0, 4.9e-6, 3.0, false).restitution_squared;
  };
  EXPECT_DOUBLE_EQ(square(moved), square(stated));
}

// Gilman's estimate has an error where it decides f0, and enters nowhere else.
TEST(Materials, AnEstimatedSurfaceEnergyCarriesItsError) {
  const auto estimates = [](const FitSpec& spec, const Dataset& data) {
    const ImpactModel model = make_model(spec, {data});
    return std::count_if(model.constants.begin(), model.constants.end(),
                         [](const UncertainConstant& constant) {
                           return constant.constant == Constant::gilman_factor;
                         });
  };
  Dataset data = synthetic::dataset({});
  EXPECT_EQ(estimates(synthetic::spec(), data), 0);  // f0 is stated
  data.system.adhesion_force_f0.reset();
  EXPECT_EQ(estimates(synthetic::spec(), data), 2);
  EXPECT_EQ(estimates(synthetic::spec(true), data), 0);  // f0 is fitted
  FitSpec exact = synthetic::spec();
  exact.uncertainty.materials = Materials::exact;
  EXPECT_EQ(estimates(exact, data), 0);
  data.system.particle.surface_energy = 0.02;
  EXPECT_EQ(estimates(synthetic::spec(), data), 1);
  data.system.adhesion_energy = 0.3;
  EXPECT_EQ(estimates(synthetic::spec(), data), 0);
}

TEST(Materials, DoNotMoveAStatedForce) {
  Dataset data = uncertain_dataset();
  EXPECT_TRUE(follows_materials(make_model(synthetic::spec(), {data}), 0));
  data.system.adhesion_force_f0 = 8.9;
  const ImpactModel model = make_model(synthetic::spec(), {data});
  EXPECT_FALSE(follows_materials(model, 0));
  std::vector<double> theta = model.initial();
  theta[slot_of(model, "particle.youngs_modulus")] *= 1.3;
  EXPECT_DOUBLE_EQ(adhesion_force_under(model, theta, 0), 8.9);
}

TEST(Materials, AreSharedByDatasetsWithTheSameBody) {
  Dataset one = uncertain_dataset();
  Dataset two = one;
  two.id = "other";
  two.system.surface.name = "mica";
  const ImpactModel model = make_model(synthetic::spec(), {one, two});
  std::vector<std::string> labels;
  for (std::size_t j = model.first_constant(); j < model.slots.size(); ++j) {
    labels.push_back(model.slots[j].label());
  }
  EXPECT_EQ(std::count(labels.begin(), labels.end(), "particle.youngs_modulus"), 1);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), "surface.youngs_modulus[synthetic]"), 1);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), "surface.youngs_modulus[other]"), 1);
  // Stated differently it is another body.
  two.system.particle.youngs_modulus *= 1.01;
  EXPECT_EQ(make_model(synthetic::spec(), {one, two}).constants.size(), model.constants.size() + 1);
}

/// `uncertain_dataset` with noise of its stated deviations, from the independent simulator.
Dataset measured(std::uint64_t seed) {
  Dataset data = uncertain_dataset();
  const ContactProperties contact = derive_contact(data.system, 4.9e-6);
  Truth truth = synthetic::truth_of({});
  truth.stiffness = contact.stiffness;
  truth.adhesion_force = contact.adhesion_force;
  RandomStream random(seed, RandomPurpose::coverage, 0);
  for (ImpactPoint& point : data.points) {
    point.restitution = true_restitution(truth, point.diameter, point.incident_velocity);
    point.captured = point.restitution == 0.0 ? 1 : 0;
    if (point.captured == 0) point.restitution += *point.restitution_sd * random.normal();
  }
  return data;
}

TEST(Materials, AFreeF0InheritsTheErrorsOfStiffnessAndDensity) {
  // e depends on f0 K^(-3/5) rho^(-2/5) alone, so that the points say nothing of K and rho and
  //   var ln f0 = var(points) + (3/5)^2 var ln K + (2/5)^2 var ln rho,
  // with ln(1 + (27 / 1350)^2) = 0.019998^2 for rho and, of K only, the sphere's modulus:
  // k1 / (k1 + k2) ln(1 + 0.2^2)^(1/2), k = (1 - nu^2) / E.
  Dataset data = measured(3);
  data.system.errors = {{Body::particle, Constant::density, 27.0},
                        {Body::particle, Constant::youngs_modulus, 0.24e9}};
  FitSpec exact = synthetic::spec(true);
  exact.uncertainty.materials = Materials::exact;
  const FitResult without = fit(make_model(exact, {data}), gather({data}));
  const FitResult with = fit(make_model(synthetic::spec(true), {data}), gather({data}));
  ASSERT_TRUE(without.usable && with.usable);
  const double k1 = (1.0 - 0.33 * 0.33) / 1.2e9;
  const double k2 = (1.0 - 0.31 * 0.31) / 320e9;
  const double by_stiffness = 0.6 * k1 / (k1 + k2) * std::sqrt(std::log(1.04));
  const double by_density = 0.4 * std::sqrt(std::log1p(0.0004));
  const double sd = with.std_error[2] / with.theta[2];
  const double conditional = without.std_error[2] / without.theta[2];
  EXPECT_NEAR(with.theta[2] / without.theta[2], 1.0, 1e-6);
  EXPECT_NEAR(sd * sd - conditional * conditional,
              by_stiffness * by_stiffness + by_density * by_density, 1e-5 * sd * sd);
  EXPECT_NEAR(with.std_error[0] / without.std_error[0], 1.0, 1e-5);
  EXPECT_EQ(with.dof, without.dof);
  EXPECT_NEAR(with.chi2, without.chi2, 1e-6);
  for (const double moved : with.constants_moved) EXPECT_NEAR(moved, 0.0, 1e-4);
}

/// The points move the constants.
FitSpec adjusting() {
  FitSpec spec = synthetic::spec();
  spec.uncertainty.materials = Materials::adjusted;
  return spec;
}

/// Estimates with the constants stated otherwise and taken as exact.
std::vector<double> estimates_with(Dataset data, Body body, Constant constant, double factor) {
  if (constant == Constant::youngs_modulus) {
    (body == Body::particle ? data.system.particle : data.system.surface).youngs_modulus *= factor;
  } else {
    *data.system.surface.surface_energy *= factor;
  }
  FitSpec exact = synthetic::spec();
  exact.uncertainty.materials = Materials::exact;
  return fit(make_model(exact, {data}), gather({data})).theta;
}

TEST(Materials, StayAsStatedAndWidenTheErrors) {
  // With the constants held, var theta = var(points) + sum (d theta / d ln c)^2 sd^2; the slopes
  // from whole fits of datasets that state the constant a thousandth lower and higher.
  Dataset data = measured(7);
  data.system.errors = {
      {Body::particle, Constant::youngs_modulus, 0.1 * data.system.particle.youngs_modulus},
      {Body::surface, Constant::surface_energy, 0.2 * *data.system.surface.surface_energy}};
  FitSpec held = synthetic::spec();
  held.uncertainty.materials = Materials::propagated;
  const FitResult with = fit(make_model(held, {data}), gather({data}));
  FitSpec off = synthetic::spec();
  off.uncertainty.materials = Materials::exact;
  const FitResult without = fit(make_model(off, {data}), gather({data}));
  ASSERT_TRUE(with.usable && without.usable);
  constexpr double step = 1e-3;
  for (const std::size_t j : {0U, 1U}) {
    EXPECT_NEAR(with.theta[j] / without.theta[j], 1.0, 1e-9);
    double variance = without.std_error[j] * without.std_error[j];
    for (const auto& [body, constant, relative] :
         {std::tuple(Body::particle, Constant::youngs_modulus, 0.1),
          std::tuple(Body::surface, Constant::surface_energy, 0.2)}) {
      const double slope = (estimates_with(data, body, constant, std::exp(step))[j] -
                            estimates_with(data, body, constant, std::exp(-step))[j]) /
                           (2.0 * step);
      variance += slope * slope * std::log1p(relative * relative);
    }
    // Gauss-Newton leaves out the second derivatives: a few percent at residuals of this size.
    EXPECT_NEAR(with.std_error[j] / std::sqrt(variance), 1.0, 0.03) << j;
    EXPECT_GT(with.std_error[j], 1.1 * without.std_error[j]) << j;
  }
}

TEST(Materials, ConstantsMoveWhereThePointsSpeak) {
  // The surface energy is stated a third too low, and known to 30 %: the points put it right.
  Dataset data = measured(5);
  const double right = *data.system.surface.surface_energy;
  data.system.surface.surface_energy = right / 1.35;
  data.system.errors = {{Body::surface, Constant::surface_energy, 0.3 * right / 1.35}};
  const FitResult with = fit(make_model(adjusting(), {data}), gather({data}));
  ASSERT_TRUE(with.usable);
  const std::size_t j = slot_of(with.model, "surface.surface_energy");
  EXPECT_NEAR(with.theta[j] / right, 1.0, 3.0 * with.std_error[j] / right);
  EXPECT_LT(with.std_error[j], 0.2 * right);  // less than what was stated
  EXPECT_GT(with.constants_moved.front(), 0.3);
  EXPECT_NEAR(with.theta[1], 0.03, 3.0 * with.std_error[1]);
}

TEST(Materials, KeepTheirErrorsWhereThoseOfThePointsAreWidened) {
  // Points that state a third of their scatter: what is widened by three is the points alone, so
  // that the fit is that of points which state it right, up to the chi-squared of their scatter.
  Dataset right = measured(11);
  // Beside captures, impacts that differ could explain the scatter.
  std::erase_if(right.points, [](const ImpactPoint& point) { return point.captured > 0; });
  Dataset small = right;
  for (ImpactPoint& point : small.points) *point.restitution_sd /= 3.0;
  FitResult narrow = fit(make_model(adjusting(), {small}), gather({small}));
  ASSERT_TRUE(narrow.usable);
  ASSERT_EQ(narrow.noise_verdict, NoiseVerdict::exceeded);
  for (ImpactPoint& point : right.points) *point.restitution_sd *= narrow.noise_scale / 3.0;
  const FitResult wide = fit(make_model(adjusting(), {right}), gather({right}));
  for (std::size_t j = 0; j < wide.theta.size(); ++j) {
    if (!wide.model.slots[j].moves()) continue;
    // y = e^2 - sd^2 of the residual depends on the stated deviation a little.
    EXPECT_NEAR(narrow.theta[j] / wide.theta[j], 1.0, 0.01) << wide.model.slots[j].label();
    EXPECT_NEAR(narrow.std_error[j] / wide.std_error[j], 1.0, 0.02) << wide.model.slots[j].label();
  }
}

}  // namespace
}  // namespace recoil
