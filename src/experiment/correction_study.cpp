#include "experiment/correction_study.hpp"

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/json.hpp"

namespace recoil {
namespace {

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::optional<double> optional_number(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return json.get<double>();
}

Json json_of(const CorrectionRow& row) {
  Json json = {{"left_out", name_of(row.left_out)},
               {"points", row.points},
               {"captured", row.captured},
               {"error_slow", json_of(row.error_slow)},
               {"error_fast", json_of(row.error_fast)}};
  json["error"] = Json::array();
  for (const std::optional<double>& error : row.error) json["error"].push_back(json_of(error));
  json["usable"] = row.usable;
  if (!row.usable) return json;
  json["C_H"] = row.C_H;
  json["C_H_sd"] = row.C_H_sd;
  json["C_A"] = row.C_A;
  json["C_A_sd"] = row.C_A_sd;
  json["capture_velocity"] = row.capture_velocity;
  json["rmse"] = row.rmse;
  return json;
}

CorrectionRow row_of(const Json& json) {
  CorrectionRow row;
  const std::string left_out = json.at("left_out");
  const std::optional<Correction> correction = value_named<Correction>(left_out);
  if (!correction) throw std::invalid_argument("no correction is called '" + left_out + "'");
  row.left_out = *correction;
  row.points = json.at("points");
  row.captured = json.at("captured");
  row.error_slow = optional_number(json.at("error_slow"));
  row.error_fast = optional_number(json.at("error_fast"));
  for (const Json& error : json.at("error")) row.error.push_back(optional_number(error));
  row.usable = json.at("usable");
  if (!row.usable) return row;
  row.C_H = json.at("C_H");
  row.C_H_sd = json.at("C_H_sd");
  row.C_A = json.at("C_A");
  row.C_A_sd = json.at("C_A_sd");
  row.capture_velocity = json.at("capture_velocity");
  row.rmse = json.at("rmse");
  return row;
}

}  // namespace

std::string correction_inputs(const std::string& fit_sha256, const std::string& dataset_sha256,
                              const std::string& recipe_text) {
  return sha256_hex(fit_sha256 + dataset_sha256 + sha256_hex(recipe_text)).substr(0, 16);
}

std::string correction_studies_json(const CorrectionStudies& studies) {
  Json json = {{"inputs", studies.inputs}, {"studies", Json::array()}};
  for (const CorrectionStudy& study : studies.studies) {
    Json rows = Json::array();
    for (const CorrectionRow& row : study.rows) rows.push_back(json_of(row));
    json["studies"].push_back({{"passages", study.passages},
                               {"rebounds_per_velocity", study.rebounds_per_velocity},
                               {"size_classes", study.size_classes},
                               {"velocities", study.velocities},
                               {"diameter", study.diameter},
                               {"C_H", study.C_H},
                               {"C_A", study.C_A},
                               {"capture_velocity", study.capture_velocity},
                               {"rows", rows}});
  }
  return json.dump(1) + "\n";
}

CorrectionStudies parse_correction_studies(const std::string& text, const std::string& file) {
  try {
    const Json json = Json::parse(text);
    CorrectionStudies found;
    found.inputs = json.at("inputs");
    for (const Json& from : json.at("studies")) {
      CorrectionStudy study;
      study.passages = from.at("passages");
      study.rebounds_per_velocity = from.at("rebounds_per_velocity");
      study.size_classes = from.at("size_classes");
      study.velocities = from.at("velocities").get<std::vector<double>>();
      study.diameter = from.at("diameter");
      study.C_H = from.at("C_H");
      study.C_A = from.at("C_A");
      study.capture_velocity = from.at("capture_velocity");
      for (const Json& row : from.at("rows")) study.rows.push_back(row_of(row));
      found.studies.push_back(std::move(study));
    }
    return found;
  } catch (const std::exception& problem) {
    throw InputError({file}, "these are no studies of corrections", problem.what(),
                     "let recoil_study corrections write them again");
  }
}

CorrectionStudies read_correction_studies(const std::filesystem::path& file) {
  return parse_correction_studies(read_text_file(file), file.string());
}

}  // namespace recoil
