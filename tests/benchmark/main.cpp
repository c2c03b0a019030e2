// ./run bench: how fast the fast path, the bootstrap and a fit are, beside the reference and beside
// Python and R, and how the cost grows. Writes benchmark.json into the build folder,
// reports/benchmark.md, and the table of docs/speed.md.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "common.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "design.hpp"
#include "impacts.hpp"
#include "measure.hpp"
#include "peer.hpp"
#include "scaling.hpp"
#include "shipped_fits.hpp"
#include "table.hpp"
#include "uncertainty/bootstrap.hpp"

namespace recoil::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t impact_count = 1024;
constexpr int replicates = 1999;

/// Google Benchmark's table on the terminal, and the medians kept in seconds by benchmark name.
class Keeper : public benchmark::ConsoleReporter {
 public:
  Keeper() : ConsoleReporter(isatty(STDOUT_FILENO) != 0 ? OO_ColorTabular : OO_Tabular) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.error_occurred) failure_ = run.benchmark_name() + ": " + run.error_message;
      if (run.aggregate_name != "median") continue;
      seconds_[run.run_name.function_name] =
          run.GetAdjustedRealTime() / benchmark::GetTimeUnitMultiplier(run.time_unit);
    }
    ConsoleReporter::ReportRuns(runs);
  }

  double seconds(const std::string& name) const {
    const auto found = seconds_.find(name);
    if (found == seconds_.end()) {
      throw ComputationError("no time for " + name + (failure_.empty() ? "" : "; " + failure_));
    }
    return found->second;
  }

 private:
  std::map<std::string, double> seconds_;
  std::string failure_;
};

/// The time of one of `count` equal pieces of work of an iteration.
benchmark::Counter time_of_each(std::size_t count) {
  return {static_cast<double>(count),
          benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

using RunImpacts = void (*)(const std::vector<ImpactGroups>&, AdhesionLaw, bool,
                            std::vector<ImpactResult>&);

void register_impacts(const std::string& name, const std::vector<ImpactGroups>& impacts,
                      bool gradient, RunImpacts run, AdhesionLaw law = AdhesionLaw::ring) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [&impacts, gradient, run, law](benchmark::State& state) {
                                 const tbb::global_control one_thread(
                                     tbb::global_control::max_allowed_parallelism, 1);
                                 std::vector<ImpactResult> results;
                                 for (auto _ : state) {
                                   run(impacts, law, gradient, results);
                                   benchmark::DoNotOptimize(results.data());
                                 }
                                 state.counters["each"] = time_of_each(impacts.size());
                               })
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->Repetitions(5)
      ->DisplayAggregatesOnly();
}

std::string law_name(AdhesionLaw law, const char* solver) {
  return fmt::format("impact_with_gradient/{}/{}", to_string(law), solver);
}

/// The laws of adhesion beside the ring's.
std::vector<AdhesionLaw> other_laws() {
  std::vector<AdhesionLaw> laws;
  for (const AdhesionLaw law : values_of<AdhesionLaw>()) {
    if (law != AdhesionLaw::ring) laws.push_back(law);
  }
  return laws;
}

Json impact_results(const std::vector<ImpactGroups>& impacts, const Keeper& keeper) {
  const auto nanoseconds = [&](const char* name) {
    return keeper.seconds(name) / static_cast<double>(impacts.size()) * 1e9;
  };
  const double fast = nanoseconds("impact_with_gradient/fast");
  const double reference = nanoseconds("impact_with_gradient/reference");
  const double e2_fast = nanoseconds("impact/fast");
  const double e2_reference = nanoseconds("impact/reference");
  Json result = {{"fast_ns", fast},
                 {"reference_ns", reference},
                 {"ratio", reference / fast},
                 {"e2_fast_ns", e2_fast},
                 {"e2_reference_ns", e2_reference},
                 {"e2_ratio", e2_reference / e2_fast}};
  for (const AdhesionLaw law : other_laws()) {
    const double law_fast = nanoseconds(law_name(law, "fast").c_str());
    const double law_reference = nanoseconds(law_name(law, "reference").c_str());
    result["laws"].push_back({{"adhesion", to_string(law)},
                              {"fast_ns", law_fast},
                              {"reference_ns", law_reference},
                              {"ratio", law_reference / law_fast}});
  }
  result.update(describe_impacts(impacts));
  return result;
}

