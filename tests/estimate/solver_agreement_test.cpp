// Which solver answers, and how exactly, is no part of an estimate: on a shipped fit of each kind
// (captures counted, sizes mixed, several sizes).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "data/dataset.hpp"
#include "estimate/fit.hpp"
#include "estimate/fit_spec.hpp"

namespace recoil {
namespace {

class SolverAgreement : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const FitSpec spec = load_fit(fmt::format("{}/fits/{}.toml", RECOIL_SOURCE_DIR, GetParam()));
    for (const auto& folder : spec.datasets) datasets_.push_back(load_dataset(folder));
    model_ = make_model(spec, datasets_);
    data_ = gather(datasets_);
    best_ = fit(model_, data_);
    ASSERT_TRUE(best_.usable) << best_.failure;
  }

  /// One descent from 30 % beside the estimate.
  FitResult refit(Solver solver, double tolerance_factor) const {
    ImpactModel model = model_;
    model.solver.kind = solver;
    model.solver.tolerance_factor = tolerance_factor;
    FitOptions options;
    options.several_starts = false;
    options.start = best_.theta;
    for (std::size_t j = 0; j < options.start.size(); ++j) {
      if (model.slots[j].free) options.start[j] *= 1.3;
    }
    return fit(model, data_, options);
  }

  void expect_the_same(const FitResult& other) const {
    ASSERT_TRUE(other.usable) << other.failure;
    for (std::size_t j = 0; j < best_.theta.size(); ++j) {
      const double error = best_.std_error[j];
      EXPECT_NEAR(other.theta[j], best_.theta[j], 0.01 * error) << model_.slots[j].label();
      EXPECT_NEAR(other.std_error[j], error, 0.01 * error) << model_.slots[j].label();
    }
  }

  std::vector<Dataset> datasets_;
  ImpactModel model_;
  Observations data_;
  FitResult best_;
};

TEST_P(SolverAgreement, BetweenFastAndReference) { expect_the_same(refit(Solver::reference, 1.0)); }

TEST_P(SolverAgreement, AcrossTolerances) {
  expect_the_same(refit(Solver::fast, 100.0));
  expect_the_same(refit(Solver::fast, 0.01));
  expect_the_same(refit(Solver::reference, 100.0));
}

INSTANTIATE_TEST_SUITE_P(ShippedFits, SolverAgreement,
                         testing::Values("dahneke1975-quartz", "li1999-sst125-silicon",
                                         "wall1990-mica"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace recoil
