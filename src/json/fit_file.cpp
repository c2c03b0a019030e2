#include "json/fit_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/program.hpp"

namespace recoil {
namespace {

/// @throws InputError unless `json` has the format_version of this program
void require_format(const std::string& file, const Json& json) {
  const Json stated = json.value("format_version", Json());
  const std::string reads = fmt::format("this recoil {} reads {}", version(), format_version);
  const std::string again = "make it again with recoil fit FIT --out DIR";
  if (!stated.is_number_integer()) {
    throw InputError({file}, "the file states no format_version", reads, again);
  }
  const auto found = stated.get<std::int64_t>();
  if (found == format_version) return;
  const Json by = json.value("recoil_version", Json());
  const std::string program = by.is_string() ? ", of recoil " + by.get<std::string>() : "";
  const bool older = found < format_version;
  throw InputError({file},
                   fmt::format("the file has format_version {}{}, {}", found, program,
                               older ? "which is older" : "which is newer"),
                   reads,
                   older ? again : "read it with that recoil, or make it again with this one");
}

/// @throws InputError unless these values were fitted to the present `datasets`
void check_data(const FitFile& fit, const std::vector<Dataset>& datasets, const std::string& path) {
  const auto same_id = [](const DatasetEntry& fitted, const Dataset& now) {
    return fitted.id == now.id;
  };
  if (!std::equal(fit.datasets.begin(), fit.datasets.end(), datasets.begin(), datasets.end(),
                  same_id)) {
    std::vector<std::string> ids;
    for (const DatasetEntry& dataset : fit.datasets) ids.push_back(dataset.id);
    throw InputError({path}, fmt::format("these values were fitted to {}", fmt::join(ids, " + ")),
                     "the fit file names other data", "use the fit.json of this fit file");
  }
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    if (fit.datasets[d].sha256 == datasets[d].sha256) continue;
    throw InputError({path}, fmt::format("{} has changed since", datasets[d].id),
                     "these values belong to the files as they were", "run recoil fit again");
  }
}

/// The values of an impact to simulate: those with exact laws, where the fit was averaged.
std::map<std::string, FittedValue> values_by_name(const FitFile& fit) {
  std::map<std::string, FittedValue> values;
  const auto take_exact = [&](const std::string& name, const FitFile::LawsExact& exact) {
    if (exact.value) values[name] = {*exact.value, exact.std_error};
  };
  for (const auto& [name, parameter] : fit.parameters) {
    const auto& value = parameter.value.value;
    if (value) values[name] = {*value, parameter.std_error.value};
    if (parameter.laws_exact) take_exact(name, *parameter.laws_exact);
  }
  for (const auto& [name, constant] : fit.constants) {
    if (constant.value) values[name] = {*constant.value, constant.std_error};
    if (constant.laws_exact) take_exact(name, *constant.laws_exact);
  }
  return values;
}

}  // namespace

FitFile read_fit_file(const std::string& file, const std::string& text, const std::string& reader) {
  const std::string why = reader + " reads what recoil fit FIT --out DIR has written";
  const Json json = parse_json(text);
  if (json.is_discarded()) throw InputError({file}, "this is not JSON", why, "name DIR/fit.json");
  if (!json.is_object() || !json.contains("parameters")) {
    throw InputError({file}, "this is not the fit.json of a fit", why, "name DIR/fit.json");
  }
  require_format(file, json);
  try {
    FitFile fit = value_from<FitFile>(json);
    if (fit.parameters.empty() || fit.datasets.empty()) {
      throw InputError({file}, "this is not the whole fit.json of a fit", why,
                       "make it again with recoil fit FIT --out DIR");
    }
    return fit;
  } catch (const JsonMismatch& mismatch) {
    throw InputError({file}, mismatch.what(), why, "make it again with recoil fit FIT --out DIR");
  }
}

std::optional<Ends> recommended_interval(const FitFile::Parameter& parameter) {
  const FitFile::Intervals& all = parameter.intervals;
  const OrNull<IntervalKind> kind = parameter.recommended.interval;
  if (kind == IntervalKind::wald) return all.wald;
  if (kind == IntervalKind::profile) return all.profile;
  if (kind == IntervalKind::percentile) return all.percentile;
  if (kind == IntervalKind::bca) return all.bca;
  if (kind == IntervalKind::studentized) return all.studentized;
  return std::nullopt;
}

std::optional<FitFile> read_parameters(const std::string& path) {
  if (path.empty()) return std::nullopt;
  return read_fit_file(path, read_text_file(path), "--parameters");
}

FitSpec with_fitted_loss(FitSpec spec, const std::optional<FitFile>& fit) {
  if (!fit || (!spec.loss.empty() && spec.loss != "auto")) return spec;
  return with_loss(std::move(spec), fit->options.loss);
}

std::string origin_words(const FitFile& fit, const std::string& path) {
  const bool averaged = std::ranges::any_of(
      fit.parameters, [](const auto& entry) { return entry.second.laws_exact.has_value(); });
  return "from " + path + (averaged ? ", fitted with exact laws" : "");
}

std::vector<FittedValue> take_fitted_values(ImpactModel& model,
                                            const std::vector<Dataset>& datasets,
                                            const FitFile& fit, const std::string& path) {
  check_data(fit, datasets, path);
  const std::map<std::string, FittedValue> fitted = values_by_name(fit);
  std::vector<FittedValue> values;
  for (ParameterSlot& slot : model.slots) {
    // An adhesion that changes with the materials is computed from the stated ones.
    if (slot.derived && !slot.free && !model.constants.empty()) {
      values.push_back({slot.initial, std::nullopt});
      continue;
    }
    const auto found = fitted.find(slot.label());
    if (found == fitted.end()) {
      const auto without_value = std::ranges::find_if(
          fit.parameters, [&](const auto& parameter) { return parameter.first == slot.label(); });
      if (without_value != fit.parameters.end()) {
        throw InputError({path},
                         fmt::format("the parameter {} has no value: {}", slot.label(),
                                     without_value->second.value.why),
                         "", "fix it in the fit file, and run recoil fit again");
      }
      throw InputError({path}, fmt::format("the parameter {} is missing", slot.label()),
                       "this is the result of another fit", "use the fit.json of this fit file");
    }
    slot.initial = found->second.value;
    values.push_back(found->second);
  }
  return values;
}

}  // namespace recoil
