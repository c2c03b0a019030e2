#include "options/option_requests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/error.hpp"

namespace recoil {
namespace {

void check_size_edges(const GivenOptions& given, const std::vector<double>& edges) {
  const std::string_view name = given.name_of("--size-edges");
  if (edges.size() == 1 ||
      std::ranges::adjacent_find(edges, std::greater_equal<>()) != edges.end()) {
    throw InputError({}, fmt::format("{} is one limit, or not in ascending order", name),
                     "a size class needs two limits, the lower one first",
                     "give two limits or more that ascend: 20,40,60");
  }
  if (edges.empty() || given.whole("--size-classes") == 1) return;
  throw InputError({},
                   fmt::format("{} and {} are both given", name, given.name_of("--size-classes")),
                   "both state the size classes", "remove one");
}

}  // namespace

AnalysisOptions analysis_options(const GivenOptions& given) {
  AnalysisOptions options;
  options.replicates_auto = given.text("--replicates") == "auto";
  if (const auto count = given.whole_if_any("--replicates")) {
    options.replicates = static_cast<int>(*count);
  }
  if (const auto seed = given.whole_if_any("--seed")) {
    options.seed = static_cast<std::uint64_t>(*seed);
  }
  options.threads = static_cast<int>(given.whole("--threads"));
  if (given.takes("--scheme")) options.scheme = value_named<Scheme>(given.text("--scheme"));
  if (given.takes("--solver")) options.solver = *value_named<Solver>(given.text("--solver"));
  return options;
}

std::uint64_t seed_of(const GivenOptions& given, const FitSpec& spec) {
  const auto seed = given.whole_if_any("--seed");
  return seed ? static_cast<std::uint64_t>(*seed) : spec.uncertainty.seed;
}

PassageFormat passage_format(const GivenOptions& given) {
  return {given.assignments("--unit"), given.assignments("--column"),
          given.text("--positive") == "away", given.has("--decimal-comma")};
}

PairRequest pair_request(const std::string& file, const GivenOptions& given) {
  PairRequest request;
  request.file = file;
  request.pairing.height = given.number("--height");
  request.pairing.height_range = given.number("--height-range");
  request.pairing.refine = request.pairing.height_range > 1.0;
  request.pairing.diameter_tolerance = given.number("--diameter-tolerance");
  request.pairing.velocity_tolerance = given.number("--velocity-tolerance");
  request.pairing.threshold = given.number_if_any("--threshold");
  request.pairing.angle = given.number_if_any("--angle");
  request.pairing.keep_later = given.has("--keep-later");
  request.pairing.lost_share = given.number_if_any("--lost-share");
  request.averaging.per_bin = static_cast<std::size_t>(given.whole("--per-bin"));
  request.averaging.size_classes = static_cast<std::size_t>(given.whole("--size-classes"));
  request.averaging.size_edges = given.numbers("--size-edges");
  request.averaging.mean_diameter = given.has("--mean-diameter");
  check_size_edges(given, request.averaging.size_edges);
  return request;
}

}  // namespace recoil
