#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace recoil {

/// One of the studies whose results are committed.
struct Study {
  std::string name;
  std::string command;  ///< words of recoil_study
  std::string result;   ///< the JSON that it leaves, from the project's folder
};

const std::vector<Study>& all_studies();

/// @throws InputError when there is no such study; it names the nearest
const Study& study_named(const std::string& name);

/// Changes with everything that a study's numbers depend on: the command, the fits, the data, and
/// the sources below `root`/src that decide them (`decides`).
std::string study_key(const std::filesystem::path& root, const std::string& command);

/// Does this folder of src, or this file below it, only show what others computed?
bool shows_results(const std::filesystem::path& source);

/// Can `source`, a file below src, change a number of the study `command`? Not where it only shows
/// results, nor, for a study of coverage, where it comes later in the pipeline or belongs to
/// another study.
bool decides(const std::string& command, const std::filesystem::path& source);

enum class StudyState {
  missing,
  stale,  ///< made from other sources, fits or data than those that are there
  current
};
StudyState state_of(const std::filesystem::path& root, const Study& study);

}  // namespace recoil