/// 1, 2, 4 and all cores, as far as there are that many.
std::vector<int> thread_counts() {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<int> counts;
  for (const int threads : {1, 2, 4, cores}) {
    if (threads <= cores && (counts.empty() || threads > counts.back())) counts.push_back(threads);
  }
  return counts;
}

/// The refits alone, as `recoil fit` runs them.
BootstrapResult refit_all(const FitResult& fitted, int threads) {
  UncertaintyOptions options;
  options.replicates = replicates;
  options.threads = threads;
  return bootstrap(fitted, {}, options);
}

std::string bootstrap_name(int threads) { return fmt::format("bootstrap/threads:{}", threads); }

void register_bootstrap(const FitResult& fitted) {
  // A first run says how long it takes, and wakes the threads.
  const double pilot = seconds_of([&] { refit_all(fitted, 0); });
  const int repetitions = std::clamp(static_cast<int>(4.0 / pilot), 3, 25);
  for (const int threads : thread_counts()) {
    benchmark::RegisterBenchmark(bootstrap_name(threads).c_str(),
                                 [&fitted, threads](benchmark::State& state) {
                                   for (auto _ : state) {
                                     benchmark::DoNotOptimize(refit_all(fitted, threads));
                                   }
                                   state.counters["each"] = time_of_each(replicates);
                                 })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->Iterations(1)
        ->Repetitions(repetitions)
        ->DisplayAggregatesOnly();
  }
}

Json bootstrap_results(const FitResult& fitted, const Observations& data, const Keeper& keeper) {
  Json scaling = Json::array();
  const double one = keeper.seconds(bootstrap_name(1));
  for (const int threads : thread_counts()) {
    const double seconds = keeper.seconds(bootstrap_name(threads));
    scaling.push_back(
        {{"threads", threads}, {"seconds", seconds}, {"efficiency", one / (threads * seconds)}});
  }
  const Json all = scaling.back();
  return {{"seconds", all["seconds"]},
          {"replicates", replicates},
          {"points", data.points.size()},
          {"threads", all["threads"]},
          {"free_parameters", fitted.theta.size()},
          {"failed", refit_all(fitted, 0).failed},
          {"scaling", scaling}};
}

