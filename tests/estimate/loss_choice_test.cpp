// Which loss a dry contact has: points on the exact curves of four laws, each of which has to be
// chosen with its value.
#include "estimate/loss_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

/// A steel sphere of 19 mm on concrete, K = (4/3) E*.
constexpr double ball_density = 7800.0;
const double reduced_modulus =
    1.0 / ((1.0 - 0.3 * 0.3) / 2.1e11 + (1.0 - 0.2 * 0.2) / 3e10);  // E* [Pa]
constexpr std::array ball_velocities = {0.5, 1.0, 2.0, 4.0, 8.0};   // [m/s]

Dataset drops(const std::array<double, 5>& restitution) {
  Dataset data;
  data.id = "drops";
  data.system.particle = {"steel", ball_density, 2.1e11, 0.3, std::nullopt};
  data.system.surface = {"concrete", 0.0, 3e10, 0.2, std::nullopt};
  data.system.adhesion_energy = 0.0;
  data.series = {"drops"};
  for (std::size_t k = 0; k < ball_velocities.size(); ++k) {
    // Three readings that scatter by their stated deviation: mean square 1, mean 0.
    for (const double away : {-1.2247449, 0.0, 1.2247449}) {
      ImpactPoint point;
      point.diameter = 0.019;
      point.incident_velocity = ball_velocities[k];
      point.restitution = restitution[k] + 0.003 * away;
      point.restitution_sd = 0.003;
      data.points.push_back(point);
    }
  }
  return data;
}

/// 1 + x = (1 - x e) exp(x (1 + e)), x = C_H V (Hunt & Crossley 1975, J. Appl. Mech. 42, 440-445).
double of_hunt_crossley(double x) {
  double low = 0.0;
  double high = 1.0;
  for (int step = 0; step < 60; ++step) {
    const double e = 0.5 * (low + high);
    ((1.0 - x * e) * std::exp(x * (1.0 + e)) > 1.0 + x ? low : high) = e;
  }
  return low;
}

/// Thornton & Ning 1998, eq. 30, with V_Y = 1.56 sqrt(p^5 / (E*^4 rho)); it follows from the work
/// up to the yield and the one of a flattened Hertz contact.
double of_yield(double pressure, double velocity) {
  const double y =
      1.56 * std::sqrt(std::pow(pressure, 5) / (std::pow(reduced_modulus, 4) * ball_density)) /
      velocity;
  if (y >= 1.0) return 1.0;
  return std::sqrt(1.2 * std::sqrt(3.0) * (1.0 - y * y / 6.0) *
                   std::sqrt(y / (y + 2.0 * std::sqrt(1.2 - y * y / 5.0))));
}

std::array<double, 5> curve(double (*e)(double velocity)) {
  std::array<double, 5> values = {};
  for (std::size_t k = 0; k < ball_velocities.size(); ++k) values[k] = e(ball_velocities[k]);
  return values;
}

struct Chosen {
  LossChoice choice;
  double value = 0.0;  ///< of the free parameter
};

Chosen chosen(const Dataset& data) {
  Chosen out{choose_loss(synthetic::spec(), {data})};
  const FitResult fitted =
      fit(make_model(out.choice.spec, {data}), gather({data}, out.choice.spec));
  for (std::size_t s = 0; s < fitted.theta.size(); ++s) {
    if (fitted.model.slots[s].free) out.value = fitted.theta[s];
  }
  return out;
}

void expect_law(const Dataset& data, const std::string& law, double value, double relative) {
  const Chosen found = chosen(data);
  ASSERT_EQ(found.choice.laws.size(), dry_losses().size());
  EXPECT_EQ(found.choice.spec.loss, law);
  EXPECT_EQ(found.choice.laws.front().id, law);
  EXPECT_EQ(found.choice.laws.front().delta_aicc, 0.0);
  EXPECT_GT(found.choice.laws[1].delta_aicc, 10.0);
  EXPECT_NEAR(found.value / value, 1.0, relative) << law;
}

TEST(LossChoice, FindsTheDampingOfHuntAndCrossley) {
  expect_law(drops(curve([](double v) { return of_hunt_crossley(0.05 * v); })), "hunt_crossley",
             0.05, 1e-3);
}

TEST(LossChoice, FindsAConstantShare) {
  expect_law(drops(curve([](double) { return std::sqrt(0.7); })), "constant", 0.3, 1e-3);
}

