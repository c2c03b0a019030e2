#include "diagnosis/law_errors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "diagnosis/held_out.hpp"
#include "estimate/predictor.hpp"
#include "estimate/residual.hpp"
#include "support/synthetic.hpp"

namespace recoil {
namespace {

Eigen::MatrixXd any_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

TEST(Discrepancy, WhitensWhatItShares) {
  const Eigen::MatrixXd U = any_matrix(9, 4, 1);
  const Eigen::MatrixXd C = Eigen::MatrixXd::Identity(9, 9) + U * U.transpose();
  const Discrepancy discrepancy(U);
  const Eigen::VectorXd r = any_matrix(9, 1, 2);
  std::vector<double> white(r.data(), r.data() + 9);
  discrepancy.whiten(white);
  double square = 0.0;
  for (const double value : white) square += value * value;
  EXPECT_NEAR(square, r.dot(C.fullPivLu().solve(r)), 1e-12);
  EXPECT_NEAR(discrepancy.log_determinant(), std::log(C.determinant()), 1e-12);
  discrepancy.unwhiten(white);
  for (Eigen::Index i = 0; i < 9; ++i) EXPECT_NEAR(white[static_cast<std::size_t>(i)], r(i), 1e-13);
}

TEST(Discrepancy, WhitensAJacobianByColumns) {
  const Discrepancy discrepancy(any_matrix(5, 2, 3));
  const Eigen::MatrixXd J = any_matrix(5, 2, 4);
  std::vector<double> rows;
  for (Eigen::Index i = 0; i < 5; ++i) rows.insert(rows.end(), {J(i, 0), J(i, 1)});
  discrepancy.whiten(rows, 2);
  for (Eigen::Index j = 0; j < 2; ++j) {
    std::vector<double> column(J.col(j).data(), J.col(j).data() + 5);
    discrepancy.whiten(column);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_NEAR(rows[2 * i + static_cast<std::size_t>(j)], column[i], 1e-14);
    }
  }
}

TEST(SmoothFunctions, HaveTheCovarianceThatIsPromised) {
  const Observations data = gather({synthetic::dataset({})});
  const Eigen::MatrixXd B = smooth_functions(data);
  const Eigen::MatrixXd K = B * B.transpose();
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    for (std::size_t j = 0; j < data.points.size(); ++j) {
      const double v = std::log(data.points[i].velocity / data.points[j].velocity);
      const double d = std::log(data.points[i].diameter / data.points[j].diameter);
      EXPECT_NEAR(K(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)),
                  std::exp(-0.5 * (v * v + d * d)), 2e-6);
    }
  }
}

struct Yielding {
  std::vector<Dataset> data = {synthetic::dataset({})};
  Candidate base = make_candidate(synthetic::spec(), data, {});
  Candidate yielding = make_candidate(synthetic::spec(), data, {"plastic_yield"});
  Observations points = gather(data);
  Weights weights = first_weights(points);
  LawErrors laws{{}, smooth_functions(points), 0.1};
};

TEST(LawErrors, OfAMechanismThatDoesNothingAreNothing) {
  const Yielding made;
  std::vector<double> theta = made.yielding.model.initial();
  for (std::size_t j = 0; j < theta.size(); ++j) {
    const ParameterSlot& slot = made.yielding.model.slots[j];
    if (made.yielding.adds(slot)) theta[j] = slot.parameter->null_value;
  }
  const auto columns =
      law_error_columns(made.yielding, made.points, made.weights, theta, made.laws, 0.03);
  ASSERT_TRUE(columns);
  EXPECT_EQ(columns->rightCols(made.laws.functions.cols()).norm(), 0.0);
  EXPECT_GT(columns->leftCols(made.laws.functions.cols()).norm(), 0.0);  // of the base model
}

TEST(LawErrors, AreATenthOfTheEffect) {
  // With one smooth function that is 1 everywhere the column of the law is a tenth of what the
  // residuals change by when the mechanism is left out, to first order in that change.
  Yielding made;
  made.laws.functions =
      Eigen::MatrixXd::Ones(static_cast<Eigen::Index>(made.points.points.size()), 1);
  std::vector<double> theta = made.yielding.model.initial();
  std::size_t own = 0;
  for (std::size_t j = 0; j < theta.size(); ++j) {
    if (made.yielding.adds(made.yielding.model.slots[j]) && made.yielding.model.slots[j].free)
      own = j;
  }
  const auto columns =
      law_error_columns(made.yielding, made.points, made.weights, theta, made.laws, 0.03);
  ASSERT_TRUE(columns);
  ASSERT_EQ(columns->cols(), 2);
  const double whole = columns->col(1).norm();
  EXPECT_GT(whole, 0.0);
  made.laws.mechanism = 0.05;
  EXPECT_NEAR(law_error_columns(made.yielding, made.points, made.weights, theta, made.laws, 0.03)
                  ->col(1)
                  .norm(),
              0.5 * whole, 1e-12 * whole);
  EXPECT_GT(own, 0U);
}