/// @param only_impacts measures and prints the first section alone, and writes nothing
int run_all(const fs::path& program, const fs::path& root, std::size_t most_points,
            bool only_impacts) {
  const fs::path build = program.parent_path();
  const fs::path folder = build / "benchmark";
  Json results = {{"command", "./run bench"}};
  results["machine"] = describe_machine();
  results["date"] = results["machine"]["date"];
  results["machine"].erase("date");

  fmt::print("One impact, and the bootstrap\n");
  const std::vector<ImpactGroups> impacts = representative_impacts(root, impact_count);
  register_impacts("impact_with_gradient/fast", impacts, true, run_fast);
  register_impacts("impact_with_gradient/reference", impacts, true, run_reference);
  register_impacts("impact/fast", impacts, false, run_fast);
  register_impacts("impact/reference", impacts, false, run_reference);
  for (const AdhesionLaw law : other_laws()) {
    register_impacts(law_name(law, "fast"), impacts, true, run_fast, law);
    register_impacts(law_name(law, "reference"), impacts, true, run_reference, law);
  }
  if (only_impacts) {
    Keeper keeper;
    benchmark::RunSpecifiedBenchmarks(&keeper);
    fmt::print("{}\n", impact_results(impacts, keeper).dump(2));
    return 0;
  }
  write_peer_case(folder);
  const Case peer_case = load_case(folder / "fit.toml");
  const FitResult fitted = fit(peer_case.model, peer_case.data);
  if (!fitted.usable) throw ComputationError("the benchmark's own data: " + fitted.failure);
  register_bootstrap(fitted);
  Keeper keeper;
  benchmark::RunSpecifiedBenchmarks(&keeper);
  results["impact_with_gradient"] = impact_results(impacts, keeper);
  results["bootstrap"] = bootstrap_results(fitted, peer_case.data, keeper);

  fmt::print("\nCost against size\n");
  results.update(measure_scaling(program, most_points));

  fmt::print("\nCommon fits\n");
  results["common"] = measure_common(build / "recoil", folder, root / "tests/benchmark");

  fmt::print("\nThe report of every fit that is shipped\n");
  results["shipped_fits"] = measure_shipped_fits(build / "recoil", root, folder / "pages");

  fmt::print("\nThe same fit elsewhere\n");
  results["peer"] = measure_peers(peer_case, folder, root / "tests/benchmark");
  results["peer"]["bootstrap_seconds_per_refit"] =
      results["bootstrap"]["seconds"].get<double>() / replicates;

  for (const Json& one : results["peer"]["fits"]) {
    fmt::print("  {} {}\n", one["name"].get<std::string>(), one["verdict"].get<std::string>());
  }
  for (const Json& missing : results["peer"].value("missing", Json::array())) {
    fmt::print("  not run: {}\n", missing.get<std::string>());
  }
  const Json earlier = Json::parse(read_text_file(root / "tests/benchmark/earlier.json"));
  write_whole_file(build / "benchmark.json", results.dump(2) + "\n");
  write_whole_file(root / "reports/benchmark.md", benchmark_page(results, earlier));
  const fs::path page = root / "docs/speed.md";
  write_whole_file(page, with_block(read_text_file(page), short_table(results)), Replacing::data);
  fmt::print("\n{}\nWrote {}, reports/benchmark.md and the table of docs/speed.md\n",
             short_table(results), fs::relative(build / "benchmark.json", root).string());
  return 0;
}

int run(int count, char** words) {
  const fs::path program = fs::canonical("/proc/self/exe");
  if (count == 4 && std::string(words[1]) == "--scaling-case") {
    fmt::print("{}\n", scaling_case(std::stoul(words[2]), std::stoi(words[3])).dump());
    return 0;
  }
  // Repetitions of what is compared take turns, so that a change of the processor's clock or
  // another program hits all of them.
  std::vector<char*> arguments(words, words + count);
  std::string take_turns = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, take_turns.data());
  int left = static_cast<int>(arguments.size());
  benchmark::Initialize(&left, arguments.data());
  // A smaller largest case is for trying out: `recoil_benchmark 10000`, or no case at all:
  // `recoil_benchmark impacts`, and the common fits alone: `recoil_benchmark common`.
  if (left > 1 && std::string(arguments[1]) == "common") {
    const fs::path build = program.parent_path();
    fmt::print("\n{}", common_section(measure_common(build / "recoil", build / "benchmark",
                                                     RECOIL_SOURCE_DIR "/tests/benchmark")));
    return 0;
  }
  const bool only_impacts = left > 1 && std::string(arguments[1]) == "impacts";
  const std::size_t most_points = left > 1 && !only_impacts ? std::stoul(arguments[1]) : 1000000;
  return run_all(program, RECOIL_SOURCE_DIR, most_points, only_impacts);
}

}  // namespace
}  // namespace recoil::bench

int main(int count, char** words) {
  try {
    return recoil::bench::run(count, words);
  } catch (const std::exception& error) {
    fmt::print(stderr, "recoil_benchmark: {}\n", error.what());
    return 3;
  }
}
