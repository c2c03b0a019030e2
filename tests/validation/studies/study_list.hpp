#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"

namespace recoil {

/// One of the studies whose results are committed.
struct Study {
  std::string name;
  std::string command;  ///< words of recoil_study

  /// The JSON that it leaves, from the project's folder.
  std::string result() const { return "reports/" + name + ".json"; }
};

const std::vector<Study>& all_studies();

/// @throws InputError when there is no such study; it names the nearest
const Study& study_named(const std::string& name);

/// Changes with everything that a study's numbers depend on: the command, the fits, the data, and
/// the code below `root`/src and `root`/tests/validation that neither only shows results nor is
/// apart from the study.
std::string study_key(const std::filesystem::path& root, const std::string& command);

/// C++ source without comments (`//`) and without the white space that has no meaning.
std::string code_of(std::string_view source);

/// Does this file, a path from the project's folder, only show results that others compute?
bool shows_results(const std::filesystem::path& source);

/// Does this file decide nothing in the studies of this command? The list of studies decides
/// nothing (the command is part of the key), and studies of coverage diagnose nothing.
bool is_apart(const std::filesystem::path& source, const std::string& command);

enum class StudyState {
  missing,
  stale,  ///< made from other sources, fits or data than those that are there
  current
};
constexpr auto names_of_values(StudyState) { return name_list("missing", "stale", "current"); }
StudyState state_of(const std::filesystem::path& root, const Study& study);

/// Writes NAME.md, and NAME.svg where there is a picture, beside the study NAME.json.
/// @throws InputError when the file is not the result of a study that has a page
void render_study(const std::filesystem::path& json);

/// Writes coverage.md and coverage.svg beside the studies coverage-*.json of `folder`.
/// @throws InputError when there is none
void write_coverage_summary(const std::filesystem::path& folder);

}  // namespace recoil
