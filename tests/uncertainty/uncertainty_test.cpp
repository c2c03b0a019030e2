// Bootstrap, profile and comparison on a fit with a known answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/analysis.hpp"
#include "estimate/impact_problem.hpp"
#include "support/noisy_case.hpp"
#include "uncertainty/capture_interval.hpp"
#include "uncertainty/identifiability.hpp"
#include "uncertainty/intervals.hpp"
#include "uncertainty/profile.hpp"
#include "uncertainty/two_point_comparison.hpp"

namespace recoil {
namespace {

using synthetic::Case;
using synthetic::Design;
using synthetic::noisy_case;
using synthetic::small;

TEST(Bootstrap, EveryDigitIsTheSameAtAnyThreadCount) {
  const Case c = noisy_case();
  const UncertaintyResult one = assess_uncertainty(c.fitted, c.datasets, small(1));
  const UncertaintyResult four = assess_uncertainty(c.fitted, c.datasets, small(4));
  EXPECT_EQ(one.bootstrap.theta, four.bootstrap.theta);
  EXPECT_EQ(one.bootstrap.two_point_theta, four.bootstrap.two_point_theta);
  EXPECT_EQ(one.intervals[0][IntervalKind::bca].lower, four.intervals[0][IntervalKind::bca].lower);
  EXPECT_EQ(one.capture[0].interval.upper, four.capture[0].interval.upper);
  EXPECT_EQ(one.curves[0].lower, four.curves[0].lower);
}

TEST(Bootstrap, SeedChangesTheReplicatesOnly) {
  const Case c = noisy_case();
  UncertaintyOptions other = small(0);
  other.seed = 1;
  const UncertaintyResult a = assess_uncertainty(c.fitted, c.datasets, small(0));
  const UncertaintyResult b = assess_uncertainty(c.fitted, c.datasets, other);
  EXPECT_NE(a.bootstrap.theta, b.bootstrap.theta);
  EXPECT_EQ(a.intervals[0][IntervalKind::wald].lower, b.intervals[0][IntervalKind::wald].lower);
  EXPECT_EQ(a.intervals[0][IntervalKind::profile].lower,
            b.intervals[0][IntervalKind::profile].lower);
}

/// The three rows of a shipped fit with f0 as `f0` says.
std::vector<ComparisonRow> rows_of_molybdenum(bool free, std::optional<double> f0) {
  FitInputs inputs = load_inputs(RECOIL_SOURCE_DIR "/fits/wall1990-molybdenum.toml");
  inputs.spec.uncertainty.materials = Materials::propagated;
  for (ParameterSpec& parameter : inputs.spec.parameters) {
    if (!parameter.parameter->is_adhesion()) continue;
    parameter.free = free;
    parameter.initial_stated = f0.has_value();
    if (f0) parameter.initial = *f0;
  }
  const FitResult fitted = analyse_fit(std::move(inputs)).fitted;
  std::vector<TwoPointComparison> comparisons = compare_two_points(fitted);
  add_comparison_rows(fitted, comparisons);
  EXPECT_EQ(comparisons.size(), 1U);
  return comparisons.front().rows;
}

TEST(TwoPoints, AreComparedWithAFitOfTheSameF0) {
  constexpr std::size_t C_A = 1, adhesion = 2;
  struct {
    bool free;
    std::optional<double> stated;
    double same;
  } const cases[] = {
      // (18 K r g1 g2 / pi)^(1/3) with K 1.789 GPa, r 2.45 um and the surface energies of Gilman's
      // equation, E (a0 / pi)^2 / y0: 0.01027 and 2.740 J/m2.
      {false, std::nullopt, std::cbrt(18.0 * 1.789e9 * 2.45e-6 * 0.010274 * 2.73976 / M_PI)},
      {true, 12.0, std::cbrt(18.0 * 1.789e9 * 2.45e-6 * 0.010274 * 2.73976 / M_PI)},
      {false, 12.0, 12.0},
  };
  for (const auto& c : cases) {
    const auto rows = rows_of_molybdenum(c.free, c.stated);
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[0].row, CalibrationKind::two_point);
    EXPECT_NEAR(rows[0].theta[adhesion] / c.same, 1.0, 2e-3);
    EXPECT_EQ(rows[0].theta[adhesion], rows[1].theta[adhesion]);
    EXPECT_GT(std::abs(rows[2].theta[adhesion] - c.same), 0.3);  // the points want 9.3 N/m
    // What made the points damps by adhesion, and with f0 exact the fit to all of them knows it.
    EXPECT_TRUE(rows[0].standard_errors.empty());
    EXPECT_GT(rows[1].theta[C_A], 2.0 * rows[1].standard_errors[C_A]);
    EXPECT_EQ(rows[1].standard_errors[adhesion], 0.0);
    EXPECT_LT(*rows[1].rmse, *rows[0].rmse);
    EXPECT_LT(*rows[2].rmse, *rows[1].rmse);
    EXPECT_TRUE(rows[1].held_out_rmse && rows[2].held_out_rmse);
    EXPECT_FALSE(rows[0].headline);
    EXPECT_EQ(rows[1].headline, !c.free);
    EXPECT_EQ(rows[2].headline, c.free);
  }
}

TEST(TwoPoints, TheHeadlineIsARowOfItsOwnIfTheOthersHaveExactLaws) {
  const Analysis a = analyse_fit(load_inputs(RECOIL_SOURCE_DIR "/fits/wall1990-molybdenum.toml"));
  ASSERT_FALSE(a.fitted.laws.empty());
  const UncertaintyResult assessed = assess_uncertainty(a.fitted, a.datasets, small(0));
  const std::vector<ComparisonRow>& rows = assessed.two_point.front().rows;
  ASSERT_EQ(rows.size(), 4U);
  for (const ComparisonRow& row : rows) {
    EXPECT_EQ(row.headline, row.row == CalibrationKind::fit);
    EXPECT_EQ(row.headline, row.theta == a.fitted.theta);
  }
}

TEST(TwoPoints, FullFitsInAValleyHaveNoStandardErrors) {
  Dataset data = synthetic::dataset({.diameters = {4.9e-6}, .velocities = {3.0, 3.0, 3.0, 3.0}});
  constexpr std::array measured = {0.600, 0.610, 0.590, 0.605};
  for (std::size_t i = 0; i < measured.size(); ++i) data.points[i].restitution = measured[i];
  const FitResult fitted = fit(make_model(synthetic::spec(), {data}), gather({data}));
  std::vector<TwoPointComparison> comparisons = compare_two_points(fitted);
  add_comparison_rows(fitted, comparisons);
  const std::vector<ComparisonRow>& rows = comparisons.front().rows;
  EXPECT_EQ(rows[0].failure, "too few points");
  EXPECT_TRUE(rows[0].theta.empty());
  for (const std::size_t k : {1, 2}) {
    EXPECT_TRUE(rows[k].standard_errors.empty());
    EXPECT_TRUE(rows[k].noise_known);
    EXPECT_EQ(rows[k].failure, "");
  }
}

TEST(Capture, StudentizedAndDeltaRestOnTheSameError) {
  const Case c = noisy_case();
  const UncertaintyResult result = assess_uncertainty(c.fitted, c.datasets, small(0));
  for (std::size_t k = 0; k < result.capture.size(); ++k) {
    const CaptureEstimate& at = result.capture[k];
    EXPECT_NEAR(std::log(*at[CaptureIntervalKind::delta].upper / at.value) / 1.959963985,
                result.bootstrap.capture_reference_error[k], 1e-9);
    // 39 replicates: the ends belong to the smallest and the largest pivot.
    double low = INFINITY;
    double high = -INFINITY;
    for (std::size_t i = 0; i < result.bootstrap.capture_velocity.size(); ++i) {
      const double pivot = std::log(result.bootstrap.capture_velocity[i][k] / at.value) /
                           result.bootstrap.capture_error[i][k];
      low = std::min(low, pivot);
      high = std::max(high, pivot);
    }
    const double error = result.bootstrap.capture_reference_error[k];
    const Interval& studentized = at[CaptureIntervalKind::studentized];
    ASSERT_TRUE(studentized.available());
    EXPECT_NEAR(*studentized.lower, at.value * std::exp(-error * high), 1e-9 * at.value);
    EXPECT_NEAR(*studentized.upper, at.value * std::exp(-error * low), 1e-9 * at.value);
  }
}

TEST(Capture, SaysWhetherAParameterRestsOnItsBound) {
  Case c = noisy_case();
  CaptureEstimate at = assess_uncertainty(c.fitted, c.datasets, small(0)).capture.front();
  for (const bool resting : {false, true}) {
    c.fitted.at_bound.assign(c.fitted.theta.size(), false);
    c.fitted.at_bound[0] = resting;
    recommend_capture(c.fitted, true, at);
    EXPECT_EQ(at.recommended, CaptureIntervalKind::percentile);
    EXPECT_EQ(at.because, resting ? CaptureBecause::at_bound : CaptureBecause::bend);
  }
}

/// The recommended interval, moved to estimate -+ half.
void set_interval(UncertaintyResult& result, std::size_t slot, double lower, double upper) {
  Interval& interval = result.intervals[slot][result.intervals[slot].recommended];
  interval.lower = lower;
  interval.upper = upper;
}

TEST(Identifiability, AsksForAnIntervalWithinATenthOfTheValue) {
  Case c = noisy_case();
  UncertaintyResult result = assess_uncertainty(c.fitted, c.datasets, small(0));
  ASSERT_TRUE(c.fitted.data.noise.sd_stated);
  for (const std::size_t slot : {std::size_t{0}, std::size_t{1}}) {
    const double value = c.fitted.theta[slot];
    for (const double part : {0.099, 0.101}) {
      // 1.959964: the normal quantile of 97.5 %
      set_interval(result, slot, value * (1.0 - 1.959964 * part), value * (1.0 + 1.959964 * part));
      const Identifiability verdict =
          judge_identifiability(c.fitted, result.intervals, result.capture, 0.95);
      EXPECT_EQ(verdict.parameter[slot].identifiable, part < 0.1) << slot;
      EXPECT_NEAR(verdict.parameter[slot].relative_error, part, 1e-6);
    }
  }
}

TEST(Identifiability, ALimitIsNotWellDetermined) {
  Case c = noisy_case();
  UncertaintyResult result = assess_uncertainty(c.fitted, c.datasets, small(0));
  set_interval(result, 0, 0.0, 1.001 * c.fitted.theta[0]);
  const Identifiability verdict =
      judge_identifiability(c.fitted, result.intervals, result.capture, 0.95);
  EXPECT_FALSE(verdict.parameter[0].identifiable);
  EXPECT_EQ(verdict.parameter[0].hindrance, Hindrance::consistent_with_zero);
}

TEST(Identifiability, NothingIsWellDeterminedByAModelThatDoesNotFit) {
  Case c = noisy_case();
  UncertaintyResult result = assess_uncertainty(c.fitted, c.datasets, small(0));
  for (const std::size_t slot : {std::size_t{0}, std::size_t{1}}) {
    set_interval(result, slot, 0.99 * c.fitted.theta[slot], 1.01 * c.fitted.theta[slot]);
  }
  for (const double p_value : {0.5, 1e-6}) {
    c.fitted.p_value = p_value;
    const Identifiability verdict =
        judge_identifiability(c.fitted, result.intervals, result.capture, 0.95);
    EXPECT_EQ(verdict.rejected, p_value < 0.01);
    EXPECT_EQ(verdict.parameter[0].identifiable, p_value > 0.01);
    EXPECT_EQ(verdict.verdict == IdentifiabilityVerdict::identifiable, p_value > 0.01);
  }
}

TEST(Identifiability, ComparesEveryImpactWithTheCaptureOfItsOwnSize) {
  Case c = noisy_case();
  UncertaintyResult result = assess_uncertainty(c.fitted, c.datasets, small(0));
  for (Observation& point : c.fitted.data.points) {  // every size at velocities of its own
    point.velocity *= point.diameter / 1e-6;
  }
  const auto slowest_over = [&](double first, double others) {
    for (CaptureEstimate& at : result.capture) {
      double slowest = INFINITY;
      for (const Observation& point : c.fitted.data.points) {
        if (point.diameter == at.diameter) slowest = std::min(slowest, point.velocity);
      }
      at.found = true;
      at.value = slowest / (&at == &result.capture.front() ? first : others);
    }
    return judge_identifiability(c.fitted, result.intervals, result.capture, 0.95).slowest;
  };
  ASSERT_GT(result.capture.size(), 1U);
  ASSERT_TRUE(slowest_over(4.0, 6.0));
  EXPECT_NEAR(*slowest_over(4.0, 6.0), 4.0, 1e-12);
  EXPECT_NEAR(*slowest_over(6.0, 4.0), 4.0, 1e-12);
  EXPECT_FALSE(slowest_over(6.0, 1.2));
}

TEST(Identifiability, DoesNotTrustSurvivorsOfImpactsThatDifferMuch) {
  Case c = noisy_case();
  const UncertaintyResult result = assess_uncertainty(c.fitted, c.datasets, small(0));
  for (const double spread : {0.15, 0.3}) {
    c.fitted.weights.noise.event_spread = spread;
    const Identifiability verdict =
        judge_identifiability(c.fitted, result.intervals, result.capture, 0.95);
    EXPECT_EQ(verdict.parameter[0].identifiable, spread < 0.2);
    EXPECT_EQ(verdict.parameter[0].hindrance == Hindrance::wide_spread, spread > 0.2);
    EXPECT_EQ(verdict.event_spread, spread);
    const auto estimates = capture_estimates(fit_alternatives(c.fitted), 0.95, c.datasets);
    const auto note = estimates.front()[CaptureIntervalKind::delta].note;
    EXPECT_EQ(note && note->caution == Caution::wide_spread, spread > 0.2);
  }
}

TEST(CaptureEstimates, SayWherePointsMixSizes) {
  Case c = noisy_case();
  const auto caution_of = [&](bool mixed) {
    c.fitted.model.surroundings.resize(1);
    c.fitted.model.surroundings[0].sizes.spread = mixed ? 0.35 : 0.0;
    const auto estimates = capture_estimates(fit_alternatives(c.fitted), 0.95, c.datasets);
    const auto note = estimates.front()[CaptureIntervalKind::delta].note;
    return note && note->caution == Caution::mixed_sizes;
  };
  EXPECT_TRUE(caution_of(true));
  EXPECT_FALSE(caution_of(false));
}

TEST(Profile, RisesByTheQuantileAtItsEnds) {
  const Case c = noisy_case();
  for (std::size_t slot = 0; slot < 2; ++slot) {
    const Interval interval = profile_interval(c.fitted, slot, 0.95);
    ASSERT_TRUE(interval.available());
    EXPECT_EQ(interval.shape, ProfileShape::bounded);
    for (const double end : {*interval.lower, *interval.upper}) {
      // Refit with the slot held at the end, through the public fit only.
      ImpactModel held = c.fitted.model;
      held.slots[slot].free = false;
      held.slots[slot].initial = end;
      const FitResult refit = fit(held, c.data);
      const double rise = refit.chi2 - c.fitted.chi2;
      const double scale = c.fitted.noise_scale * c.fitted.noise_scale;
      EXPECT_NEAR(rise / scale, 3.841458821, 0.02);
    }
  }
}

TEST(Profile, CurveIsTheRiseOfRefitsWithTheSlotHeld) {
  const Case c = noisy_case();
  const double scale = c.fitted.noise_scale * c.fitted.noise_scale;
  for (std::size_t slot = 0; slot < 2; ++slot) {
    const Interval interval = profile_interval(c.fitted, slot, 0.95);
    const std::vector<ProfilePoint> curve = profile_curve(c.fitted, slot, 0.95, interval);
    ASSERT_EQ(curve.size(), 29U);
    EXPECT_EQ(curve[14].value, c.fitted.theta[slot]);
    EXPECT_EQ(curve[14].rise, 0.0);
    EXPECT_LT(curve.front().value, *interval.lower);
    EXPECT_GT(curve.back().value, *interval.upper);
    for (std::size_t k = 1; k < curve.size(); ++k) {
      EXPECT_GT(curve[k].value, curve[k - 1].value);
      EXPECT_EQ(curve[k].rise > curve[k - 1].rise, k > 14) << "falls to the estimate, then rises";
      const bool at_end = k == 4 || k == 24;  // 10 of 14 steps reach 1.4 / 1.4 of the way
      const bool inside = k > 4 && k < 24;
      if (at_end) {
        EXPECT_NEAR(curve[k].rise / curve[k].allowed, 1.0, 0.002);
      } else {
        EXPECT_EQ(curve[k].rise < curve[k].allowed, inside) << k;
      }
      EXPECT_NEAR(curve[k].allowed, 3.841458821, 1e-6);
    }
    for (const std::size_t k : {0U, 7U, 21U}) {
      ImpactModel held = c.fitted.model;
      held.slots[slot].free = false;
      held.slots[slot].initial = curve[k].value;
      const FitResult refit = fit(held, c.data);
      EXPECT_NEAR(curve[k].rise, (refit.chi2 - c.fitted.chi2) / scale, 0.01);
    }
  }
}

/// Polystyrene on silicon read by a velocimeter with an error of -0.08 m/s, and the fit of that
/// error. Some of the points are captures: beyond the end of its interval, the model takes one of
/// them for a rebound, and refits find another minimum.
Case misread_velocities(std::uint64_t seed) {
  constexpr double error = -0.08;  // [m/s]
  Truth truth;
  truth.density = 1050.0;
  truth.stiffness = 4.069e9;
  truth.adhesion_force = 11.5;
  truth.reference_diameter = 4.9e-6;
  truth.C_H = 3e-3;
  truth.C_A = 0.03;
  Dataset data = synthetic::dataset({});
  data.system.particle = {"polystyrene", truth.density, 2.78e9, 0.33, std::nullopt};
  data.system.surface = {"silicon", 0.0, 129e9, 0.28, std::nullopt};
  data.system.stiffness_K = truth.stiffness;
  data.system.adhesion_force_f0 = truth.adhesion_force;
  data.series = {"2", "4.9", "9.8"};
  data.points.clear();
  RandomStream random(seed, RandomPurpose::coverage, 0);
  for (const double um : {2.0, 4.9, 9.8}) {
    for (int i = 0; i < 12; ++i) {
      const double slowest = 2.1375 * std::pow(2.0 / um, 1.25);
      const double v = slowest * std::pow(25.0 / slowest, i / 11.0);
      const double e = true_restitution(truth, um * 1e-6, v);
      ImpactPoint point;
      point.series = um == 2.0 ? 0 : um == 4.9 ? 1 : 2;
      point.diameter = um * 1e-6;
      point.incident_velocity = v + error;
      point.events = 20;
      point.counted = true;
      if (e > 0.0) {
        point.restitution = (e * v + error) / (v + error) + 0.006 * random.normal();
        point.restitution_sd = 0.006;
      } else {
        point.captured = 20;
      }
      data.points.push_back(point);
    }
  }
  FitSpec spec = synthetic::spec();
  spec.mechanisms = {"velocity_offset"};
  spec.parameters.clear();
  for (const Parameter* parameter : parameters_with(spec.mechanisms, spec.adhesion)) {
    spec.parameters.push_back(default_of(*parameter));
    if (parameter->name == "f0") spec.parameters.back().free = false;
  }
  Case c;
  c.datasets = {data};
  c.data = gather(c.datasets);
  c.fitted = fit(make_model(spec, c.datasets), c.data);
  return c;
}

TEST(Profile, EndsWhereRefitsDoIfAnotherMinimumLiesBehind) {
  for (const std::uint64_t seed : {1U, 8U}) {
    const Case c = misread_velocities(seed);
    for (const char* name : {"C_A", "velocity_error"}) {
      const auto slot = static_cast<std::size_t>(
          std::find_if(c.fitted.model.slots.begin(), c.fitted.model.slots.end(),
                       [&](const ParameterSlot& s) { return s.parameter->name == name; }) -
          c.fitted.model.slots.begin());
      const Interval interval = profile_interval(c.fitted, slot, 0.95);
      ASSERT_TRUE(interval.available());
      EXPECT_EQ(interval.shape, ProfileShape::bounded);
      for (const double end : {*interval.lower, *interval.upper}) {
        // From the estimate to the end in short steps, through the public fit only.
        FitOptions from_there;
        from_there.several_starts = false;
        FitResult refit = c.fitted;
        constexpr int steps = 20;
        for (int k = 1; k <= steps; ++k) {
          ImpactModel held = c.fitted.model;
          for (std::size_t j = 0; j < held.slots.size(); ++j)
            held.slots[j].initial = refit.theta[j];
          held.slots[slot].free = false;
          held.slots[slot].initial =
              c.fitted.theta[slot] + k * (end - c.fitted.theta[slot]) / steps;
          refit = fit(held, c.data, from_there);
        }
        EXPECT_NEAR(refit.chi2 - c.fitted.chi2, 3.841458821, 0.01) << name << " " << seed;
      }
    }
  }
}

TEST(Profile, StopsAtABoundAndSaysSo) {
  Case c;
  Design design;
  design.C_A = 0.0;
  c.datasets = {synthetic::dataset(design)};
  c.data = gather(c.datasets);
  c.fitted = fit(make_model(synthetic::spec(), c.datasets), c.data);
  const Interval interval = profile_interval(c.fitted, 1, 0.95);
  ASSERT_TRUE(interval.available());
  EXPECT_EQ(*interval.lower, 0.0);
  EXPECT_EQ(interval.shape, ProfileShape::one_sided);
  EXPECT_GT(*interval.upper, 0.0);
  const std::vector<ProfilePoint> curve = profile_curve(c.fitted, 1, 0.95, interval);
  for (const ProfilePoint& point : curve) EXPECT_GE(point.value, 0.0);
}

/// A fit to points without noise, whose estimate is C_H = `errors` of its standard errors above 0.
Case above_the_bound(double errors) {
  Case c;
  Design design;
  design.C_H = 1e-3;
  for (int i = 0; i < 3; ++i) {  // the error hardly depends on C_H
    c.datasets = {synthetic::dataset(design)};
    c.data = gather(c.datasets);
    c.fitted = fit(make_model(synthetic::spec(), c.datasets), c.data);
    design.C_H = errors * c.fitted.std_error[0];
  }
  return c;
}

TEST(Profile, IsCalibratedNearABoundWithAllOtherParametersMoving) {
  // C_A rests on its bound; what it would scatter by without it decides how far the profile may
  // rise, and that takes C_H as unknown, too: 1 / error^2 = |J_A|^2 - (J_A . J_H)^2 / |J_H|^2.
  Case c;
  Design design;
  design.C_A = 0.0;
  c.datasets = {synthetic::dataset(design)};
  for (ImpactPoint& point : c.datasets[0].points) {  // adhesion that adds energy would fit better
    if (point.incident_velocity < 7.0) point.restitution += 0.01;
  }
  c.data = gather(c.datasets);
  c.fitted = fit(make_model(synthetic::spec(), c.datasets), c.data);
  ASSERT_TRUE(c.fitted.at_bound[1]);
  ASSERT_GT(c.fitted.std_error[0], 0.0);
  const std::size_t n = c.data.points.size();
  const std::size_t p = c.fitted.theta.size();
  std::vector<double> residuals(n);
  std::vector<double> jacobian(n * p);
  ASSERT_TRUE(impact_problem(c.fitted.model, c.data, c.fitted.weights)
                  .evaluate(c.fitted.theta, residuals, jacobian));
  double HH = 0.0, HA = 0.0, AA = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    HH += jacobian[i * p] * jacobian[i * p];
    HA += jacobian[i * p] * jacobian[i * p + 1];
    AA += jacobian[i * p + 1] * jacobian[i * p + 1];
  }
  EXPECT_GT(HA * HA / (HH * AA), 0.1) << "C_H has to matter for this to be a test";
  const double error = 1.0 / std::sqrt(AA - HA * HA / HH);
  const Interval interval = profile_interval(c.fitted, 1, 0.95);
  int between = 0;
  for (const ProfilePoint& point : profile_curve(c.fitted, 1, 0.95, interval)) {
    EXPECT_NEAR(point.allowed, profile_quantile(0.95, 0, point.value / error), 1e-6);
    between += point.allowed > 2.8 && point.allowed < 3.8 ? 1 : 0;
  }
  EXPECT_GT(between, 3) << "points at which the distance from the bound counts";
}

