// The studies as commands: each makes its results and publishes them.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "core/units.hpp"
#include "document/terminal.hpp"
#include "validation/recipe/passages.hpp"
#include "validation/recipe/reconstruction.hpp"
#include "validation/studies/commands.hpp"
#include "validation/studies/coverage_noise.hpp"
#include "validation/studies/coverage_page.hpp"
#include "validation/studies/coverage_study.hpp"
#include "validation/studies/hidden_effects_page.hpp"
#include "validation/studies/pairing_study.hpp"
#include "validation/studies/rank_study.hpp"
#include "validation/studies/study_pages.hpp"
#include "validation/studies/study_tables.hpp"
#include "validation/synthetic/event_stream.hpp"

namespace recoil {
namespace {

// ---- coverage ----------------------------------------------------------------------------------

struct CoverageRun {
  std::vector<std::string> fit_files;
  int datasets = 100;
  int replicates = 39;
  std::vector<std::string> designs;
  bool exact_materials = false;
  bool posterior = false;
  StudyRun run;
};

CoverageOptions coverage_options(const CoverageRun& options, const FitSpec& spec) {
  CoverageOptions coverage;
  coverage.datasets = options.datasets;
  coverage.uncertainty.replicates = options.replicates;
  coverage.uncertainty.scheme = spec.uncertainty.scheme;
  coverage.uncertainty.level = spec.uncertainty.level;
  coverage.uncertainty.seed = spec.uncertainty.seed;
  coverage.uncertainty.threads = options.run.threads;
  // Of one interval among many: its ends need no more digits than a count of intervals sees.
  coverage.uncertainty.posterior = options.posterior;
  coverage.uncertainty.sampling.length = 250;
  coverage.uncertainty.sampling.largest_r_hat = 1.03;
  coverage.uncertainty.sampling.least_effective = 200;
  return coverage;
}

void study_grid(const CoverageRun& options) {
  std::size_t next = 0;
  std::vector<GridDesign> designs;
  for (const GridDesign& design : designs_named(options.designs)) {
    if (options.run.owns(next++)) designs.push_back(design);
  }
  const FitSpec spec = load_fit(options.fit_files.front());
  CoverageStudy study = measure_grid(spec, load_datasets(spec).front(), designs,
                                     coverage_options(options, spec), options.run.keep);
  if (wrote_part(options.run)) return;
  study.stamp = options.run.stamp();
  publish(options.run, study_json(study), coverage_page(study, study.stamp.study));
}

/// All files are read before the first design is measured.
void study_designs(const CoverageRun& options) {
  std::vector<FitSpec> specs;
  std::vector<std::vector<Dataset>> datasets;
  for (const std::string& file : options.fit_files) {
    specs.push_back(load_fit(file));
    if (options.exact_materials) specs.back().uncertainty.materials = Materials::exact;
    datasets.push_back(load_datasets(specs.back()));
  }
  CoverageStudy study;
  for (std::size_t k = 0; k < specs.size(); ++k) {
    if (!options.run.owns(k)) continue;
    add_design(study, specs[k], datasets[k], coverage_options(options, specs[k]), options.run.keep);
  }
  if (wrote_part(options.run)) return;
  study.stamp = options.run.stamp();
  publish(options.run, study_json(study), coverage_page(study, ""));
}

void study_noise_designs(const CoverageRun& options) {
  CoverageStudy study =
      study_noise(options.designs, coverage_options(options, FitSpec{}), options.run.keep);
  study.stamp = options.run.stamp();
  publish(options.run, study_json(study), coverage_page(study, ""));
}

CLI::App* add_command(CLI::App& program, const char* name, const char* what,
                      const std::shared_ptr<CoverageRun>& options) {
  CLI::App* command = program.add_subcommand(name, what);
  command->add_option("--datasets", options->datasets, "simulated data sets per design")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command->add_option("--replicates", options->replicates, "bootstrap replicates of each")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000000));
  command->add_flag("--posterior", options->posterior, "sample the posterior of each, too");
  add_run_options(*command, options->run);
  add_shard_option(*command, options->run);
  return command;
}

// ---- hidden effects ----------------------------------------------------------------------------

struct HiddenEffectsRun {
  hidden::StudySize size;
  std::string only;
  double minutes = std::numeric_limits<double>::infinity();
  std::string binary;
  bool baseline = false;
  StudyRun run;
};

