// Conditions fix what a fit would otherwise have to guess.
#include <gtest/gtest.h>

#include <cmath>

#include "estimate/fit.hpp"
#include "estimate/predictor.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

FitSpec with_gas() {
  FitSpec spec = synthetic::spec();
  spec.mechanisms = {"gas_film"};
  spec.parameters.clear();
  for (const Parameter* parameter : parameters_with(spec.mechanisms, spec.adhesion)) {
    spec.parameters.push_back(default_of(*parameter));
    if (parameter->name == "f0") spec.parameters.back().free = false;
  }
  return spec;
}

Dataset at_pressure(std::optional<double> all, std::vector<std::optional<double>> of_series = {}) {
  Dataset data = synthetic::dataset({});
  if (all) data.system.conditions.set(Condition::ambient_pressure, *all);
  for (const auto& pressure : of_series) {
    data.series_conditions.emplace_back();
    if (pressure) data.series_conditions.back().set(Condition::ambient_pressure, *pressure);
  }
  return data;
}

const ParameterSlot* slot_named(const ImpactModel& model, const std::string& label) {
  for (const ParameterSlot& slot : model.slots) {
    if (slot.label() == label) return &slot;
  }
  return nullptr;
}

TEST(ConditionsOfAFit, AStatedPressureIsNotFitted) {
  const std::vector<Dataset> open = {at_pressure({})};
  EXPECT_TRUE(slot_named(make_model(with_gas(), open), "gas_pressure")->free);
  const std::vector<Dataset> stated = {at_pressure(101325.0)};
  const ImpactModel model = make_model(with_gas(), stated);
  const ParameterSlot* const pressure = slot_named(model, "gas_pressure");
  ASSERT_NE(pressure, nullptr);
  EXPECT_FALSE(pressure->free);
  EXPECT_TRUE(pressure->stated);
  EXPECT_EQ(pressure->initial, 101325.0);
  EXPECT_EQ(model.free_count(), make_model(with_gas(), open).free_count() - 1);
}

TEST(ConditionsOfAFit, WhatTheFitFileSaysComesFirst) {
  FitSpec spec = with_gas();
  for (ParameterSpec& stated : spec.parameters) {
    if (stated.parameter->name == "gas_pressure") stated.mentioned = true;
  }
  EXPECT_TRUE(slot_named(make_model(spec, {at_pressure(101325.0)}), "gas_pressure")->free);
}

TEST(ConditionsOfAFit, SeriesThatDifferShareWhatIsOpen) {
  const std::vector<Dataset> mixed = {at_pressure({}, {0.0, std::nullopt})};
  const ImpactModel model = make_model(with_gas(), mixed);
  ASSERT_NE(slot_named(model, "gas_pressure[0]"), nullptr);
  EXPECT_TRUE(slot_named(model, "gas_pressure[0]")->stated);
  ASSERT_NE(slot_named(model, "gas_pressure"), nullptr);
  EXPECT_TRUE(slot_named(model, "gas_pressure")->free);
  // The sphere of a series knows its air; one of no series has that of all points, which is open.
  std::vector<double> theta = model.initial();
  const auto e = [&](std::size_t series) {
    return predict(model, theta, {{0, 2.58e-6, 4.0, series}}, false).front().restitution();
  };
  EXPECT_NEAR(e(PointConditions::no_series), e(1), 1e-12);
  EXPECT_LT(e(1), e(0) - 1e-3);
  const double pumped = e(0);
  for (std::size_t j = 0; j < theta.size(); ++j) {
    if (model.slots[j].label() == "gas_pressure") theta[j] = 0.0;
  }
  EXPECT_NEAR(e(1), pumped, 1e-12);
}

TEST(ConditionsOfAFit, DatasetsOfAJointFitHaveTheirOwn) {
  std::vector<Dataset> two = {at_pressure(101325.0), at_pressure({})};
  two[0].id = "air";
  two[1].id = "unknown";
  const ImpactModel model = make_model(with_gas(), two);
  ASSERT_NE(slot_named(model, "gas_pressure[air]"), nullptr);
  EXPECT_TRUE(slot_named(model, "gas_pressure[air]")->stated);
  ASSERT_NE(slot_named(model, "gas_pressure"), nullptr);
  EXPECT_TRUE(slot_named(model, "gas_pressure")->free);
}

}  // namespace
}  // namespace recoil
