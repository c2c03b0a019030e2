#include "cli/fitted_values.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "report/json_result.hpp"

namespace recoil {

namespace {

/// Were these values fitted to `datasets` as they are now?
void check_data(const Json& json, const std::vector<Dataset>& datasets, const std::string& path) {
  const Json fitted = json.value("datasets", Json::array());
  bool same = fitted.size() == datasets.size();
  std::string ids;
  for (std::size_t d = 0; d < fitted.size(); ++d) {
    const std::string id = fitted[d].value("id", "");
    ids += (ids.empty() ? "" : " + ") + id;
    same = same && id == datasets[d].id;
  }
  if (!same) {
    throw InputError({path}, fmt::format("these values were fitted to {}", ids),
                     "the fit file names other data", "use the fit.json of this fit file");
  }
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    if (fitted[d].value("sha256", "") == datasets[d].sha256) continue;
    throw InputError({path}, fmt::format("{} has changed since", datasets[d].id),
                     "these values belong to the files as they were", "run recoil fit again");
  }
}

}  // namespace

std::vector<FittedValue> take_fitted_values(ImpactModel& model,
                                            const std::vector<Dataset>& datasets,
                                            const std::string& path) {
  const std::string text = read_text_file(path);
  const Json json = read_fit_json(path, text, "--parameters");
  check_data(json, datasets, path);
  std::vector<FittedValue> values;
  for (ParameterSlot& slot : model.slots) {
    // An adhesion that follows the materials does so from what is stated of them.
    if (slot.derived && !slot.free && !model.constants.empty()) {
      values.push_back({slot.initial, std::nullopt});
      continue;
    }
    const char* const kind = slot.is_constant() ? "constants" : "parameters";
    const Json table = json.value(kind, Json::object());
    const auto found = table.find(slot.label());
    if (found == table.end() || !found->contains("value") || !(*found)["value"].is_number()) {
      throw InputError({path}, fmt::format("the parameter {} is missing", slot.label()),
                       "this is the result of another fit", "use the fit.json of this fit file");
    }
    slot.initial = (*found)["value"].get<double>();
    FittedValue value = {slot.initial, std::nullopt};
    const auto error = found->find("std_error");
    if (error != found->end() && error->is_number()) value.std_error = error->get<double>();
    values.push_back(value);
  }
  return values;
}

}  // namespace recoil