std::vector<hidden::Answered> answers_to(const std::vector<hidden::CaseOrder>& orders,
                                         const HiddenEffectsRun& options) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const auto late = [&] {
    return std::chrono::duration<double>(Clock::now() - begin).count() >= 60.0 * options.minutes;
  };
  std::vector<std::optional<hidden::Answered>> asked(orders.size());
  {
    const InterruptGuard guard;
    Progress progress("hidden effects", orders.size());
    std::atomic<std::size_t> next = 0;  // in the order of the plan, whoever is free
    try {
      parallel_over(orders.size(), options.run.threads, [&](std::size_t) {
        const std::size_t i = next++;
        asked[i] = late()
                       ? hidden::kept_answer(orders[i], options.run.keep)
                       : hidden::ask(orders[i], options.binary, options.run.keep, options.baseline);
        progress.advance();
      });
    } catch (const CalledOff&) {  // by a signal
    }
  }
  if (stop_requested()) {
    throw ComputationError(options.run.keep.empty()
                               ? "stopped; nothing is kept (--keep FOLDER would)"
                               : "stopped; what is finished is kept in " + options.run.keep);
  }
  std::vector<hidden::Answered> answers;
  for (const auto& answer : asked) {
    if (answer) answers.push_back(*answer);
  }
  return answers;
}

void study_hidden_effects(const HiddenEffectsRun& options) {
  std::vector<hidden::CaseOrder> orders;
  std::size_t next = 0;
  for (const hidden::CaseOrder& order : hidden::plan_study(options.size)) {
    if (order.key().find(options.only) == std::string::npos) continue;
    if (options.run.owns(next++)) orders.push_back(order);
  }
  const std::vector<hidden::Answered> answers = answers_to(orders, options);
  if (!options.run.shard.empty() && answers.size() < orders.size()) {
    throw ComputationError(fmt::format("{} of {} cases of this shard are left: run it again",
                                       orders.size() - answers.size(), orders.size()));
  }
  if (wrote_part(options.run)) return;
  hidden::StudyTally tally = hidden::tally_of(answers, orders.size(), options.size);
  tally.stamp = options.run.stamp();
  publish(options.run, study_json(tally), hidden::hidden_effects_page(tally));
}

// ---- reconstructions ---------------------------------------------------------------------------

Sentence file_words(const ReconstructionResult& result) {
  if (result.written) return "points.csv: written";
  if (result.identical) return "points.csv: byte for byte what the recipe makes";
  return say("points.csv: NOT what the recipe makes ({})", result.difference);
}

Table facts_table(const ReconstructionResult& result) {
  Table table;
  table.columns = {{"fact"}, {"holds", "", true}, {"as published", "", true}, {"found", "", true}};
  for (const FactCheck& fact : result.facts) {
    table.rows.push_back({Sentence(fact.id), fact.holds ? "yes" : "NO",
                          say("{} [{}]", fact.statement, fact.source), Sentence(fact.found)});
  }
  return table;
}

std::vector<Section> reconstruction_sections(const ReconstructionResult& result) {
  Section made{"reconstruction", "Reconstruction",
               say("{}: {} points, seed {}", result.id, result.points, result.seed)};
  made.blocks = {Paragraph{
      "No point of it was measured: a committed recipe makes the points from the facts below."}};
  if (result.from_events) {
    made.blocks.emplace_back(
        Paragraph{"The points come from simulated passages, paired by recoil pair."});
  }
  made.blocks.emplace_back(Paragraph{file_words(result)});
  List assumptions;
  for (const std::string& assumption : result.assumptions) {
    assumptions.entries.emplace_back(assumption);
  }
  const auto held = std::count_if(result.facts.begin(), result.facts.end(),
                                  [](const FactCheck& fact) { return fact.holds; });
  return {
      std::move(made),
      {"facts", "Facts", say("{} of {} hold", held, result.facts.size()), {facts_table(result)}},
      {"assumptions", "Assumptions", "not published, chosen here", {std::move(assumptions)}}};
}

std::string reconstruction_text(const ReconstructionResult& result) {
  return terminal_text(reconstruction_sections(result));
}

/// How to make the points of `recipe` by hand.
std::string pair_command_words(const Recipe& recipe) {
  const PairingDesign& pairing = recipe.pairing.value();
  return fmt::format(
      "  The same by hand, {0} being this folder:\n"
      "    ./run study reconstruct {0} --passages passages.csv\n"
      "    recoil pair passages.csv --unit time=s,velocity=m/s,tangential_velocity=m/s,diameter=um "
      "\\\n"
      "        --height {1:g} --angle {2:.6g} --per-bin {3} --mean-diameter --out points.csv\n",
      recipe.id, pairing.height / units::mm, pairing.angle * 180.0 / M_PI, pairing.per_bin);
}

}  // namespace

