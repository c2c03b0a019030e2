#include "python/pairs.hpp"

#include <filesystem>
#include <numbers>

#include "cli/paired_passages.hpp"
#include "core/units.hpp"
#include "experiment/pairing_files.hpp"
#include "python/picture_json.hpp"
#include "report/experiment_figures.hpp"
#include "report/pairing_document.hpp"
#include "report/result_json.hpp"

namespace recoil {

PairTexts pair_texts(const std::string& file, const PairArguments& arguments) {
  constexpr double degree = std::numbers::pi / 180.0;
  PairRequest request;
  request.file = file;
  PairingOptions& pairing = request.pairing;
  pairing.height = arguments.height * units::mm;
  pairing.height_range = arguments.height_range;
  pairing.refine = !arguments.keep_height;
  pairing.diameter_tolerance = arguments.diameter_tolerance;
  pairing.velocity_tolerance = arguments.velocity_tolerance;
  pairing.keep_later = arguments.keep_later;
  pairing.threshold = arguments.threshold;
  if (arguments.angle) pairing.angle = *arguments.angle * degree;
  pairing.lost_share = arguments.lost_share;
  AverageOptions& averaging = request.averaging;
  averaging.per_bin = arguments.per_bin;
  averaging.size_classes = arguments.size_classes;
  for (const double edge : arguments.size_edges) averaging.size_edges.push_back(edge * units::um);
  averaging.mean_diameter = arguments.mean_diameter;

  const PairedPassages paired = pair_and_average(
      read_passages(file, {arguments.units, arguments.columns, arguments.positive_away}), request);
  require_impacts(paired, request, "");
  const auto& [table, pairs, averages] = paired;
  const std::string remark = std::filesystem::path(file).filename().string();
  std::vector<Figure> figures;
  for (plot::Picture& picture :
       experiment_pictures(distributions(table, pairs), averages, remark)) {
    figures.push_back(figure_of(std::move(picture), ""));
  }
  return {pairing_json(table, pairs, averages), pairing_text(table, pairs, averages),
          points_csv(averages), impacts_csv(table, pairs),
          pictures_json(figures).dump(-1, ' ', false, Json::error_handler_t::replace)};
}

}  // namespace recoil
