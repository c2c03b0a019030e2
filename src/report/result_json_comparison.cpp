#include <algorithm>
#include <cmath>

#include "core/program.hpp"
#include "report/result_json.hpp"

namespace recoil {
namespace {

Json fit_of_comparison(const ComparedFit& fit, std::optional<double> best) {
  const auto aicc = fit.aicc();
  return {{"id", fit.id},
          {"adhesion", fit.adhesion},
          {"mechanisms", fit.mechanisms},
          {"free_parameters", fit.free_parameters},
          {"points", fit.points},
          {"chi2", number_or_null(fit.chi2)},
          {"aicc", number_or_null(aicc.value_or(NAN))},
          {"aicc_above_best", number_or_null(aicc && best ? *aicc - *best : NAN)},
          {"rmse", number_or_null(fit.rmse)},
          {"held_out_rmse", number_or_null(fit.held_out_rmse.value_or(NAN))}};
}

Json said_of(const ComparedFit& fit, const std::string& name, Json& entry) {
  const auto found = std::find_if(fit.quantities.begin(), fit.quantities.end(),
                                  [&](const ComparedQuantity& q) { return q.name == name; });
  if (found == fit.quantities.end()) return nullptr;
  entry["unit"] = found->unit;
  return {{"value", number_or_null(found->value)},
          {"free", found->free},
          {"interval", as_json(found->interval)}};
}

}  // namespace

std::string comparison_json(const std::vector<ComparedFit>& fits) {
  require_same_data(fits);
  std::optional<double> best;
  for (const ComparedFit& fit : fits) {
    if (const auto aicc = fit.aicc()) best = std::min(best.value_or(*aicc), *aicc);
  }
  Json out;
  out["format_version"] = format_version;
  out["recoil_version"] = version();
  out["data"] = fits.front().data;
  out["fits"] = Json::array();
  for (const ComparedFit& fit : fits) out["fits"].push_back(fit_of_comparison(fit, best));
  const ChoiceDependence dependence = choice_dependence(fits);
  out["quantities"] = Json::array();
  for (const std::string& name : compared_names(fits)) {
    Json entry = {{"name", name}, {"unit", ""}};
    Json said = Json::array();
    for (const ComparedFit& fit : fits) said.push_back(said_of(fit, name, entry));
    entry["fits"] = std::move(said);
    const auto is_in = [&](const std::vector<std::string>& names) {
      return std::find(names.begin(), names.end(), name) != names.end();
    };
    entry["depends_on_choice"] = is_in(dependence.depends) || is_in(dependence.holds)
                                     ? Json(is_in(dependence.depends))
                                     : Json(nullptr);
    out["quantities"].push_back(std::move(entry));
  }
  return json_text(out);
}

}  // namespace recoil