void add_coverage_grid(CLI::App& program, const std::string& words) {
  const auto options = std::make_shared<CoverageRun>();
  options->run.command = words;
  CLI::App* command = add_command(
      program, "coverage-grid",
      "how often the intervals contain the truth: 10, 20, 60 points, three kinds of scatter, "
      "stated or not, f0 fixed or free, with and without captures",
      options);
  command->add_option("FIT", options->fit_files, "whose system and estimate are the truth")
      ->required()
      ->expected(1);
  command
      ->add_option("--designs", options->designs,
                   "only the designs whose name has all these words, e.g. n20,stated")
      ->delimiter(',');
  command->callback([options] { study_grid(*options); });
}

void add_coverage_designs(CLI::App& program, const std::string& words) {
  const auto options = std::make_shared<CoverageRun>();
  options->run.command = words;
  CLI::App* command =
      add_command(program, "coverage-designs",
                  "the same for the designs of several fits, as one table", options);
  command->add_option("FIT", options->fit_files, "fit files")->required();
  command->add_flag("--exact-materials", options->exact_materials,
                    "take the constants of the materials as exact, as materials = false does");
  command->callback([options] { study_designs(*options); });
}

void add_coverage_noise(CLI::App& program, const std::string& words) {
  const auto options = std::make_shared<CoverageRun>();
  options->run.command = words;
  CLI::App* command = add_command(program, "coverage-noise",
                                  "the same for noise that is hard to know: shared, of single "
                                  "impacts, stated from few events, of two targets",
                                  options);
  command
      ->add_option("--designs", options->designs, "only the designs whose name has all these words")
      ->delimiter(',');
  command->callback([options] { study_noise_designs(*options); });
}

void add_coverage_summary(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "coverage-summary", "one page and one picture of all studies of coverage in a folder");
  const auto folder = std::make_shared<std::string>("reports");
  command->add_option("DIR", *folder, "with coverage-*.json")->capture_default_str();
  command->callback([folder] { write_coverage_summary(*folder); });
}

void add_hidden_effects(CLI::App& program, const std::string& words) {
  CLI::App* command = program.add_subcommand(
      "hidden-effects",
      "hides effects in simulated data, has recoil diagnose look for them, and counts its answers");
  const auto options = std::make_shared<HiddenEffectsRun>();
  options->run.command = words;
  // The command that was built together with this program.
  options->binary =
      (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "recoil").string();
  hidden::StudySize& size = options->size;
  command->add_option("--datasets", size.per_cell, "of each effect, design and strength");
  command->add_option("--correct", size.correct, "with nothing hidden");
  command->add_option("--pairs", size.pairs, "of each pair, design and strength");
  command->add_option("--outside", size.outside, "of each outside effect, design and strength");
  command->add_option("--single", size.single, "of each effect and strength with one diameter");
  command->add_option("--careless", size.careless,
                      "of each kind of error that is not stated, and design");
  command->add_option("--bent", size.bent,
                      "of each effect, design and visible strength, by a law bent by 10 % (half as "
                      "many by 20 %)");
  command->add_option("--other-law", size.other_law,
                      "of each effect with a second published law, design and visible strength");
  command->add_option("--base-bent", size.base_bent,
                      "with nothing hidden and the losses of the base model bent by 3 %");
  command->add_option("--impossible", size.impossible,
                      "of each effect and design, at three times what nature has");
  command->add_option("--conditions", size.conditions,
                      "of each effect that a condition takes away, design and visible strength, "
                      "with its condition stated and again varied");
  command->add_option("--loop", size.loop,
                      "of each effect, design and visible strength, asked again after doing what "
                      "the answer advises, three times at most");
  command->add_option("--dropped", size.dropped,
                      "of each effect of drops of spheres of millimetres and visible strength; six "
                      "times as many with heights set wrong, and with nothing hidden");
  command->add_option("--rounded", size.rounded,
                      "of each step of reading, design of drops and effect: heights or times of "
                      "flight that are read to a finite step");
  command->add_option("--odd", size.odd, "of each design, with a few points misread");
  command->add_option("--only", options->only, "only orders whose key contains this");
  command->add_flag("--baseline", options->baseline,
                    "also ask stepwise AICc and the correlation with a Gaussian process");
  command->add_option("--recoil", options->binary, "the command to be judged");
  command->add_option("--at-most-minutes", options->minutes,
                      "begin no further diagnosis after this time and report what is done (0: what "
                      "is kept)");
  command->add_option("--seed", size.seed, "of the data sets");
  add_run_options(*command, options->run);
  add_shard_option(*command, options->run);
  command->callback([options] { study_hidden_effects(*options); });
}

