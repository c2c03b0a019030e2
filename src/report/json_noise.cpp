#include <algorithm>

#include "estimate/noise.hpp"
#include "estimate/noise_words.hpp"
#include "report/json_values.hpp"

namespace recoil {

Json noise_json(const Analysis& a) {
  const Observations& data = a.data;
  const NoiseModel& noise = data.noise;
  Json out;
  out["variance"] = to_string(noise.variance);
  out["chosen"] = !noise.candidates.empty();
  put(out, "scale", data.sd_stated ? NAN : noise.scale, "the standard deviations are stated");
  out["scale_text"] = scale_in_words(noise.variance, noise.scale);
  Json candidates = Json::array();
  for (const VarianceCandidate& candidate : noise.candidates) {
    candidates.push_back({{"variance", to_string(candidate.function)},
                          {"scale", number_or_null(candidate.scale)},
                          {"criterion", number_or_null(candidate.criterion)},
                          {"handicap", handicap(candidate.function)}});
  }
  out["candidates"] = candidates;
  put(out, "margin", noise.candidates.size() > 1 ? choice_margin(noise) : NAN,
      "nothing was chosen");
  const auto with = [&](double Observation::*error) {
    return std::count_if(data.points.begin(), data.points.end(),
                         [&](const Observation& point) { return point.*error > 0.0; });
  };
  out["points_with_velocity_errors"] = with(&Observation::velocity_sd);
  out["points_with_diameter_errors"] = with(&Observation::diameter_sd);
  put(out, "event_spread", noise.event_spread > 0.0 ? noise.event_spread : NAN,
      "no point has both rebounds and captures");
  const bool student = !data.points.empty() && data.points.front().student.has_value();
  out["residuals"] = student ? "student" : "normal";
  put(out, "student_dof", student ? data.points.front().student->dof : NAN, "normal residuals");
  put(out, "efficiency", student ? data.points.front().student->efficiency() : 1.0, "");
  out["text"] = a.fitted.noise_text;
  return out;
}

}  // namespace recoil
