// The content of the pictures of a fit before they are drawn: axes, layers, numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "core/units.hpp"
#include "estimate/predictor.hpp"
#include "example_analysis.hpp"
#include "report/diagnosis_report.hpp"
#include "report/fit_report.hpp"

namespace recoil {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

template <class Kind>
std::vector<Kind> layers_of(const plot::Plot& shown) {
  std::vector<Kind> found;
  for (const plot::Layer& layer : shown.layers) {
    if (const auto* one = std::get_if<Kind>(&layer)) found.push_back(*one);
  }
  return found;
}

/// The layer of this kind and name; an empty layer if there is none.
template <class Kind>
Kind layer_named(const plot::Plot& shown, const std::string& name) {
  for (const Kind& one : layers_of<Kind>(shown)) {
    if (one.name == name) return one;
  }
  ADD_FAILURE() << "no layer " << name;
  return {};
}

const plot::Plot& plot_of(const Figure& figure, std::size_t index = 0) {
  return figure.picture.plots.at(index);
}

bool inside(double value, const plot::Axis& axis) {
  const double low = std::min(axis.from, axis.to);
  const double high = std::max(axis.from, axis.to);
  return value >= low && value <= high;
}

TEST(RestitutionFigures, ShowEveryPointOnce) {
  const Analysis analysis = sample::four_diameters();
  const std::vector<Figure> figures = restitution_figures(analysis);
  ASSERT_EQ(figures.size(), 4U);
  std::size_t shown = 0;
  for (const Figure& figure : figures) {
    const plot::Plot& plot = plot_of(figure);
    EXPECT_TRUE(plot.x.logarithmic);
    EXPECT_EQ(plot.x.unit, "m/s");
    EXPECT_EQ(plot.y.from, 0.0);
    std::size_t here = 0;
    for (const plot::Points& points : layers_of<plot::Points>(plot)) {
      here += points.x.size();
      for (std::size_t i = 0; i < points.x.size(); ++i) {
        EXPECT_TRUE(inside(points.x[i], plot.x)) << points.x[i];
        EXPECT_TRUE(inside(points.y[i], plot.y)) << points.y[i];
      }
    }
    EXPECT_THAT(plain_text(figure.caption), HasSubstr(": " + std::to_string(here) + " points."));
    shown += here;
  }
  EXPECT_EQ(shown, analysis.fitted.data.points.size());
}

// The mean of the rebounds falls towards capture. It rises again because slow ones are missing.
TEST(RestitutionFigures, SayWhyAMeanOverSizesRisesAgain) {
  Analysis analysis = sample::four_diameters();
  const auto caption = [&] { return plain_text(restitution_figures(analysis).front().caption); };
  EXPECT_THAT(caption(), Not(HasSubstr("mean of the rebounds")));
  MixedSizes& sizes = analysis.fitted.model.surroundings[0].sizes;
  sizes.spread = 0.2;
  EXPECT_THAT(caption(), HasSubstr("it rises again where slow ones are not."));
  EXPECT_THAT(caption(), Not(HasSubstr("Rebounds below")));
  sizes.slowest_seen = std::sqrt(2.0 * 9.80665 * 1e-3);  // a plane 1 mm above the surface
  EXPECT_THAT(caption(),
              HasSubstr("Rebounds below 0.14 m/s are not seen, so e is at least 0.14 m/s over V."));
}

TEST(RestitutionFigures, ErrorBarsAreOneStandardDeviation) {
  const Analysis analysis = sample::four_diameters();
  ASSERT_TRUE(analysis.fitted.data.noise.sd_stated);
  const auto points = layers_of<plot::Points>(plot_of(restitution_figures(analysis).front()));
  ASSERT_FALSE(points.empty());
  const Observation& first = analysis.fitted.data.points.front();
  EXPECT_DOUBLE_EQ(points[0].x[0], first.velocity);
  EXPECT_DOUBLE_EQ(points[0].y[0], first.restitution);
  EXPECT_NEAR(points[0].upper[0] - points[0].lower[0], 2.0 * first.sd, 1e-12);
}

TEST(RestitutionFigures, TheCurveAndItsBandAreThoseOfTheFit) {
  const Analysis analysis = sample::four_diameters();
  const RestitutionCurve& curve = analysis.uncertainty.curves.front();
  const plot::Plot plot = plot_of(restitution_figures(analysis).front());
  const auto line = layer_named<plot::Line>(plot, "fit to all points");
  const auto band = layers_of<plot::Band>(plot).at(0);
  ASSERT_FALSE(line.x.empty());
  EXPECT_EQ(line.x.front(), curve.velocity.front());
  EXPECT_EQ(line.x.back(), curve.velocity.back());
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    const auto at = std::find(curve.velocity.begin(), curve.velocity.end(), line.x[i]);
    ASSERT_NE(at, curve.velocity.end());
    const auto k = static_cast<std::size_t>(at - curve.velocity.begin());
    EXPECT_EQ(line.y[i], curve.restitution[k]);
    EXPECT_EQ(band.lower[i], curve.lower[k]);
    EXPECT_EQ(band.upper[i], curve.upper[k]);
  }
}