TEST(LawErrors, TakeUpATenthOfTheLossesThatAreBent) {
  // The loss bent by a smooth factor of 0.94 to 1.06: far off for exact laws with a scatter
  // of 0.002, little for losses that are good to 3 %.
  synthetic::Design design;
  design.sd = 0.002;
  Dataset bent = synthetic::dataset(design);
  for (ImpactPoint& point : bent.points) {
    if (point.captured > 0) continue;
    const double loss = 1.0 - point.restitution * point.restitution;
    const double factor = 1.0 + 0.06 * std::sin(2.0 * std::log(point.incident_velocity));
    point.restitution = std::sqrt(1.0 - factor * loss);
  }
  const std::vector<Dataset> data = {bent};
  const Candidate base = make_candidate(synthetic::spec(), data, {});
  const Observations points = gather(data);
  const Weights weights = first_weights(points);
  const Refit exact = refit_candidate(base, points, weights, base.model.initial(), 2);
  const LawErrors laws = allowed_law_errors(std::nullopt, points);
  const auto loosened = [&](double size) {
    return refit_with_law_error(base, points, weights, exact, laws, size);
  };
  const Refit loose = loosened(0.03);
  ASSERT_TRUE(exact.usable);
  ASSERT_TRUE(loose.usable);
  EXPECT_GT(exact.chi2, 60.0);
  EXPECT_LT(loose.chi2, 0.4 * exact.chi2);
  EXPECT_LT(corrected_criterion(points, loose, 2), corrected_criterion(points, exact, 2));
  // The average over the sizes is their mean likelihood.
  double sum = 0.0;
  for (const LawErrorSize& one : laws.sizes) {
    sum += one.prior *
           std::exp(-0.5 * corrected_criterion(points, loosened(one.size), base.free_count));
  }
  const RefitOverLaws over = refit_over_laws(base, points, weights, exact, laws);
  EXPECT_NEAR(over.criterion, -2.0 * std::log(sum), 0.1);
  EXPECT_GT(over.refit.law_error, 0.0);
  EXPECT_EQ(over.first_chi2, loose.chi2);
}

TEST(LawErrors, AreOfOneSizeIfItIsStated) {
  const Observations points = gather({synthetic::dataset({})});
  const LawErrors laws = allowed_law_errors(0.1, points);
  ASSERT_EQ(laws.sizes.size(), 1U);
  EXPECT_NEAR(laws.sizes.front().size, 0.03, 1e-15);
  EXPECT_EQ(laws.sizes.front().prior, 1.0);
  EXPECT_EQ(laws.mechanism, 0.1);
}

TEST(HeldOut, KnowsWhatTheOtherPointsSayOfALaw) {
  // The likelihood of all points is that of those seen times that of the others given them.
  Yielding made;
  constexpr double size = 0.03;
  const std::vector<Fold> folds = held_out_folds(made.points, 1, 2);
  const Fold& fold = folds.front();
  Refit start;
  start.theta = {4e-3, 0.04, 8.9};
  start.law_error = size;
  // At a fit that cannot move: the other points are fitted from where the truth is.
  const auto predicted =
      predict_folds(made.base, made.points, made.weights, made.laws, {fold}, start, 1).front();
  ASSERT_TRUE(predicted.usable);
  Observations seen = made.points, unseen = made.points;
  seen.points.clear();
  unseen.points.clear();
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < made.points.points.size(); ++i) {
    const bool inside = std::find(fold.points.begin(), fold.points.end(), i) != fold.points.end();
    (inside ? unseen : seen).points.push_back(made.points.points[i]);
    if (!inside) others.push_back(i);
  }
  const LawErrors of_others = made.laws.of(others);
  const Refit refit = refit_with_law_error(
      made.base, seen, first_weights(seen),
      refit_candidate(made.base, seen, first_weights(seen), start.theta, 2), of_others, size);
  const auto log_likelihood = [&](const Observations& some, const LawErrors& laws) {
    const auto U = law_error_columns(made.base, some, first_weights(some), refit.theta, laws, size);
    const Eigen::MatrixXd C = Eigen::MatrixXd::Identity(U->rows(), U->rows()) + *U * U->transpose();
    Eigen::VectorXd r(U->rows());
    const std::vector<Prediction> at = [&] {
      std::vector<PointConditions> conditions;
      for (const Observation& point : some.points) conditions.push_back(point.conditions());
      return predict(made.base.model, refit.theta, conditions, false);
    }();
    for (Eigen::Index i = 0; i < r.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      r(i) = weighted_residual(some.points[k], first_weights(some).points[k],
                               at[k].restitution_squared)
                 .value;
    }
    return r.dot(C.ldlt().solve(r)) + std::log(C.determinant());
  };
  const double joint = log_likelihood(made.points, made.laws);
  const double of_seen = log_likelihood(seen, of_others);
  EXPECT_NEAR(predicted.deviance, joint - of_seen, 1e-6);
}

}  // namespace
}  // namespace recoil