void add_pairing(CLI::App& program, const std::string& words) {
  CLI::App* command = program.add_subcommand(
      "pairing", "efficiency and purity of recoil pair on streams of which the truth is known");
  const auto run = std::make_shared<StudyRun>();
  run->command = words;
  add_run_options(*command, *run);
  command->callback([run] {
    PairingStudy study = study_pairing();
    study.stamp = run->stamp();
    publish(*run, study_json(study), pairing_page(study));
  });
}

void add_pairing_events(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("pairing-events", "prints one such stream, to try recoil pair on");
  const auto design = std::make_shared<stream::Design>();
  command->add_option("SPHERES", design->spheres, "how many")->required();
  command->add_option("RATE", design->rate, "spheres per second")->required();
  command->callback([design] { fmt::print("{}", stream::simulate(*design).csv); });
}

void add_ranks(CLI::App& program, const std::string& words) {
  CLI::App* command = program.add_subcommand(
      "posterior-ranks", "simulation-based calibration of the posterior: ranks of the truth");
  struct Options {
    int sets = 250;
    std::uint64_t seed = 20260101;
    StudyRun run;
  };
  const auto options = std::make_shared<Options>();
  options->run.command = words;
  command->add_option("--datasets", options->sets, "of each kind of data")
      ->capture_default_str()
      ->check(CLI::Range(10, 100000));
  command->add_option("--seed", options->seed, "of the data sets");
  add_run_options(*command, options->run);
  command->callback([options] {
    RankStudy study =
        study_ranks(options->sets, options->seed, options->run.threads, options->run.keep);
    study.stamp = options->run.stamp();
    publish(options->run, study_json(study), rank_page(study));
  });
}

void add_reconstruct(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "reconstruct", "regenerate a reconstruction from its recipe, or check it");
  command->footer(
      "Makes points.csv of DIR from DIR/recipe.toml and verifies every published fact that the\n"
      "recipe names. With --check nothing is written: the file has to be what the recipe makes,\n"
      "byte for byte. A recipe with a table [pairing] simulates passages and makes its points\n"
      "of them with recoil pair.\n\n"
      "  ./run study reconstruct datasets/wall1990-silicon --check\n\n"
      "Where the recipe says what the instrument records, --passages writes the passages:\n\n"
      "  ./run study reconstruct datasets/li1999-sst65-silicon --passages passages.csv\n"
      "  recoil pair passages.csv --unit time=s,velocity=m/s,tangential_velocity=m/s,diameter=um");
  const auto folder = std::make_shared<std::string>();
  const auto check = std::make_shared<bool>(false);
  command->add_option("DIR", *folder, "the dataset's folder")->required();
  command->add_flag("--check", *check, "write nothing; compare, and verify the facts");
  const auto passages = std::make_shared<std::string>();
  const auto times = std::make_shared<int>(1);
  CLI::Option* to =
      command
          ->add_option("--passages", *passages,
                       "write the passages that the instrument would have recorded (CSV, for "
                       "recoil pair) instead of the points; the recipe needs a table [passages]")
          ->type_name("FILE");
  command->add_option("--times", *times, "how many times as many spheres as in the recipe")
      ->needs(to)
      ->check(CLI::Range(1, 10000));
  command->callback([folder, check, passages, times] {
    if (!passages->empty()) {
      require_writable_folder(std::filesystem::absolute(*passages).parent_path());
      const Recipe recipe = load_recipe(*folder);
      write_whole_file(*passages, draw_passages(recipe, recipe.seed, *times));
      fmt::print("{}: passages of a reconstruction; nothing here was measured\n", *passages);
      return;
    }
    const ReconstructionResult result = reconstruct(*folder, *check);
    fmt::print("{}", reconstruction_text(result));
    if (result.from_events) fmt::print("\n{}", pair_command_words(load_recipe(*folder)));
    if (!result.good()) {
      throw ComputationError(fmt::format(
          "{}: {}", *folder, result.identical ? "a published fact is not met" : result.difference));
    }
  });
}

}  // namespace recoil
