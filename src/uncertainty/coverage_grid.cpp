#include "uncertainty/coverage_grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gsl/gsl_spline.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "core/random.hpp"
#include "reconstruction/truth.hpp"
#include "uncertainty/coverage_truth.hpp"

namespace recoil {
namespace {

constexpr double lowest = 1.05;           // of the capture velocity, without captures
constexpr double lowest_captured = 0.85;  // with captures
constexpr double highest = 50.0;
constexpr int events = 40;
constexpr double velocity_scatter = 0.03;  // of the impacts that one point averages

double standard_deviation(GridNoise noise, double e, double velocity_ratio) {
  switch (noise) {
    case GridNoise::equal:
      return 0.02;
    case GridNoise::near_capture:
      return 0.01 * (1.0 + 4.0 / (velocity_ratio * velocity_ratio));
    case GridNoise::proportional:
      return 0.1 * e;
  }
  return 0.0;
}

/// e(V) of the truth, tabulated: e^2 V^2 against V^2 is nearly straight, so that Steffen's
/// monotone cubic is good to 1e-5 here.
class TrueCurve {
 public:
  TrueCurve(const Truth& truth, double diameter, double capture)
      : capture_(capture), spline_(gsl_spline_alloc(gsl_interp_steffen, nodes), gsl_spline_free) {
    std::vector<double> x, y;
    const double last = 1.3 * highest * capture;
    for (std::size_t i = 0; i < nodes; ++i) {
      const double part = static_cast<double>(i) / (nodes - 1.0);
      const double v = capture * std::pow(last / capture, part * part);  // denser near capture
      const double back = i == 0 ? 0.0 : v * true_restitution(truth, diameter, v);
      x.push_back(v * v);
      y.push_back(back * back);
    }
    gsl_spline_init(spline_.get(), x.data(), y.data(), nodes);
  }

  /// 0 when captured.
  double operator()(double v) const {
    if (v <= capture_) return 0.0;
    return std::sqrt(std::max(0.0, gsl_spline_eval(spline_.get(), v * v, nullptr))) / v;
  }

 private:
  static constexpr std::size_t nodes = 400;
  double capture_;
  std::unique_ptr<gsl_spline, void (*)(gsl_spline*)> spline_;
};

/// One point as an experiment would find it.
ImpactPoint measured_point(const TrueCurve& curve, const GridDesign& design, double diameter,
                           double velocity, double capture, RandomStream& random) {
  ImpactPoint point;
  point.diameter = diameter;
  point.incident_velocity = velocity;
  double e = curve(velocity);
  double variance_of_mean = 0.0;
  if (design.captures) {
    point.events = events;
    point.counted = true;
    double sum = 0.0;
    double squares = 0.0;
    for (int k = 0; k < events; ++k) {
      const double single = curve(velocity * (1.0 + velocity_scatter * random.normal()));
      if (single == 0.0) ++point.captured;
      sum += single;
      squares += single * single;
    }
    const int back = events - point.captured;
    if (back == 0) return point;
    e = sum / back;
    if (back > 1) variance_of_mean = std::max(0.0, squares - sum * e) / (back - 1.0) / back;
  }
  const double sd = standard_deviation(design.noise, e, velocity / capture);
  point.restitution = std::clamp(e + sd * random.normal(), 0.0, 1.2);
  if (design.sd_stated) point.restitution_sd = std::sqrt(sd * sd + variance_of_mean);
  return point;
}

}  // namespace

std::string to_string(GridNoise noise) {
  switch (noise) {
    case GridNoise::equal:
      return "equal";
    case GridNoise::near_capture:
      return "near-capture";
    case GridNoise::proportional:
      return "10 %";
  }
  return "";
}

std::string GridDesign::name() const {
  return fmt::format("n{} {} {} {}{}", points, to_string(noise), sd_stated ? "stated" : "estimated",
                     adhesion_free ? "f0-free" : "f0-fixed", captures ? " captures" : "");
}

std::vector<GridDesign> coverage_grid() {
  std::vector<GridDesign> designs;
  for (const int points : {10, 20, 60}) {
    for (const GridNoise noise :
         {GridNoise::equal, GridNoise::near_capture, GridNoise::proportional}) {
      for (const bool sd_stated : {true, false}) {
        for (const bool adhesion_free : {false, true}) {
          for (const bool captures : {false, true}) {
            designs.push_back({points, noise, sd_stated, adhesion_free, captures});
          }
        }
      }
    }
  }
  return designs;
}

std::vector<GridDesign> designs_named(const std::vector<std::string>& words) {
  const auto has = [](const GridDesign& design, const std::string& word) {
    return fmt::format(" {} ", design.name()).find(fmt::format(" {} ", word)) != std::string::npos;
  };
  std::vector<GridDesign> left = coverage_grid();
  const std::vector<std::string> known = {"n10",          "n20",     "n60",     "equal",
                                          "near-capture", "10 %",    "stated",  "estimated",
                                          "f0-fixed",     "f0-free", "captures"};
  for (const std::string& word : words) {
    const std::vector<GridDesign> all = coverage_grid();
    if (std::none_of(all.begin(), all.end(), [&](const GridDesign& d) { return has(d, word); })) {
      const std::string near = nearest_word(word, known);
      throw InputError(
          {}, fmt::format("--designs: no design has the word '{}'", word),
          fmt::format("there are: {}", fmt::join(known, ", ")),
          near.empty() ? "take words of this list" : fmt::format("did you mean '{}'?", near));
    }
    std::erase_if(left, [&](const GridDesign& design) { return !has(design, word); });
  }
  if (left.empty()) {
    throw InputError({}, fmt::format("--designs: no design is all of {}", fmt::join(words, ", ")),
                     "a design has one number of points, one kind of scatter and so on",
                     "leave one of them out");
  }
  return left;
}

FitSpec grid_spec(const FitSpec& spec, const GridDesign& design) {
  FitSpec own = spec;
  for (ParameterSpec& parameter : own.parameters) {
    if (parameter.name != "f0") continue;
    parameter.free = design.adhesion_free;
    if (parameter.free && !(parameter.upper > parameter.lower)) {
      parameter.lower = 1e-6;
      parameter.upper = 1e6;
    }
  }
  return own;
}

CoverageTruth grid_truth(const FitSpec& spec, const Dataset& base, const GridDesign& design,
                         std::uint64_t seed) {
  const EstimatedTruth found = truth_at_estimate(spec, {base}, gather({base}, spec.noise));
  const Truth& truth = found.truths.front();
  CoverageTruth study;
  study.source =
      fmt::format("the estimate for `{}` as truth, simulated independently of the fitter", base.id);
  study.theta = found.fitted.theta;
  const std::vector<double> diameters = distinct_diameters(base);
  const double diameter = diameters[diameters.size() / 2];
  const double capture = true_capture_velocity(truth, diameter);
  study.capture = {{diameter, capture}};
  Dataset empty = base;
  empty.points.clear();
  empty.series = {"simulated"};
  const auto curve = std::make_shared<const TrueCurve>(truth, diameter, capture);
  study.simulate = [empty, design, seed, diameter, capture, curve](std::uint64_t index) {
    RandomStream random(seed, RandomPurpose::coverage, index);
    Dataset made = empty;
    const double first = design.captures ? lowest_captured : lowest;
    for (int i = 0; i < design.points; ++i) {
      const double velocity =
          capture * first * std::pow(highest / first, i / (design.points - 1.0));
      made.points.push_back(measured_point(*curve, design, diameter, velocity, capture, random));
    }
    return std::vector<Dataset>{made};
  };
  return study;
}

}  // namespace recoil
