#include "report/prediction_files.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/json.hpp"
#include "core/program.hpp"
#include "core/units.hpp"
#include "report/format.hpp"
#include "report/prediction_page.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : std::string();
}

std::string cells(const BandedValue& at) {
  return fmt::format(",{},{},{}", cell(at.value), cell(at.lower), cell(at.upper));
}

Json value_or_null(const std::optional<double>& value) {
  return value ? number_or_null(*value) : Json();
}

Json banded_json(const BandedValue& at) {
  Json out;
  out["value"] = value_or_null(at.value);
  out["band"] = at.lower && at.upper ? Json::array({*at.lower, *at.upper}) : Json();
  return out;
}

Json miss_json(const CurveMiss& miss) {
  return {{"rmse", value_or_null(miss.rmse)}, {"points", miss.points}};
}

}  // namespace

std::string csv_prediction(const PolydispersePrediction& mixture) {
  std::string csv = "incident_velocity_m_s,restitution_d10";
  for (const CaptureConvention convention : all_conventions) {
    csv += fmt::format(",{0},{0}_lower,{0}_upper", to_string(convention));
  }
  for (const char* part : {"captured_fraction", "unseen_fraction"}) {
    csv += fmt::format(",{0},{0}_lower,{0}_upper", part);
  }
  csv += '\n';
  for (std::size_t k = 0; k < mixture.velocity.size(); ++k) {
    const double single = mixture.size_curves[1].restitution[k];
    csv += fmt::format("{:.6g},{}", mixture.velocity[k],
                       std::isfinite(single) ? fmt::format("{:.6g}", single) : std::string());
    for (const auto& average : mixture.average) csv += cells(average[k]);
    csv += cells(mixture.captured[k]) + cells(mixture.unseen[k]) + '\n';
  }
  return csv;
}

std::string json_prediction(const Analysis& analysis, const PolydispersePrediction& mixture) {
  const Dataset& dataset = analysis.datasets[mixture.dataset];
  Json out;
  out["format_version"] = format_version;
  out["recoil"] = version();
  out["fit"] = analysis.spec.id;
  out["dataset"] = {{"id", dataset.id},
                    {"provenance", to_string(dataset.provenance)},
                    {"provenance_sentence", provenance_sentence(dataset.provenance)},
                    {"sha256", dataset.sha256}};
  Json bins = Json::array();
  for (const SizeBin& bin : mixture.sizes.bins) {
    bins.push_back({{"diameter_um", bin.diameter / units::um},
                    {"width_um", bin.width / units::um},
                    {"weight", bin.weight}});
  }
  out["sizes"] = {{"file", mixture.sizes.file.string()},
                  {"provenance", mixture.sizes.provenance},
                  {"description", mixture.sizes.description},
                  {"sha256", mixture.sizes.sha256},
                  {"d10_um", mixture.sizes.mean_diameter() / units::um},
                  {"simulated", mixture.simulated},
                  {"bins", bins}};
  out["probe_height_m"] = mixture.probe_height;
  out["slowest_seen_m_s"] = mixture.slowest_seen;
  out["level"] = mixture.level;
  out["replicates"] = mixture.replicates;
  out["seed"] = analysis.uncertainty.bootstrap.seed;
  Json conventions;
  for (std::size_t c = 0; c < all_conventions.size(); ++c) {
    conventions[to_string(all_conventions[c])] = {{"means", words_of(all_conventions[c])},
                                                  {"miss", miss_json(mixture.miss[c])}};
  }
  out["conventions"] = conventions;
  out["d10_alone"] = {{"miss", miss_json(mixture.miss_single)}};
  Json sizes = Json::array();
  for (const SizeCurve& size : mixture.size_curves) {
    sizes.push_back({{"name", to_string(size.size)},
                     {"diameter_um", size.diameter / units::um},
                     {"capture_velocity", number_or_null(size.capture_velocity)},
                     {"restitution", as_json(size.restitution)}});
  }
  out["size_curves"] = sizes;
  Json rows = Json::array();
  for (std::size_t k = 0; k < mixture.velocity.size(); ++k) {
    Json row;
    row["incident_velocity"] = mixture.velocity[k];
    for (std::size_t c = 0; c < all_conventions.size(); ++c) {
      row[to_string(all_conventions[c])] = banded_json(mixture.average[c][k]);
    }
    row["captured_fraction"] = banded_json(mixture.captured[k]);
    row["unseen_fraction"] = banded_json(mixture.unseen[k]);
    rows.push_back(row);
  }
  out["curve"] = rows;
  return json_text(out);
}

}  // namespace recoil
