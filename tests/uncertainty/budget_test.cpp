// Where the error of a parameter comes from.
#include "uncertainty/budget.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/analysis.hpp"
#include "support/noisy_case.hpp"

namespace recoil {
namespace {

/// The part of `source` (of a constant: its label) in a budget; 0 where it has none.
double part(const ErrorBudget& budget, const ImpactModel& model, const std::string& source) {
  for (const BudgetEntry& entry : budget.entries) {
    const std::string name = entry.constant
                                 ? model.slots[model.first_constant() + *entry.constant].label()
                                 : std::string(entry.source);
    if (name == source) return entry.sd;
  }
  return 0.0;
}

double sum_of_squares(const ErrorBudget& budget) {
  double sum = 0.0;
  for (const BudgetEntry& entry : budget.entries) sum += entry.sd * entry.sd;
  return sum;
}

FitResult fit_of(Dataset data, std::vector<ConstantError> errors, bool f0_free) {
  data.system.errors = std::move(errors);
  return fit(make_model(synthetic::spec(f0_free), {data}), gather({data}));
}

TEST(Budget, OfAFreeF0IsThatOfTheProductOnWhichTheImpactDepends) {
  // e depends on f0 K^(-3/5) rho^(-2/5): see Materials.AFreeF0InheritsTheErrors...; here K is
  // stated with 10 % and rho with 5 %.
  const Dataset data = synthetic::noisy_case().datasets.front();
  const FitResult exact = fit_of(data, {}, true);
  const FitResult fitted = fit_of(
      data,
      {{Body::pair, Constant::stiffness_K, 0.1789e9}, {Body::particle, Constant::density, 67.5}},
      true);
  ASSERT_TRUE(fitted.usable);
  const std::vector<ErrorBudget> budgets = parameter_budgets(fitted);
  const ErrorBudget& f0 = budgets[2];
  ASSERT_TRUE(f0.available());
  EXPECT_NEAR(part(f0, fitted.model, "scatter") / exact.std_error[2], 1.0, 1e-4);
  EXPECT_NEAR(part(f0, fitted.model, "stiffness_K") / fitted.theta[2],
              0.6 * std::sqrt(std::log1p(0.01)), 1e-5);
  EXPECT_NEAR(part(f0, fitted.model, "particle.density") / fitted.theta[2],
              0.4 * std::sqrt(std::log1p(0.0025)), 1e-5);
  EXPECT_NEAR(f0.sd / fitted.std_error[2], 1.0, 1e-10);
  EXPECT_NEAR(sum_of_squares(f0) / (f0.sd * f0.sd), 1.0, 1e-12);
  EXPECT_TRUE(f0.linear);
  // Known exactly, K leaves the other two.
  const double others =
      std::hypot(part(f0, fitted.model, "scatter"), part(f0, fitted.model, "particle.density"));
  const bool first =
      part(f0, fitted.model, "stiffness_K") > part(f0, fitted.model, "particle.density");
  ASSERT_TRUE(first);
  EXPECT_NEAR(*f0.sd_without_first_constant / others, 1.0, 1e-4);
  // Its own solver adds nothing that counts.
  EXPECT_LT(part(f0, fitted.model, "numerics"), 1e-6 * f0.sd);
  // C_H and C_A do not depend on either.
  EXPECT_LT(part(budgets[0], fitted.model, "stiffness_K"), 1e-3 * budgets[0].sd);
}

TEST(Budget, MovesTellWhereTheLawBends) {
  // With f0 held, C_A ~ f0^-3.75 or so takes up an error of f0: hardly a straight line at 15 %.
  const Dataset data = synthetic::noisy_case().datasets.front();
  for (const double relative : {0.005, 0.15}) {
    const FitResult fitted =
        fit_of(data, {{Body::pair, Constant::adhesion_force_f0, relative * 8.9}}, false);
    ASSERT_TRUE(fitted.usable);
    const ErrorBudget budget = parameter_budgets(fitted)[1];
    ASSERT_TRUE(budget.available());
    const auto entry = std::find_if(budget.entries.begin(), budget.entries.end(),
                                    [](const BudgetEntry& e) { return e.constant.has_value(); });
    ASSERT_NE(entry, budget.entries.end());
    if (!entry->lower) continue;    // too small to matter
    EXPECT_GT(*entry->lower, 0.0);  // less adhesion, more damping
    EXPECT_LT(*entry->upper, 0.0);
    if (relative < 0.01) {
      EXPECT_NEAR(*entry->lower / entry->sd, 1.0, 0.05);
      EXPECT_TRUE(budget.linear);
    }
  }
}

TEST(Budget, SplitsStatedErrorsOfVelocityAndDiameter) {
  Dataset data = synthetic::noisy_case().datasets.front();
  for (ImpactPoint& point : data.points) {
    point.velocity_sd = 0.02 * point.incident_velocity;
    point.diameter_sd = 0.01 * point.diameter;
  }
  const FitResult fitted = fit(make_model(synthetic::spec(), {data}), gather({data}));
  ASSERT_TRUE(fitted.usable);
  const ErrorBudget budget = parameter_budgets(fitted)[1];
  EXPECT_GT(part(budget, fitted.model, "velocity"), 0.0);
  EXPECT_GT(part(budget, fitted.model, "batch_diameter"), 0.0);
  EXPECT_NEAR(sum_of_squares(budget) / std::pow(fitted.std_error[1], 2), 1.0, 1e-10);
}

TEST(Budget, TheConditionalFitIsThatOfExactMaterials) {
  Dataset data = synthetic::noisy_case().datasets.front();
  const FitResult exact = fit_of(data, {}, false);
  data.system.errors = {{Body::particle, Constant::density, 200.0}};
  const FitResult fitted = fit(make_model(synthetic::spec(), {data}), gather({data}));
  UncertaintyOptions options = synthetic::small(1);
  const UncertaintyResult result = assess_uncertainty(fitted, {data}, options);
  ASSERT_TRUE(result.conditional);
  for (std::size_t j = 0; j < exact.theta.size(); ++j) {
    EXPECT_NEAR(result.conditional->fitted.theta[j], exact.theta[j], 1e-6 * exact.theta[j]);
  }
  EXPECT_GT(fitted.std_error[1], 1.2 * result.conditional->fitted.std_error[1]);
  EXPECT_FALSE(assess_uncertainty(exact, {data}, options).conditional);
}

}  // namespace
}  // namespace recoil
