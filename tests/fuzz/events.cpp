// What an instrument recorded, on arbitrary texts: every file is refused with one clear line or
// paired soundly, and the points are such as a dataset may hold. An input is the package beside the
// events (or nothing) and the events, divided by a line "====".
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "check.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/pairing_files.hpp"
#include "experiment/passages.hpp"
#ifndef RECOIL_READERS
#include "report/pairing_report.hpp"
#endif

namespace {

const recoil::PassageFormat kUnits = {
    {{"time", "s"}, {"velocity", "m/s"}, {"tangential_velocity", "m/s"}, {"diameter", "um"}},
    {},
    false};

void require_sound(const recoil::PassageTable& table) {
  fuzz::require(table.passages.size() + table.damaged + table.duplicated == table.rows,
                "every row");
  const auto earlier = [](const recoil::Passage& a, const recoil::Passage& b) {
    return a.series != b.series ? a.series < b.series : a.time < b.time;
  };
  fuzz::require(std::is_sorted(table.passages.begin(), table.passages.end(), earlier), "order");
  for (const recoil::Passage& event : table.passages) {
    fuzz::require(std::isfinite(event.time) && std::isfinite(event.tangential), "finite");
    fuzz::require(std::abs(event.velocity) > 0.0 && std::abs(event.velocity) <= 1e4, "velocity");
    fuzz::require(event.diameter > 0.0 && event.diameter <= 1.0, "diameter");
    fuzz::require(event.series < table.series.size(), "series");
  }
}

void require_sound(const recoil::PassageTable& table, const recoil::PairingResult& pairs) {
  fuzz::require(pairs.down + pairs.up == table.passages.size(), "all passages");
  fuzz::require(pairs.impacts.size() + pairs.unpaired.size() == pairs.down, "all passages down");
  fuzz::require(pairs.impacts.size() + pairs.orphans == pairs.up, "all passages up");
  fuzz::require(std::isfinite(pairs.height) && pairs.height > 0.0, "height");
  fuzz::require(pairs.purity() >= 0.0 && pairs.purity() <= 1.0, "purity");
  for (const recoil::Impact& impact : pairs.impacts) {
    fuzz::require(impact.restitution > 0.0 && impact.restitution <= 1.5 + 1e-9, "restitution");
    fuzz::require(impact.number >= 1, "number");
  }
}

void require_sound(const recoil::Averages& averages) {
  for (const recoil::PointMean& point : averages.points) {
    fuzz::require(point.velocity > 0.0 && std::isfinite(point.velocity), "mean velocity");
    fuzz::require(point.diameter > 0.0 && std::isfinite(point.diameter), "mean diameter");
    fuzz::require(point.restitution >= 0.0 && point.restitution <= 1.5 + 1e-9, "mean restitution");
    fuzz::require(point.captured <= point.unpaired, "captured of the unpaired");
    fuzz::require(point.lost + point.too_slow <= static_cast<double>(point.unpaired) + 1e-9,
                  "lost and too slow of the unpaired");
  }
  const std::string csv = recoil::points_csv(averages);
  fuzz::require(!csv.empty(), "points.csv");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string input(reinterpret_cast<const char*>(data), size);
  const std::string divider = "====\n";
  const std::size_t at = input.find(divider);
  const std::string package = at == std::string::npos ? "" : input.substr(0, at);
  const std::string events = at == std::string::npos ? input : input.substr(at + divider.size());
  try {
    const recoil::PassageTable table = recoil::parse_passages(
        events, "events.csv", package, package.empty() ? kUnits : recoil::PassageFormat());
    require_sound(table);
    const recoil::PairingResult pairs = recoil::pair_passages(table.passages, {});
    require_sound(table, pairs);
    recoil::AverageOptions by;
    by.size_classes = 1 + size % 3;
    by.mean_diameter = size % 2 == 0;
    const recoil::Averages averages = recoil::average(table.passages, table.series, pairs, by);
    require_sound(averages);
#ifndef RECOIL_READERS
    fuzz::require(!recoil::pairing_text(table, pairs, averages).empty(), "description");
#endif
    recoil::histogram_files(recoil::distributions(table, pairs));
  } catch (const recoil::InputError& error) {
    fuzz::require_one_line(error);
  } catch (const recoil::ComputationError& error) {
    fuzz::require_one_line(error);
  }
  return 0;
}
