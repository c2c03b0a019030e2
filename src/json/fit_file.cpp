#include "json/fit_file.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
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

}  // namespace

FitFile read_fit_file(const std::string& file, const std::string& text, const std::string& reader) {
  const std::string why = reader + " reads what recoil fit FIT --out DIR has written";
  const Json json = Json::parse(text, nullptr, false);
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
  const std::string kind = parameter.recommended.interval.value_or("");
  const FitFile::Intervals& all = parameter.intervals;
  if (kind == "wald") return all.wald;
  if (kind == "profile") return all.profile;
  if (kind == "percentile") return all.percentile;
  if (kind == "bca") return all.bca;
  if (kind == "studentized") return all.studentized;
  return std::nullopt;
}

}  // namespace recoil
