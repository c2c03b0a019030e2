#include "cli/fitted_values.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/files.hpp"

namespace recoil {

std::vector<FittedValue> take_fitted_values(ImpactModel& model, const std::string& path) {
  const std::string text = read_text_file(path);
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("parameters")) {
    throw InputError({path}, "there are no fitted parameters in this file",
                     "--parameters reads a fit.json", "make one with recoil fit FIT --out DIR");
  }
  std::vector<FittedValue> values;
  for (ParameterSlot& slot : model.slots) {
    // An adhesion that follows the materials does so from what is stated of them.
    if (slot.derived && !slot.free && !model.constants.empty()) {
      values.push_back({slot.initial, std::nullopt});
      continue;
    }
    const char* const kind = slot.is_constant() ? "constants" : "parameters";
    const nlohmann::json table = json.value(kind, nlohmann::json::object());
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

CLI::Validator positive_number(const std::string& what, double low, double high) {
  return {[=](const std::string& text) -> std::string {
            double value = 0.0;
            const bool number = CLI::detail::lexical_cast(text, value);
            if (number && value >= low && value <= high) return {};
            return fmt::format("{} is not a {} between {:g} and {:g}", text, what, low, high);
          },
          what};
}

}  // namespace recoil
