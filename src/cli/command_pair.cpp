#include <fmt/format.h>

#include <optional>

#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "core/units.hpp"
#include "data/datapackage.hpp"
#include "data/dataset.hpp"
#include "experiment/averages.hpp"
#include "experiment/pairing.hpp"
#include "experiment/pairing_files.hpp"
#include "experiment/passages.hpp"
#include "report/pairing_report.hpp"
#include "report/result_json.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;

/// The provenance from the option or the package of the passages; empty if neither states it.
std::optional<Provenance> stated_provenance(const GivenOptions& given, const PassageTable& table) {
  const auto stated = value_named<Provenance>(given.text("--provenance"));
  if (stated && table.provenance && *stated != *table.provenance) {
    throw InputError(
        {},
        fmt::format("--provenance {}, but datapackage.json beside the passages states {}",
                    name_of(*stated), to_string(*table.provenance)),
        "", "correct one of them");
  }
  return stated ? stated : table.provenance;
}

/// The provenance of a dataset to be written. @throws InputError if it is not known
Provenance provenance_of(const GivenOptions& given, const PassageTable& table) {
  const auto provenance = stated_provenance(given, table);
  if (!provenance) {
    throw InputError({}, "the provenance of the passages is not known", "every dataset states it",
                     "give --provenance measured, or synthetic for simulated passages");
  }
  return *provenance;
}

/// True if the dataset gets a size distribution, which size classes do not need.
bool has_mixed_sizes(const GivenOptions& given) {
  return given.texts("--size-edges").size() <= 2 && given.whole("--size-classes") == 1;
}

void add_dataset(const GivenOptions& given, const PassageTable& table, const PairingResult& pairs,
                 const std::string& points, std::vector<WholeFile>& files) {
  const bool mixed = has_mixed_sizes(given);
  const fs::path folder = given.text("--into");
  Json system = stated_system(given.text("--like"));
  const std::vector<LeftOverride> left_out = leave_out_contradictions(system);
  const std::string package = package_json(
      system, fs::absolute(folder).lexically_normal().filename(), provenance_of(given, table),
      fs::path(table.file).filename().string(),
      fmt::format("{} impacts that recoil pair found in {} passages; the measuring plane {:.5g} mm "
                  "above the surface; velocities at the surface.",
                  pairs.impacts.size(), table.passages.size(), pairs.height / units::mm),
      mixed ? pairs.height : 0.0);
  parse_dataset(package, points, folder);  // throws if the dataset is not valid
  files.push_back({folder / "points.csv", points});
  if (mixed) files.push_back({folder / "sizes.csv", sizes_csv(distributions(table, pairs))});
  files.push_back({folder / package_file_name, package});
  if (!left_out.empty()) {
    print_text(given.has("--json") ? stderr : stdout, "note: {}\n", left_out_sentence(left_out));
  }
}

/// The files whose names are known in advance.
std::vector<fs::path> outputs_of(const GivenOptions& given) {
  std::vector<fs::path> files;
  if (given.has("--into")) {
    const fs::path folder = given.text("--into");
    files = {folder / "points.csv", folder / package_file_name};
    if (has_mixed_sizes(given)) files.push_back(folder / "sizes.csv");
  }
  for (const char* option : {"--out", "--impacts"}) {
    if (given.has(option)) files.emplace_back(given.text(option));
  }
  return files;
}

void run_pair(const GivenOptions& given) {
  const std::string passages = given.text("PASSAGES");
  const PairRequest request = pair_request(passages, given);
  if (given.has("--into") != given.has("--like")) {
    throw InputError({}, "--into and --like belong together",
                     "a dataset states the materials of its sphere and surface", "give both");
  }
  for (const char* option : {"--into", "--histograms"}) {
    if (given.has(option)) require_writable_folder(given.text(option));
  }
  for (const char* option : {"--out", "--impacts"}) {
    if (given.has(option)) require_writable_folder(fs::absolute(given.text(option)).parent_path());
  }
  const PassageTable table = read_passages(passages, passage_format(given));
  if (given.has("--into")) provenance_of(given, table);  // throws before the computation
  const std::vector<fs::path> outputs = outputs_of(given);
  const Replacing replacing = given.has("--replace") ? Replacing::data : Replacing::results;
  require_free(outputs, replacing);
  std::optional<Claim> claim;
  if (!outputs.empty()) claim.emplace(outputs.front());
  const PairedPassages paired = pair_and_average(table, request);
  const PairingResult& pairs = paired.pairs;
  const Averages& averages = paired.averages;
  const bool json = given.has("--json");
  if (!json) print_text("{}", pairing_text(table, pairs, averages));
  require_impacts(paired, request);
  if (json) print_text("{}", pairing_json(table, pairs, averages));
  const std::string points = points_csv(averages);
  std::vector<WholeFile> files;
  if (given.has("--into")) add_dataset(given, table, pairs, points, files);
  if (given.has("--out")) files.push_back({given.text("--out"), points});
  if (given.has("--impacts")) files.push_back({given.text("--impacts"), impacts_csv(table, pairs)});
  if (given.has("--histograms")) {
    for (const auto& [name, text] : histogram_files(distributions(table, pairs))) {
      files.push_back({fs::path(given.text("--histograms")) / name, text});
    }
  }
  write_whole_files(files, replacing);
}

}  // namespace

void add_pair(Program& program) {
  program.command("pair",
                  "find impacts in the passages that a phase Doppler "
                  "instrument records, and average them into points",
                  R"(
A sphere crosses the measuring plane on its way down and, if it rebounds, on its way up. The
time between is the time of free flight to the surface and back; both velocities and the
height of the plane determine it. recoil finds the height at which most passages agree, then
pairs passages by flight time and diameter, each with at most one other. Rebounds that come
down again are later impacts and are left out. Velocities are corrected to the surface,
v_s^2 = v_p^2 + 2 g h, and averaged over about 40 impacts. recoil estimates how many of the
passages without a rebound were lost, were too slow to return, and were captured.

  recoil pair run7.csv --unit time=s,velocity=m/s,diameter=um --out points.csv
  recoil pair run7.csv --height 1.2 --size-edges 20,40,60,110 --angle 8 \
      --into my-run --like datasets/li1999-sst65-silicon --provenance measured \
      --histograms my-run/histograms
  recoil check my-run)",
                  run_pair);
}

}  // namespace recoil
