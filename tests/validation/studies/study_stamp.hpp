#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "document/document.hpp"

namespace recoil {

/// The head of every study's JSON: what it is and where its numbers come from.
struct StudyStamp {
  std::string study;    ///< "coverage-designs": the name of its files in reports
  std::string command;  ///< the line that makes it
  std::string key;      ///< of the sources, fits and data that made it, see study_key
  RECOIL_FIELDS(study, command, key)
};

/// The last paragraph of a study's page.
inline std::vector<Block> stamp_blocks(const StudyStamp& stamp) {
  return {Paragraph{say("Made by {} ({}), from sources with the key {}.",
                        code("./run study " + stamp.study), code(stamp.command), code(stamp.key))}};
}

/// The JSON of a study: its stamp, then its fields.
template <class Result>
std::string study_json(const Result& result) {
  Json json = as_json(result.stamp);
  json.update(as_json(result));
  return json_text(json, 1);
}

/// Reads what `study_json` writes.
/// @param what "study of coverage"
/// @param required a key that such a study has
/// @throws InputError when `file` is not such a study
template <class Result>
Result read_study(const std::filesystem::path& file, const std::string& what,
                  const std::string& required) {
  const std::string text = read_text_file(file);
  try {
    const Json json = Json::parse(text);
    if (!json.is_object() || !json.contains("key") || !json.contains(required)) {
      throw std::runtime_error("it has no '" + required + "'");
    }
    Result result;
    read_json(json, result.stamp);
    read_json(json, result);
    return result;
  } catch (const std::runtime_error& problem) {
    throw InputError({file.string()}, "this is no " + what, problem.what(),
                     "let ./run study write it again");
  } catch (const Json::exception& problem) {
    throw InputError({file.string()}, "this is no " + what, problem.what(),
                     "let ./run study write it again");
  }
}

}  // namespace recoil