TEST(RestitutionFigures, TheCaptureVelocityStandsInItsInterval) {
  const Analysis analysis = sample::four_diameters();
  const CaptureEstimate& capture = analysis.uncertainty.capture.front();
  ASSERT_TRUE(capture.found);
  const plot::Plot plot = plot_of(restitution_figures(analysis).front());
  const auto rules = layers_of<plot::Rule>(plot);
  const auto regions = layers_of<plot::Region>(plot);
  ASSERT_EQ(rules.size(), 1U);
  EXPECT_EQ(rules[0].at, capture.value);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_LE(*regions[0].left, rules[0].at);
  EXPECT_GE(*regions[0].right, rules[0].at);
}

TEST(RestitutionOverview, HasErrorBarsCapturesAndPointsAboveItsBands) {
  for (Analysis analysis : {sample::four_diameters(), sample::two_datasets()}) {
    for (Observation& point : analysis.fitted.data.points) {
      if (point.censored) point.captured = point.events;
    }
    const plot::Plot shown = restitution_overview(analysis, 392, 314).plots.at(0);
    const auto place_of = [&](std::size_t kind, bool last) {
      std::vector<std::size_t> found;
      for (std::size_t k = 0; k < shown.layers.size(); ++k) {
        if (shown.layers[k].index() == kind) found.push_back(k);
      }
      return found.empty() ? std::size_t{0} : last ? found.back() : found.front();
    };
    const std::size_t points = plot::Layer(plot::Points{}).index();
    const std::size_t bands = plot::Layer(plot::Band{}).index();
    ASSERT_FALSE(layers_of<plot::Band>(shown).empty());
    EXPECT_LT(place_of(bands, true), place_of(points, false));
    std::size_t drawn = 0;
    for (const plot::Points& one : layers_of<plot::Points>(shown)) {
      drawn += one.y.size();
      const bool captured = one.name == "captured";
      EXPECT_EQ(one.lower.empty(), captured || !analysis.fitted.data.noise.sd_stated);
    }
    EXPECT_EQ(drawn, analysis.fitted.data.points.size());
  }
}

TEST(RestitutionOverview, FitsItsAxisToThePointsUnlessTheyFall) {
  Analysis analysis = sample::four_diameters();
  const auto axis = [&] { return restitution_overview(analysis, 392, 314).plots.at(0).y; };
  EXPECT_EQ(axis().from, 0.0);
  // Rebounds between 0.90 and 0.94, far above capture.
  auto& points = analysis.fitted.data.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].restitution = 0.90 + 0.04 * static_cast<double>(i % 5) / 4.0;
    points[i].sd = 0.005;
    points[i].censored = false;
    points[i].velocity *= 1e3;
  }
  for (RestitutionCurve& curve : analysis.uncertainty.curves) {
    for (double& e : curve.restitution) e = 0.92;
  }
  EXPECT_GT(axis().from, 0.8);
  EXPECT_LT(axis().from, 0.895);
  EXPECT_GT(axis().to, 0.945);
  EXPECT_LT(axis().to, 1.0);
  points.front().restitution = 0.2;
  EXPECT_EQ(axis().from, 0.0);
}

TEST(RestitutionOverview, NamesDatasetsByColourAndSizesByDash) {
  const plot::Plot shown = restitution_overview(sample::two_datasets(), 392, 314).plots.at(0);
  std::map<std::string, std::string_view> dashes;
  for (const plot::Line& line : layers_of<plot::Line>(shown)) {
    if (!line.name.empty()) dashes.emplace(line.name, line.stroke.dash);
  }
  ASSERT_FALSE(dashes.empty());
  std::set<std::string_view> distinct;
  for (const auto& [name, dash] : dashes) distinct.insert(dash);
  EXPECT_EQ(distinct.size(), dashes.size());
}

TEST(ResidualFigures, LieAboutZeroWithLinesAtTwo) {
  {
    const auto figures = residual_figures(sample::four_diameters());
    ASSERT_EQ(figures.size(), 1U);
    const plot::Plot& plot = plot_of(figures[0]);
    EXPECT_EQ(plot.y.from, -plot.y.to);
    std::vector<double> places;
    for (const plot::Rule& rule : layers_of<plot::Rule>(plot)) places.push_back(rule.at);
    EXPECT_THAT(places, ElementsAre(-2.0, 2.0, 0.0));
  }
}

