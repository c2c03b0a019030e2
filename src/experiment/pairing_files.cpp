#include "experiment/pairing_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/statistics.hpp"
#include "core/units.hpp"
#include "data/csv.hpp"
#include "data/datapackage.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_bins = 2000;

std::size_t sturges_bins(std::size_t n) {
  return static_cast<std::size_t>(std::ceil(1.0 + std::log2(static_cast<double>(n)) - 1e-9));
}

Histogram filled(const std::vector<double>& values, std::size_t bins) {
  Histogram histogram;
  if (values.empty()) return histogram;
  const auto [lowest, highest] = std::ranges::minmax_element(values);
  histogram.lower = *lowest;
  histogram.width = (*highest - *lowest) / static_cast<double>(bins);
  if (!(histogram.width > 0.0)) {  // all values are equal: one bin around them
    bins = 1;
    histogram.width = std::max(std::abs(*lowest) * 1e-3, 1e-12);
    histogram.lower -= 0.5 * histogram.width;
  }
  histogram.counts.assign(bins, 0);
  for (const double value : values) {
    const double place = (value - histogram.lower) / histogram.width;
    ++histogram.counts[std::min(static_cast<std::size_t>(std::max(place, 0.0)), bins - 1)];
  }
  return histogram;
}

std::string known(double value) { return value > 0.0 ? fmt::format("{:.4g}", value) : ""; }

std::string bins_csv(const std::vector<double>& values, double unit) {
  std::string out = "rule,lower,upper,middle,count,share\n";
  for (const auto& [rule, histogram] :
       {std::pair{"sturges", sturges(values)},
        std::pair{"freedman-diaconis", freedman_diaconis(values)}}) {
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
      out += fmt::format(
          "{},{:.6g},{:.6g},{:.6g},{},{:.6g}\n", rule, histogram.edge(i) / unit,
          histogram.edge(i + 1) / unit, histogram.middle(i) / unit, histogram.counts[i],
          static_cast<double>(histogram.counts[i]) / static_cast<double>(values.size()));
    }
  }
  return out;
}

}  // namespace

Histogram sturges(const std::vector<double>& values) {
  return filled(values, sturges_bins(std::max<std::size_t>(values.size(), 1)));
}

Histogram freedman_diaconis(const std::vector<double>& values) {
  std::size_t bins = sturges_bins(std::max<std::size_t>(values.size(), 1));
  std::vector<double> sorted = values;
  std::ranges::sort(sorted);
  if (!sorted.empty()) {
    const double spread = sorted_quantile(sorted, 0.75) - sorted_quantile(sorted, 0.25);
    const double width = 2.0 * spread / std::cbrt(static_cast<double>(sorted.size()));
    if (width > 0.0) {
      const double wanted = std::ceil((sorted.back() - sorted.front()) / width);
      bins = static_cast<std::size_t>(std::clamp(wanted, 1.0, static_cast<double>(most_bins)));
    }
  }
  return filled(values, bins);
}
std::string points_csv(const Averages& averages) {
  std::string out =
      "series,diameter,incident_velocity,velocity_sd,restitution,restitution_sd,events,captured\n";
  for (const PointMean& point : averages.points) {
    const bool rebounds = point.rebounds > 0;
    out += fmt::format("{},{:.5g},{:.6g},{},{},{},{},{}\n", csv_cell(point.series),
                       point.diameter / units::um, point.velocity, known(point.velocity_sd),
                       rebounds ? fmt::format("{:.5g}", point.restitution) : "",
                       known(point.restitution_sd), point.events(), point.captured);
  }
  return out;
}

std::string sizes_csv(const Distributions& distributions) {
  std::string out = "lower,upper,count\n";
  const Histogram histogram = sturges(distributions.incoming_sizes);
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    if (histogram.counts[i] == 0) continue;
    out += fmt::format("{:.5g},{:.5g},{}\n", histogram.edge(i) / units::um,
                       histogram.edge(i + 1) / units::um, histogram.counts[i]);
  }
  return out;
}