TEST(Profile, ExcludesTheBoundAsAOneSidedTestWould) {
  // Two-sided everywhere else, a truth on the bound can only be missed from above: the limit is
  // 1.645 errors, not 1.960 (see profile_quantile).
  const Case clear = above_the_bound(1.75);
  const Interval excluded = profile_interval(clear.fitted, 0, 0.95);
  ASSERT_TRUE(excluded.available());
  EXPECT_GT(*excluded.lower, 0.0);
  EXPECT_EQ(excluded.shape, ProfileShape::bounded);
  const Case close = above_the_bound(1.55);
  const Interval reaching = profile_interval(close.fitted, 0, 0.95);
  ASSERT_TRUE(reaching.available());
  EXPECT_EQ(*reaching.lower, 0.0);
  EXPECT_EQ(reaching.shape, ProfileShape::one_sided);
}

TEST(Assessment, HoldsOutDiametersAndExplainsMissingIntervals) {
  const Case c = noisy_case();
  const UncertaintyResult result = assess_uncertainty(c.fitted, c.datasets, small(0));
  const TwoPointComparison& comparison = result.two_point.front();
  ASSERT_EQ(comparison.result.status, TwoPointStatus::converged);
  ASSERT_TRUE(comparison.held_out_rmse && comparison.full_held_out_rmse);
  EXPECT_GT(comparison.rmse, 0.0);
  // The full fit minimises over all points; no two-point calibration can have a smaller rms there
  // (up to the difference between weighted and unweighted residuals, equal weights here).
  EXPECT_LE(comparison.full_rmse, comparison.rmse * (1.0 + 1e-3));
  EXPECT_GT(comparison.spread[1], comparison.full_spread[1]);
  for (const IntervalKind kind : values_of<IntervalKind>()) {
    EXPECT_FALSE(result.intervals[2][kind].available());
    EXPECT_EQ(result.intervals[2][kind].missing, NoInterval::fixed);
  }
}

}  // namespace
}  // namespace recoil
