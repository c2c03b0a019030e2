#include "tables/result_formats.hpp"

#include <fmt/format.h>

#include "json/diagnosis_file.hpp"
#include "json/printed_results.hpp"
#include "tables/json_schema.hpp"

namespace recoil {
namespace {

template <class File>
ResultFormat format_of(std::string_view name, std::string_view title) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"$id", fmt::format("recoil:{}.schema.json", name)},
                 {"title", title},
                 {"description", "SI units unless a key or its description says otherwise."}};
  schema.update(schema_of<File>());
  return {name, std::move(schema)};
}

}  // namespace

const std::vector<ResultFormat>& result_formats() {
  static const std::vector<ResultFormat> all = {
      format_of<FitFile>("fit", "fit.json: recoil fit"),
      format_of<DiagnosisFile>("diagnosis", "diagnosis.json: recoil diagnose"),
      format_of<SimulationFile>("simulate", "recoil simulate --json"),
      format_of<PredictionFile>("predict", "predict.json: recoil predict"),
      format_of<ComparisonFile>("compare", "recoil compare --json"),
      format_of<PairingFile>("pair", "recoil pair --json"),
      format_of<PlanFile>("plan", "recoil plan --json, plan.json"),
      format_of<CoverageFile>("coverage", "recoil coverage --json")};
  return all;
}

}  // namespace recoil
