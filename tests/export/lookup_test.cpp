// The table that programs look e(V, d) up in.
#include "export/lookup.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/synthetic.hpp"

namespace {

using namespace recoil;

ImpactModel model_of(double c_a) {
  synthetic::Design design;
  design.C_A = c_a;
  FitSpec spec = synthetic::spec();
  for (ParameterSpec& parameter : spec.parameters) {
    if (parameter.parameter->name == "C_A") parameter.initial = c_a;
    if (parameter.parameter->name == "C_H") parameter.initial = design.C_H;
  }
  return make_model(spec, {synthetic::dataset(design)});
}

TEST(Lookup, IsAsNearAsItSaysBetweenTheNodes) {
  const ImpactModel model = model_of(0.03);
  const RestitutionLookup lookup =
      restitution_lookup(model, model.initial(), {0, {2.58e-6, 6.89e-6}, 0.5, 90.0});
  ASSERT_TRUE(lookup.captures);
  EXPECT_LE(lookup.error, lookup_error);
  EXPECT_LE(lookup.capture_error, 1e-3);
  Truth truth = synthetic::truth_of({});  // by the other simulator
  for (const double d : {2.58e-6, 3.1e-6, 4.4e-6, 6.0e-6, 6.89e-6}) {
    for (const double v : {0.5, 1.3, 1.9, 3.3, 7.7, 21.0, 88.0}) {
      const double e = true_restitution(truth, d, v);
      // near capture e goes like the root of V - V*: there the error of V* between sizes counts
      const double allowed = e > 0.2 ? 2.0 * lookup_error : 0.02;
      EXPECT_NEAR(lookup.restitution(d, v), e, allowed) << d << " " << v;
    }
  }
}

TEST(Lookup, WithoutCapturesItCountsInMetersPerSecond) {
  const ImpactModel model = model_of(0.0);
  std::vector<double> theta = model.initial();
  for (std::size_t s = 0; s < theta.size(); ++s) {
    if (model.slots[s].label() == "C_H") theta[s] = 0.0;
  }
  const RestitutionLookup lookup = restitution_lookup(model, theta, {0, {4.9e-6}, 0.5, 90.0});
  EXPECT_FALSE(lookup.captures);
  EXPECT_EQ(lookup.scale.front(), 1.0);
  EXPECT_NEAR(lookup.restitution(4.9e-6, 0.1), 1.0, 1e-9);  // conservative: all comes back
  EXPECT_NEAR(lookup.restitution(4.9e-6, 50.0), 1.0, 1e-9);
}

}  // namespace
