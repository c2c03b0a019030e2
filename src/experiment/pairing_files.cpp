#include "experiment/pairing_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units.hpp"
#include "data/json_document.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

std::string quoted_cell(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    out += c;
    if (c == '"') out += c;
  }
  return out + "\"";
}

std::string known(double value) { return value > 0.0 ? fmt::format("{:.4g}", value) : ""; }

std::string bins_csv(const std::vector<double>& values, double unit) {
  std::string out = "rule,lower,upper,middle,count,share\n";
  for (const Histogram& histogram : {sturges(values), freedman_diaconis(values)}) {
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
      out += fmt::format(
          "{},{:.6g},{:.6g},{:.6g},{},{:.6g}\n", histogram.rule, histogram.edge(i) / unit,
          histogram.edge(i + 1) / unit, histogram.middle(i) / unit, histogram.counts[i],
          static_cast<double>(histogram.counts[i]) / static_cast<double>(values.size()));
    }
  }
  return out;
}

nlohmann::ordered_json field(const char* name, const char* type, const char* unit,
                             const char* description) {
  nlohmann::ordered_json object = {{"name", name}, {"type", type}};
  if (*unit != '\0') object["unit"] = unit;
  object["description"] = description;
  return object;
}

std::string fate_of(const Unpaired& lone) {
  return lone.came_back ? "lost: came back" : "no rebound seen";
}

}  // namespace

std::string points_csv(const Averages& averages) {
  std::string out =
      "series,diameter,incident_velocity,velocity_sd,restitution,restitution_sd,events,captured\n";
  for (const PointMean& point : averages.points) {
    const bool rebounds = point.rebounds > 0;
    out += fmt::format("{},{:.5g},{:.6g},{},{},{},{},{}\n", quoted_cell(point.series),
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

std::string impacts_csv(const EventTable& table, const PairResult& pairs) {
  std::string out =
      "series,line_down,line_up,time,plane_velocity,incident_velocity,rebound_velocity,restitution,"
      "diameter,impact,used,fate\n";
  const auto& events = table.events;
  for (const Impact& impact : pairs.impacts) {
    const Event& down = events[impact.down];
    out +=
        fmt::format("{},{},{},{:.7f},{:.6g},{:.6g},{:.6g},{:.5g},{:.5g},{},{},rebounded\n",
                    quoted_cell(table.series[down.series]), down.line, events[impact.up].line,
                    down.time, down.velocity, impact.incident, impact.rebound, impact.restitution,
                    impact.diameter / units::um, impact.number, impact.used ? 1 : 0);
  }
  for (const Unpaired& lone : pairs.unpaired) {
    const Event& down = events[lone.down];
    out += fmt::format("{},{},,{:.7f},{:.6g},{:.6g},,,{:.5g},{},{},{}\n",
                       quoted_cell(table.series[down.series]), down.line, down.time, down.velocity,
                       lone.incident, down.diameter / units::um, lone.number, lone.used ? 1 : 0,
                       fate_of(lone));
  }
  return out;
}

std::string package_json(const std::string& like_text, const std::string& like_file,
                         const std::string& id, const std::string& provenance,
                         const std::string& events_file, const std::string& description,
                         double sizes_height) {
  const JsonDocument document(like_text, like_file);
  document.root().require("recoil", "it holds the materials",
                          "name the folder of a dataset with the same materials");
  nlohmann::ordered_json recoil = nlohmann::ordered_json::parse(like_text)["recoil"];
  recoil["provenance"] = provenance;
  const auto fields = nlohmann::ordered_json::array({
      field("series", "string", "", "the run, and the size class where there are several"),
      field("diameter", "number", "um", "mean over the impacts"),
      field("incident_velocity", "number", "m/s", "mean normal velocity at the surface"),
      field("velocity_sd", "number", "m/s", "standard error of that mean"),
      field("restitution", "number", "1", "mean of rebound over incident velocity, rebounds only"),
      field("restitution_sd", "number", "1", "standard error of that mean"),
      field("events", "integer", "1", "rebounds and captures"),
      field("captured", "integer", "1", "passages without a rebound, less those lost or too slow"),
  });
  const nlohmann::ordered_json source = {
      {"title", fmt::format("{}, paired by recoil pair", events_file)}};
  const nlohmann::ordered_json resource = {
      {"name", "points"},        {"path", "points.csv"}, {"format", "csv"},
      {"mediatype", "text/csv"}, {"encoding", "utf-8"},  {"schema", {{"fields", fields}}},
  };
  auto resources = nlohmann::ordered_json::array({resource});
  if (sizes_height > 0.0) {
    const auto bins = nlohmann::ordered_json::array({
        field("lower", "number", "um", "lower end of the bin"),
        field("upper", "number", "um", "its upper end"),
        field("count", "integer", "1", "spheres in it"),
    });
    resources.push_back({
        {"name", "sizes"},
        {"path", "sizes.csv"},
        {"format", "csv"},
        {"mediatype", "text/csv"},
        {"encoding", "utf-8"},
        {"title", "Size distribution of the incoming spheres"},
        {"description",
         fmt::format("first passages towards the surface in {}, rebounded or not", events_file)},
        {"provenance", provenance},
        {"probe_height", sizes_height},
        {"schema", {{"fields", bins}}},
    });
  }
  const nlohmann::ordered_json package = {
      {"name", id},
      {"title", fmt::format("Impacts paired from {}", events_file)},
      {"description", description},
      {"sources", nlohmann::ordered_json::array({source})},
      {"resources", resources},
      {"recoil", recoil},
  };
  return package.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Distributions distributions(const EventTable& table, const PairResult& pairs) {
  Distributions result;
  for (const Event& event : table.events) result.raw_velocities.push_back(event.velocity);
  for (const Impact& impact : pairs.impacts) {
    if (impact.number == 1) result.incoming_sizes.push_back(table.events[impact.down].diameter);
    if (!impact.used) continue;
    result.paired_sizes.push_back(impact.diameter);
    result.paired_velocities.push_back(table.events[impact.down].velocity);
    result.paired_velocities.push_back(table.events[impact.up].velocity);
  }
  for (const Unpaired& lone : pairs.unpaired) {
    if (lone.number == 1) result.incoming_sizes.push_back(table.events[lone.down].diameter);
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