std::string impacts_csv(const PassageTable& table, const PairingResult& pairs) {
  std::string out =
      "series,line_down,line_up,time,plane_velocity,incident_velocity,rebound_velocity,restitution,"
      "diameter,impact,used,fate\n";
  const auto& passages = table.passages;
  for (const Impact& impact : pairs.impacts) {
    const Passage& down = passages[impact.down];
    out +=
        fmt::format("{},{},{},{:.7f},{:.6g},{:.6g},{:.6g},{:.5g},{:.5g},{},{},rebounded\n",
                    csv_cell(table.series[down.series]), down.line, passages[impact.up].line,
                    down.time, down.velocity, impact.incident, impact.rebound, impact.restitution,
                    impact.diameter / units::um, impact.number, impact.used ? 1 : 0);
  }
  for (const Unpaired& lone : pairs.unpaired) {
    const Passage& down = passages[lone.down];
    out += fmt::format("{},{},,{:.7f},{:.6g},{:.6g},,,{:.5g},{},{},{}\n",
                       csv_cell(table.series[down.series]), down.line, down.time, down.velocity,
                       lone.incident, down.diameter / units::um, lone.number, lone.used ? 1 : 0,
                       lone.came_back ? "lost: came back" : "no rebound seen");
  }
  return out;
}

std::string package_json(const Json& system, const std::string& id, Provenance provenance,
                         const std::string& events_file, const std::string& description,
                         double sizes_height) {
  Json recoil = {{"provenance", to_string(provenance)}};
  recoil.update(system);
  if (sizes_height > 0.0) recoil["mixed_sizes"] = "sizes.csv";
  const auto columns_of_package = Json::array({
      package_field("series", "string", "", "the run, and the size class where there are several"),
      package_field("diameter", "number", "um", "mean over the impacts"),
      package_field("incident_velocity", "number", "m/s", "mean normal velocity at the surface"),
      package_field("velocity_sd", "number", "m/s", "standard error of that mean"),
      package_field("restitution", "number", "1",
                    "mean of rebound over incident velocity, rebounds only"),
      package_field("restitution_sd", "number", "1", "standard error of that mean"),
      package_field("events", "integer", "1", "rebounds and captures"),
      package_field("captured", "integer", "1",
                    "passages without a rebound, less those lost or too slow"),
  });
  const Json source = {{"title", fmt::format("{}, paired by recoil pair", events_file)}};
  Json resources = Json::array({csv_resource("points", "points.csv", columns_of_package)});
  if (sizes_height > 0.0) {
    const auto bins = Json::array({
        package_field("lower", "number", "um", "lower end of the bin"),
        package_field("upper", "number", "um", "its upper end"),
        package_field("count", "integer", "1", "spheres in it"),
    });
    Json sizes = csv_resource("sizes", "sizes.csv", bins);
    sizes["title"] = "Size distribution of the incoming spheres";
    sizes["description"] =
        fmt::format("first passages towards the surface in {}, rebounded or not", events_file);
    sizes["provenance"] = to_string(provenance);
    sizes["probe_height"] = sizes_height;
    resources.push_back(sizes);
  }
  const Json package = {
      {"name", id},
      {"title", fmt::format("Impacts paired from {}", events_file)},
      {"description", description},
      {"sources", Json::array({source})},
      {"resources", resources},
      {"recoil", recoil},
  };
  return json_text(package);
}

Distributions distributions(const PassageTable& table, const PairingResult& pairs) {
  Distributions result;
  for (const Passage& passage : table.passages) result.raw_velocities.push_back(passage.velocity);
  for (const Impact& impact : pairs.impacts) {
    if (impact.number == 1) result.incoming_sizes.push_back(table.passages[impact.down].diameter);
    if (!impact.used) continue;
    result.paired_sizes.push_back(impact.diameter);
    result.paired_velocities.push_back(table.passages[impact.down].velocity);
    result.paired_velocities.push_back(table.passages[impact.up].velocity);
  }
  for (const Unpaired& lone : pairs.unpaired) {
    if (lone.number == 1) result.incoming_sizes.push_back(table.passages[lone.down].diameter);
  }
  return result;
}

std::map<std::string, std::string> histogram_files(const Distributions& distributions) {
  return {
      {"velocities-raw.csv", bins_csv(distributions.raw_velocities, 1.0)},
      {"velocities-paired.csv", bins_csv(distributions.paired_velocities, 1.0)},
      {"sizes-incoming.csv", bins_csv(distributions.incoming_sizes, units::um)},
      {"sizes-paired.csv", bins_csv(distributions.paired_sizes, units::um)},
      {"sizes.csv", sizes_csv(distributions)},
  };
}

}  // namespace recoil
