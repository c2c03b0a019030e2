#include "studies/hidden_effects_file.hpp"

#include "core/error.hpp"
#include "core/files.hpp"

namespace hidden {

using Json = nlohmann::ordered_json;

std::string study_json(const StudyResult& result) {
  Json json = recoil::json_of(result.stamp);
  json["size"] = {{"datasets", result.size.per_cell}, {"correct", result.size.correct},
                  {"pairs", result.size.pairs},       {"outside", result.size.outside},
                  {"single", result.size.single},     {"careless", result.size.careless},
                  {"seed", result.size.seed}};
  json["planned"] = result.planned;
  json["rows"] = Json::array();
  for (const Answered& answer : result.answers) json["rows"].push_back(json_of(answer));
  return json.dump(1) + "\n";
}

StudyResult read_study(const std::filesystem::path& file) {
  try {
    const Json json = Json::parse(recoil::read_text_file(file));
    StudyResult result;
    result.stamp = recoil::stamp_of(json);
    const Json& size = json.at("size");
    result.size = {size.at("datasets"), size.at("correct"),  size.at("pairs"), size.at("outside"),
                   size.at("single"),   size.at("careless"), size.at("seed")};
    result.planned = json.at("planned");
    for (const Json& row : json.at("rows")) result.answers.push_back(answered_of(row));
    return result;
  } catch (const recoil::InputError&) {
    throw;
  } catch (const std::exception& problem) {
    throw recoil::InputError({file.string()}, "this is no study of hidden effects", problem.what(),
                             "let ./run study hidden-effects write it again");
  }
}

}  // namespace hidden
