#include "report/json_result.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/program.hpp"
#include "report/json_values.hpp"

namespace recoil {
namespace {

void require_format(const std::string& file, const Json& json) {
  const Json stated = json.value("format_version", Json());
  const std::string reads = fmt::format("this recoil {} reads {}", version(), format_version);
  if (!stated.is_number_integer()) {
    throw InputError({file}, "the file states no format_version", reads,
                     "make it again with recoil fit FIT --out DIR");
  }
  const auto found = stated.get<std::int64_t>();
  if (found == format_version) return;
  const Json by = json.value("recoil_version", Json());
  const std::string program =
      by.is_string() ? fmt::format(", of recoil {}", by.get<std::string>()) : std::string();
  const bool older = found < format_version;
  throw InputError({file},
                   fmt::format("the file has format_version {}{}, {}", found, program,
                               older ? "which is older" : "which is newer"),
                   reads,
                   older ? "make it again with recoil fit FIT --out DIR"
                         : "read it with that recoil, or make it again with this one");
}

}  // namespace

Json read_fit_json(const std::string& file, const std::string& text, const std::string& reader) {
  const std::string why = reader + " reads what recoil fit FIT --out DIR has written";
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) throw InputError({file}, "this is not JSON", why, "name DIR/fit.json");
  if (!json.is_object() || !json.contains("parameters")) {
    throw InputError({file}, "this is not the fit.json of a fit", why, "name DIR/fit.json");
  }
  require_format(file, json);
  return json;
}

}  // namespace recoil
