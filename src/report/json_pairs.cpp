#include "report/json_pairs.hpp"

#include <cmath>

#include "report/json_values.hpp"
#include "report/pair_words.hpp"

namespace recoil {
namespace {

Json optional_json(const std::optional<double>& value) {
  return number_or_null(value.value_or(NAN));
}

Json held_out_json(const HeldOut& error) {
  return {{"series", optional_json(error.series)}, {"diameters", optional_json(error.diameters)}};
}

Json pair_json(const Analysis& a, const PairStudy& study, const PairQuality& pair) {
  const PairFigures figures = figures_of(study, pair);
  Json ended = Json::object();
  for (std::size_t status = 0; status < pair.ended.size(); ++status) {
    if (pair.ended[status] == 0) continue;
    ended[to_string(static_cast<TwoPointStatus>(status))] = pair.ended[status];
  }
  const bool answered = pair.measured.status == TwoPointStatus::converged;
  return {{"low_velocity", a.fitted.data.points[pair.low_point].velocity},
          {"high_velocity", a.fitted.data.points[pair.high_point].velocity},
          {"bias_C_H", optional_json(figures.bias_C_H)},
          {"bias_C_A", optional_json(figures.bias_C_A)},
          {"spread_C_H", optional_json(pair.C_H.spread)},
          {"spread_C_A", optional_json(pair.C_A.spread)},
          {"without_answer", number_or_null(figures.without_answer)},
          {"ended", ended},
          {"held_out_rmse", held_out_json(pair.held_out)},
          {"measured",
           {{"status", to_string(pair.measured.status)},
            {"C_H", answered ? number_or_null(pair.measured.C_H) : Json(nullptr)},
            {"C_A", answered ? number_or_null(pair.measured.C_A) : Json(nullptr)},
            {"held_out_rmse", held_out_json(pair.measured_held_out)}}}};
}

}  // namespace

void put_pairs(Json& out, const Analysis& a, std::size_t dataset) {
  out["pairs"] = Json::array();
  out["pairs_study"] = nullptr;
  for (const PairStudy& study : a.uncertainty.pairs) {
    if (study.dataset != dataset) continue;
    for (const PairQuality& pair : study.pairs) out["pairs"].push_back(pair_json(a, study, pair));
    out["pairs_study"] = {{"simulations", study.simulations},
                          {"points", study.points},
                          {"points_tried", study.taken},
                          {"paper_pair", study.paper},
                          {"full",
                           {{"C_H", number_or_null(study.truth_C_H)},
                            {"C_A", number_or_null(study.truth_C_A)},
                            {"spread_C_H", optional_json(study.C_H.spread)},
                            {"spread_C_A", optional_json(study.C_A.spread)},
                            {"failed", study.full_failed},
                            {"held_out_rmse", held_out_json(study.held_out)},
                            {"measured_rmse", held_out_json(study.measured_held_out)}}},
                          {"text", plain_texts(pair_words(a, study))}};
  }
  if (out["pairs"].empty()) out["pairs_why"] = "no choice of two points was studied";
}

}  // namespace recoil
