#include "validation/studies/study_stamp.hpp"

namespace recoil {

nlohmann::ordered_json json_of(const StudyStamp& stamp) {
  nlohmann::ordered_json json = {
      {"study", stamp.study}, {"command", stamp.command}, {"key", stamp.key}};
  if (!stamp.origin.empty()) json["origin"] = stamp.origin;
  return json;
}

StudyStamp stamp_of(const nlohmann::ordered_json& json) {
  return {json.at("study"), json.at("command"), json.at("key"),
          json.value("origin", std::string())};
}

std::vector<Block> stamp_blocks(const StudyStamp& stamp) {
  Sentence made = say("Made by {} ({}), from sources with the key {}.",
                      code("./run study " + stamp.study), code(stamp.command), code(stamp.key));
  if (!stamp.origin.empty()) made += Sentence(" " + stamp.origin);
  return {Paragraph{made}};
}

}  // namespace recoil
