#include "estimate/noise_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "estimate/noise.hpp"

namespace recoil {
namespace {

// An outlier share and size that are usual examples (Huber 1981): one point in ten, three times the
// standard deviation.
constexpr double outlier_share = 0.1;
constexpr double outlier_factor = 3.0;
// Curvature over the errors of V and d that is worth a warning, in sd of the point's e^2.
constexpr double strained = 0.1;
// A likelihood ratio of e^(4/2), about 7 to 1, is worth the word "clear".
constexpr double clear = 4.0;

std::string variance_words(const Observations& data) {
  const NoiseModel& noise = data.noise;
  std::string text =
      "the noise is estimated from the residuals: " + scale_in_words(noise.variance, noise.scale);
  if (data.spec.variance)
    return text + fmt::format(" ({}, as asked for)", to_string(noise.variance));
  if (noise.candidates.empty()) return text;
  std::string others;
  for (const VarianceCandidate& candidate : noise.candidates) {
    if (candidate.function == noise.variance) continue;
    others += fmt::format("{}{}", others.empty() ? "" : " and ", to_string(candidate.function));
  }
  const double margin = choice_margin(noise);
  return text + fmt::format(" ({}, chosen before {} by {:.1f} on -2 ln restricted likelihood{})",
                            to_string(noise.variance), others, margin,
                            margin < clear ? ", which is no clear decision" : "");
}

std::string input_words(const std::vector<Observation>& points) {
  double most = 0.0;
  int count = 0;
  for (const Observation& point : points) {
    if (!(point.input_sd > 0.0) || point.censored) continue;
    ++count;
    const double width = std::max(2.0 * point.restitution, point.sd) * point.sd;
    most = std::max(most, point.input_sd / width);
  }
  if (count == 0) return "";
  return fmt::format(
      "; errors of velocity and diameter reach e at {} points, with at most {:.2g} times the "
      "standard deviation of e itself",
      count, most);
}

std::string student_words(const StudentNoise& student) {
  return fmt::format(
      "; residuals are taken as Student's t with {:g} degrees of freedom: with normal noise this "
      "costs {:.0f} % of the precision (variances {:.2f} times larger), with one point in ten "
      "scattering three times as much the variances are {:.2f} times smaller than those of least "
      "squares",
      student.dof, 100.0 * (1.0 - student.efficiency()), 1.0 / student.efficiency(),
      gain_under_outliers(student, outlier_share, outlier_factor));
}

}  // namespace

std::string scale_in_words(VarianceFunction function, double scale) {
  switch (function) {
    case VarianceFunction::proportional:
      return fmt::format("sd(e) = {:.3g} e for every impact", scale);
    case VarianceFunction::capture:
      return fmt::format(
          "sd(e^2) = {:.3g} for every impact, so that e scatters more close to capture", scale);
    case VarianceFunction::steep:
      return fmt::format(
          "sd(e) = {:.3g} exp(2 (V* / V)^2) for every impact, so that e scatters sevenfold at "
          "capture",
          scale);
    case VarianceFunction::constant:
      return fmt::format("sd(e) = {:.3g} for every impact", scale);
    case VarianceFunction::stated:
      break;
  }
  return "sd(e) as stated";
}

double choice_margin(const NoiseModel& noise) {
  double own = 0.0;
  double other = INFINITY;
  for (const VarianceCandidate& candidate : noise.candidates) {
    if (candidate.function == noise.variance) {
      own = candidate.criterion + handicap(candidate.function);
    } else {
      other = std::min(other, candidate.criterion + handicap(candidate.function));
    }
  }
  return std::isfinite(other) ? other - own : 0.0;
}

void describe_noise(FitResult& result) {
  const Observations& data = result.data;
  if (!data.sd_stated && result.dof > 0) result.noise_text = variance_words(data);
  result.noise_text += input_words(data.points);
  if (data.noise.event_spread > 0.0) {
    result.noise_text += fmt::format(
        "; from impact to impact the capture velocity scatters by {:.1f} % (from the counts of "
        "captures), and means of survivors are compared with the expected means of survivors",
        100.0 * data.noise.event_spread);
  }
  if (data.points.empty()) return;
  if (data.points.front().student) result.noise_text += student_words(*data.points.front().student);
  const auto bent = std::count_if(data.points.begin(), data.points.end(), [](const Observation& p) {
    const double sd = std::hypot(std::max(2.0 * p.restitution, p.sd) * p.sd, p.input_sd);
    return std::abs(p.input_bias) > strained * sd;
  });
  if (bent > 0) {
    result.warnings.push_back(fmt::format(
        "at {} points the curve bends so much over the errors of velocity or diameter that their "
        "effective variance (first order) is biased by more than {:.1g} standard deviations: close "
        "to capture these errors are too large for it",
        bent, strained));
  }
}

}  // namespace recoil