TEST(LossChoice, FindsAYieldPressure) {
  // The coefficient 1.56 is rounded: (1.56 / 1.5597)^(2/5).
  expect_law(drops(curve([](double v) { return of_yield(1e9, v); })), "yield", 1e9, 1e-3);
}

TEST(LossChoice, FindsARelaxationTime) {
  // scipy 1.10, solve_ivp (DOP853, rtol 1e-11) of m n'' = -K r^(1/2) n^(3/2) - (3/2) A K (r
  // n)^(1/2) n' with A = 4 us until the force vanishes.
  expect_law(drops({0.8500495396, 0.8304647093, 0.8087527539, 0.7848052172, 0.7585433616}),
             "viscoelastic", 4e-6, 1e-3);
}

TEST(LossChoice, OneVelocityTellsNoLawFromAnother) {
  Dataset data = drops(curve([](double) { return 0.8; }));
  for (ImpactPoint& point : data.points) point.incident_velocity = 2.0;
  const LossChoice choice = choose_loss(synthetic::spec(), {data});
  ASSERT_EQ(choice.laws.size(), dry_losses().size());
  for (const LossFit& law : choice.laws) EXPECT_EQ(law.delta_aicc, 0.0) << law.id;
  EXPECT_EQ(choice.spec.loss, hunt_crossley);
}

TEST(LossChoice, DifferencesOfAiccAreThoseOfChiSquaredUnderStatedErrors) {
  const Dataset data = drops(curve([](double) { return std::sqrt(0.7); }));
  for (const LossFit& law : choose_loss(synthetic::spec(), {data}).laws) {
    const FitSpec spec = with_loss(synthetic::spec(), law.id);
    const double constant = 15.0;  // chi2 about the right law: five times 2 * 1.2247449^2
    const FitResult fitted = fit(make_model(spec, {data}), gather({data}, spec));
    double sum = 0.0;
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      sum += std::pow((data.points[i].restitution - fitted.prediction[i]) / 0.003, 2);
    }
    EXPECT_NEAR(law.delta_aicc, sum - constant, 0.02 * sum + 0.01) << law.id;
  }
}

TEST(LossChoice, LeavesWhatTheFileStates) {
  const Dataset data = drops(curve([](double) { return std::sqrt(0.7); }));
  const auto stated = [&](const std::string& text) {
    return choose_loss(parse_fit("dataset = \"x\"\n" + text, "a/fit.toml"), {data});
  };
  const LossChoice named = stated("[model]\nloss = \"viscoelastic\"\n");
  EXPECT_EQ(named.spec.loss, "viscoelastic");
  EXPECT_TRUE(named.laws.empty());
  EXPECT_EQ(stated("[parameters]\nC_H = { free = false, initial = 0.1 }\n").spec.loss,
            hunt_crossley);
  EXPECT_EQ(stated("[parameters]\nC_H = { bounds = [0, 1] }\n").spec.loss, "constant");
  Dataset sticky = data;
  sticky.system.adhesion_energy = 0.1;
  EXPECT_TRUE(choose_loss(synthetic::spec(), {sticky}).laws.empty());
}

TEST(LossChoice, ANamedLossTakesThePlaceOfTheDamping) {
  const FitSpec spec = parse_fit(
      "dataset = \"x\"\n[model]\nloss = \"constant\"\n[parameters]\n"
      "hysteretic_share = { initial = 0.2 }\n",
      "a/fit.toml");
  EXPECT_EQ(spec.mechanisms, std::vector<std::string>{"hysteretic_loss"});
  EXPECT_FALSE(spec.parameters.front().free);
  EXPECT_EQ(spec.parameters.front().initial, 0.0);
  EXPECT_EQ(spec.parameters.back().initial, 0.2);
  for (const char* wrong :
       {"loss = \"constnat\"\n", "loss = \"constant\"\nmechanisms = [\"hysteretic_loss\"]\n",
        "loss = \"viscoelastic\"\nadhesion = \"maugis\"\n",
        "loss = \"constant\"\n[parameters]\nC_H = { initial = 0.1 }\n"}) {
    EXPECT_THROW(parse_fit(std::string("dataset = \"x\"\n[model]\n") + wrong, "a/fit.toml"),
                 InputError)
        << wrong;
  }
}

}  // namespace
}  // namespace recoil
