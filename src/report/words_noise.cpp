#include "report/words_noise.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "estimate/reweighting.hpp"
#include "estimate/shared_settings.hpp"

namespace recoil {
namespace {

// An outlier share and size that are usual examples (Huber 1981): one point in ten, three times the
// standard deviation.
constexpr double outlier_share = 0.1;
constexpr double outlier_factor = 3.0;
// A likelihood ratio of e^(4/2), about 7 to 1, is worth the word "clear".
constexpr double clear = 4.0;

std::string p_words(double p_value) {
  return p_value < 1e-6 ? "p < 1e-6" : fmt::format("p = {:.2g}", p_value);
}

std::string variance_words(const Observations& data) {
  const NoiseModel& noise = data.noise;
  const std::string text =
      "the noise is estimated from the residuals: " + scale_words(noise.variance, noise.scale);
  if (data.spec.variance) {
    return text + fmt::format(" ({}, as asked for)", name_of(noise.variance));
  }
  if (noise.candidates.empty()) return text;
  std::vector<std::string_view> others;
  for (const VarianceCandidate& candidate : noise.candidates) {
    if (candidate.function != noise.variance) others.push_back(name_of(candidate.function));
  }
  const double margin = choice_margin(noise);
  return text + fmt::format(" ({}, chosen over {} by {:.1f} in -2 ln restricted likelihood{})",
                            name_of(noise.variance), fmt::join(others, " and "), margin,
                            margin < clear ? ", which is not a clear decision" : "");
}

std::string verdict_words(const FitResult& fitted) {
  switch (fitted.noise_verdict) {
    case NoiseVerdict::unchecked:
      return "no more points that scatter than parameters: the noise cannot be checked";
    case NoiseVerdict::estimated:
      return variance_words(fitted.data);
    case NoiseVerdict::explained:
      return "the stated standard deviations explain the scatter";
    case NoiseVerdict::doubtful:
      return fmt::format(
          "the scatter is at the edge of what the stated standard deviations explain ({})",
          p_words(fitted.p_value));
    case NoiseVerdict::exceeded:
      return widened_words(fitted);
  }
  return "";
}

std::string input_words(const std::vector<Observation>& points) {
  double most = 0.0;
  int count = 0;
  for (const Observation& point : points) {
    const PointWeights& weights = point.weights;
    if (!(weights.input_sd > 0.0) || point.censored) continue;
    ++count;
    const double width = std::max(2.0 * point.restitution, weights.sd) * weights.sd;
    most = std::max(most, weights.input_sd / width);
  }
  if (count == 0) return "";
  return fmt::format(
      "; errors of velocity and diameter add to the error of e at {} points, by at most {:.2g} "
      "times the standard deviation of e itself",
      count, most);
}

std::string setting_words(const Observations& data) {
  if (!data.shares_settings()) return "";
  const SettingCount count = count_settings(data);
  const char* const how = data.setting_sd_estimated ? "estimated" : "stated";
  if (!(data.noise.setting_sd > 0.0)) {
    return fmt::format(
        "; the points of one setting share no error of e that could be seen ({}, {} settings, {} "
        "points)",
        how, count.settings, count.points);
  }
  return fmt::format(
      "; the points of one setting share an error of e of {:.2g} ({}, {} settings, {} points)",
      data.noise.setting_sd, how, count.settings, count.points);
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

std::string scale_words(VarianceFunction function, double scale) {
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

std::string widened_words(const FitResult& fitted) {
  return fmt::format(
      "the residuals are {:.3g} times larger than the stated noise explains ({}): every error and "
      "interval is widened by that factor, but still describes this model, not the truth",
      fitted.noise_scale, p_words(fitted.p_value));
}

std::string noise_words(const FitResult& fitted) {
  if (!fitted.usable) return "";
  const Observations& data = fitted.data;
  std::string text = verdict_words(fitted) + input_words(data.points);
  if (data.noise.event_spread > 0.0) {
    text += fmt::format(
        "; from impact to impact the capture velocity scatters by {:.1f} % (from the counts of "
        "captures), and means of survivors are compared with the expected means of survivors",
        100.0 * data.noise.event_spread);
  }
  text += setting_words(data);
  if (data.noise.student) text += student_words(*data.noise.student);
  return text;
}

}  // namespace recoil