TEST(MisfitFigures, ShowEveryPointAtItsDiameter) {
  Diagnosis d;
  for (const double diameter : {3e-6, 8e-6}) {
    Observation point;
    point.diameter = diameter;
    point.velocity = 2.0;
    point.restitution = 0.5;
    point.sd = 0.05;
    d.base.data.points.push_back(point);
    d.base.weights.points.emplace_back().sd = point.sd;
    d.base.prediction_squared.push_back(0.36);
  }
  d.datasets.resize(1);
  const plot::Plot map = plot_of(misfit_figures(d).at(0));
  const plot::Discs discs = layers_of<plot::Discs>(map).at(0);
  EXPECT_THAT(discs.y, ElementsAre(DoubleNear(3.0, 1e-9), DoubleNear(8.0, 1e-9)));  // um
  EXPECT_THAT(discs.x, ElementsAre(2.0, 2.0));
  EXPECT_EQ(map.y.unit, "µm");
  EXPECT_TRUE(inside(3.0, map.y) && inside(8.0, map.y));
}

/// The sample with an error of the laws of 3 % that bends over 1.6 in ln V, the coefficients z of
/// which have the variance `variance`; laws are exact with a probability of 0.1 %.
Analysis with_wrong_laws(double variance) {
  Analysis a = sample::four_diameters();
  FitResult& f = a.fitted;
  const LawErrorPrior prior{.size = 0.03, .length = 1.6};
  f.model = with_law_error(with_exact_materials(f.model), prior, f.data.conditions());
  const std::size_t slots = f.model.slots.size(), first = f.model.first_law_slot();
  f.theta.resize(first);
  f.theta.resize(slots, 0.0);
  f.theta[first] = 1.0;
  f.std_error.assign(slots, 0.0);
  f.covariance.assign(slots * slots, 0.0);
  for (std::size_t j = first; j < slots; ++j) f.covariance[j * slots + j] = variance;
  f.constant_effects.clear();
  f.constants_moved.assign(slots - first, 0.0);
  f.quantile_dof = 0;
  f.laws = {{{}, 0.001, {}}, {prior, 0.999, {}}};
  return a;
}

// The first function of the error belongs to the smallest size, one unit of ln V below its slowest
// point: g = 0.03 exp(-(ln V - ln V_0)^2 / (2 1.6^2)). All functions together have the variance
// 0.03^2, to one part in a thousand.
TEST(LawErrorFigures, ShowTheErrorWithItsBandAndThePointsInUnitsOfTheLoss) {
  const Analysis a = with_wrong_laws(0.04);
  const std::vector<Figure> figures = law_error_figures(a);
  ASSERT_EQ(figures.size(), 1U);
  const plot::Plot& shown = plot_of(figures.front());
  const auto lines = layers_of<plot::Line>(shown);
  const auto bands = layers_of<plot::Band>(shown);
  const auto points = layers_of<plot::Points>(shown);
  ASSERT_EQ(lines.size(), 4U);
  ASSERT_EQ(points.size(), 4U);
  const double start = std::log(lines[0].x.front()) - 1.0;
  for (std::size_t k = 0; k < lines[0].x.size(); ++k) {
    const double away = (std::log(lines[0].x[k]) - start) / 1.6;
    EXPECT_NEAR(lines[0].y[k], 3.0 * std::exp(-0.5 * away * away), 1e-9);
    EXPECT_NEAR(bands[0].upper[k] - lines[0].y[k], 1.959964 * 0.2 * 3.0, 2e-3);
    EXPECT_NEAR(lines[0].y[k] - bands[0].lower[k], 1.959964 * 0.2 * 3.0, 2e-3);
  }
  const ImpactModel exact = with_exact_laws(a.fitted.model);
  const std::vector<double> theta(a.fitted.theta.begin(),
                                  a.fitted.theta.begin() + std::ptrdiff_t(exact.slots.size()));
  const Observation& first = a.fitted.data.points.front();
  const double square =
      predict(exact, theta, 0, first.diameter, first.velocity, false).restitution_squared;
  const double e = first.restitution;
  EXPECT_EQ(points[0].x[0], first.velocity);
  EXPECT_NEAR(points[0].y[0], 100.0 * (square - e * e) / (1.0 - square), 1e-9);
  EXPECT_NEAR(points[0].upper[0] - points[0].y[0], 100.0 * 2.0 * e * first.sd / (1.0 - square),
              1e-9);
  for (const plot::Points& one : points) {
    for (const double y : one.y) EXPECT_TRUE(inside(y, shown.y));
  }
}

TEST(LawErrorFigures, AreMissingWhereNoErrorIsSeen) {
  Analysis a = with_wrong_laws(0.04);
  a.fitted.laws[0].weight = 0.2;
  a.fitted.laws[1].weight = 0.8;
  EXPECT_TRUE(law_error_figures(a).empty());
  EXPECT_TRUE(law_error_figures(sample::four_diameters()).empty());
}

}  // namespace
}  // namespace recoil
