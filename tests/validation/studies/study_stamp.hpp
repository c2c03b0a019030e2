#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "document/document.hpp"

namespace recoil {

/// The head of every study's JSON: what it is and where its numbers come from.
struct StudyStamp {
  std::string study;    ///< "coverage-designs": the name of its files in reports
  std::string command;  ///< the line that makes it
  std::string key;      ///< of the sources, fits and data that made it, see study_key
  std::string origin;   ///< of numbers that no run of this program wrote; else empty
};

nlohmann::ordered_json json_of(const StudyStamp& stamp);

/// @throws nlohmann::json::exception when `json` has no such head
StudyStamp stamp_of(const nlohmann::ordered_json& json);

/// The last paragraphs of a study's page.
std::vector<Block> stamp_blocks(const StudyStamp& stamp);

}  // namespace recoil
