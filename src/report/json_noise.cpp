#include "report/json_noise.hpp"

#include <algorithm>

#include "estimate/reweighting.hpp"
#include "report/json_values.hpp"
#include "report/words_noise.hpp"

namespace recoil {

Json noise_json(const Analysis& a) {
  const Observations& data = a.fitted.data;
  const NoiseModel& noise = data.noise;
  Json out;
  out["variance"] = to_string(noise.variance);
  out["chosen"] = !noise.candidates.empty();
  put(out, "scale", data.sd_stated ? NAN : noise.scale, "the standard deviations are stated");
  out["scale_text"] = scale_words(noise.variance, noise.scale);
  Json candidates = Json::array();
  for (const VarianceCandidate& candidate : noise.candidates) {
    candidates.push_back({{"variance", to_string(candidate.function)},
                          {"scale", number_or_null(candidate.scale)},
                          {"criterion", number_or_null(candidate.criterion)},
                          {"handicap", penalty_of(candidate.function)}});
  }
  out["candidates"] = candidates;
  put(out, "margin", noise.candidates.size() > 1 ? choice_margin(noise) : NAN,
      "nothing was chosen");
  const auto with = [&](double MeasuredPoint::*error) {
    return std::count_if(data.points.begin(), data.points.end(),
                         [&](const Observation& point) { return point.*error > 0.0; });
  };
  out["points_with_velocity_errors"] = with(&MeasuredPoint::velocity_sd);
  out["points_with_diameter_errors"] = with(&MeasuredPoint::diameter_sd);
  put(out, "event_spread", noise.event_spread > 0.0 ? noise.event_spread : NAN,
      "no point has both rebounds and captures");
  put(out, "setting_sd", data.shares_settings() ? noise.setting_sd : NAN,
      "the points of one setting are taken to share no error");
  out["setting_sd_estimated"] = data.setting_sd_estimated;
  out["residuals"] = noise.student ? "student" : "normal";
  put(out, "student_dof", noise.student ? noise.student->dof : NAN, "normal residuals");
  put(out, "efficiency", noise.student ? noise.student->efficiency() : 1.0, "");
  out["text"] = noise_words(a.fitted);
  return out;
}

}  // namespace recoil
