#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "studies/hidden_effects_study.hpp"
#include "studies/study_stamp.hpp"

namespace hidden {

/// What one run of the study found, data set by data set.
struct StudyResult {
  recoil::StudyStamp stamp;
  StudySize size;
  std::size_t planned = 0;  ///< how many data sets `answers` would have if all were done
  std::vector<Answered> answers;
};

std::string study_json(const StudyResult& result);
/// @throws recoil::InputError when `file` is not the JSON of such a study
StudyResult read_study(const std::filesystem::path& file);

}  // namespace hidden
