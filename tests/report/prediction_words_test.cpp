// What the prediction for a mixture of sizes says of the fit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "example_analysis.hpp"
#include "mechanism/mechanism.hpp"
#include "report/prediction_report.hpp"

namespace recoil {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A mixture without velocities: only its words count.
PolydispersePrediction mixture_of_two_sizes() {
  PolydispersePrediction mixture;
  mixture.sizes.bins = {{3e-6, 1.0, 0.0}, {5e-6, 1.0, 0.0}};
  mixture.sizes.smallest = 3e-6;
  mixture.sizes.largest = 5e-6;
  mixture.size_curves = {
      {"smallest", 3e-6, 2.0, {}}, {"d10", 4e-6, 1.5, {}}, {"largest", 5e-6, 1.2, {}}};
  return mixture;
}

TEST(MixtureWords, SayThatTheMixtureIsNotFittedOnlyWhereItIsNot) {
  Analysis analysis = sample::four_diameters();
  const auto text = [&] {
    return std::regex_replace(text_prediction(analysis, mixture_of_two_sizes()), std::regex("\\s+"),
                              " ");
  };
  EXPECT_THAT(text(), HasSubstr("the mixture is not fitted"));
  ImpactModel& model = analysis.fitted.model;
  model.chain = {find_mechanism("polydispersity")};
  EXPECT_THAT(text(), Not(HasSubstr("one diameter per point")));
  model.chain = {find_mechanism("gas_film")};
  EXPECT_THAT(text(), HasSubstr("the mixture is not fitted"));
  model.surroundings[0].sizes.spread = 0.25;  // the dataset states the sizes of its points
  EXPECT_THAT(text(), Not(HasSubstr("the mixture is not fitted")));
}

}  // namespace
}  // namespace recoil
