// recoil_study: what its authors study with recoil, apart from the product. ./run study runs it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <iterator>
#include <sstream>

#include "analysis/analysis.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/program.hpp"
#include "core/progress.hpp"
#include "core/resumable.hpp"
#include "core/units.hpp"
#include "document/terminal.hpp"
#include "validation/recipe/recipe.hpp"
#include "validation/recipe/reconstruction.hpp"
#include "validation/studies/bent_truth.hpp"
#include "validation/studies/coverage_noise.hpp"
#include "validation/studies/coverage_page.hpp"
#include "validation/studies/hidden_effects_benchmark.hpp"
#include "validation/studies/hidden_effects_tally.hpp"
#include "validation/studies/markdown.hpp"
#include "validation/studies/pairing_study.hpp"
#include "validation/studies/rank_study.hpp"
#include "validation/studies/study_list.hpp"

namespace recoil {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Runs one command line. @return the exit status
int run_study_program(const Words& words);

/// The options of all commands; a command line has one command.
struct Options {
  Words plain;       ///< the words that decide the numbers, without places and threads
  std::string out;   ///< the JSON; empty: none, the page alone is printed
  std::string keep;  ///< a folder for what is finished; empty: nowhere
  int threads = 0;
  std::string shard;  ///< "3/40": only this share of what is studied is made, and kept

  Words fit_files;
  int datasets = 100;
  int replicates = 39;
  Words designs;
  bool exact_materials = false;

  hidden::StudySize size;
  std::string only;
  std::size_t first = 0;  ///< of the shuffled orders; 0: all
  Words whole;            ///< arms of which all orders are taken
  std::string binary;
  bool baseline = false;
  std::string sets;  ///< a folder for the data sets, for other methods

  int rank_sets = 250;
  std::uint64_t rank_seed = 20260101;

  Words names;         ///< of studies or of their results
  std::string folder;  ///< of studies, of shards or of a dataset
  bool only_missing = false;
  bool only_check = false;
  std::string passages;
  int times = 1;

  std::string command() const { return fmt::format("{}", fmt::join(plain, " ")); }
  /// Is this piece of the study this process's to make?
  bool owns(std::size_t piece) const { return shard_named(shard).value_or(Shard{}).owns(piece); }
};

// ---- results and shards ------------------------------------------------------------------------

/// Writes the result where it is wanted, with its page and picture beside it; without such a place
/// prints the page.
template <class Result>
void publish(const Options& options, Result study) {
  study.stamp = {fs::path(options.out).stem().string(), "recoil_study " + options.command(),
                 study_key(".", options.command())};
  if (options.out.empty()) {
    fmt::print("{}", markdown_page(page_of(study)));
    return;
  }
  write_whole_file(options.out, study_json(study), Replacing::data);
  render_study(options.out);
}

/// A shard is one piece: its designs or cases are files of their own in the same folder.
Origin origin_of_study(const Words& command, std::size_t shards) {
  const std::string key = study_key(".", fmt::format("{}", fmt::join(command, " ")));
  return origin_here(command, key, 0, shards, "");
}

/// For a shard writes a part that says that its pieces are kept.
/// @return whether it was one, and nothing is to be published
bool wrote_part(const Options& options) {
  if (options.shard.empty()) return false;
  const Shard shard = *shard_named(options.shard);
  const Origin origin = origin_of_study(options.plain, shard.of);
  KeptRows kept;
  kept.put(shard.number - 1, true);
  write_part(kept, options.keep, origin, shard);
  fmt::print("{}: written\n", part_path(options.keep, origin, shard).string());
  return true;
}

void run_again(const std::string& study, const Words& words) {
  if (const int status = run_study_program(words); status != 0) {
    throw ComputationError(fmt::format("{} ended with status {}", study, status));
  }
}

void merge_study(const Options& options) {
  const std::vector<Part> parts = parts_in(options.folder);
  if (options.only_missing) {
    const std::string missing = array_list(missing_shards(parts).numbers);
    if (!missing.empty()) fmt::print("--array={}\n", missing);
    return;
  }
  Words words = parts.front().origin.command;
  rows_of_parts(options.folder, origin_of_study(words, parts.front().origin.pieces));
  words.insert(words.end(), {"--keep", options.folder});
  if (!options.out.empty()) words.insert(words.end(), {"--out", options.out});
  if (options.threads > 0)
    words.insert(words.end(), {"--threads", std::to_string(options.threads)});
  run_again("the study", words);
}

void make_one(const Study& study) {
  const fs::path sets = study.name == "hidden-effects" ? "build/hidden-effects" : "";
  const bool has_sets = sets.empty() || fs::exists(sets / "truth");
  if (state_of(".", study) == StudyState::current && has_sets) {
    fmt::print("  current {}\n", study.result());
    return;
  }
  std::istringstream split(study.command);
  Words words(std::istream_iterator<std::string>(split), {});
  const std::string key = study_key(".", study.command);
  words.insert(words.end(), {"--out", study.result(), "--keep", "build/studies/" + key});
  if (!sets.empty()) words.insert(words.end(), {"--sets", sets.string()});
  run_again(study.name, words);
  fmt::print("  wrote   {}\n", study.result());
}

void make_studies(const Options& options) {
  std::vector<const Study*> wanted;
  for (const std::string& name : options.names) wanted.push_back(&study_named(name));
  if (wanted.empty()) {
    for (const Study& study : all_studies()) wanted.push_back(&study);
  }
  for (const Study* study : wanted) make_one(*study);
  write_coverage_summary("reports");
}

void list_studies() {
  fmt::print(
      "Stale studies were made from other sources, fits or data than those that are here.\n");
  for (const Study& study : all_studies()) {
    fmt::print("  {:8}{:38}{}\n", name_of(state_of(".", study)), study.name, study.result());
  }
}

// ---- studies -----------------------------------------------------------------------------------

CoverageOptions coverage_options(const Options& options, const FitSpec& spec) {
  CoverageOptions coverage;
  coverage.datasets = options.datasets;
  coverage.uncertainty.replicates = options.replicates;
  coverage.uncertainty.scheme = spec.uncertainty.scheme;
  coverage.uncertainty.level = spec.uncertainty.level;
  coverage.uncertainty.seed = spec.uncertainty.seed;
  coverage.uncertainty.threads = options.threads;
  return coverage;
}

void study_grid(const Options& options) {
  std::size_t next = 0;
  std::vector<GridDesign> designs;
  for (const GridDesign& design : designs_named(options.designs)) {
    if (options.owns(next++)) designs.push_back(design);
  }
  const FitSpec spec = load_fit(options.fit_files.front());
  const CoverageStudy study = measure_grid(spec, load_datasets(spec).front(), designs,
                                           coverage_options(options, spec), options.keep);
  if (!wrote_part(options)) publish(options, study);
}

/// All files are read before the first design is measured.
void study_designs(const Options& options) {
  std::vector<FitSpec> specs;
  std::vector<std::vector<Dataset>> datasets;
  for (const std::string& file : options.fit_files) {
    specs.push_back(load_fit(file));
    if (options.exact_materials) specs.back().uncertainty.materials = Materials::exact;
    datasets.push_back(load_datasets(specs.back()));
  }
  CoverageStudy study;
  for (std::size_t k = 0; k < specs.size(); ++k) {
    if (!options.owns(k)) continue;
    add_design(study, specs[k], datasets[k], coverage_options(options, specs[k]), options.keep);
  }
  if (!wrote_part(options)) publish(options, study);
}

void study_laws(const Options& options) {
  CoverageStudy study;
  std::size_t next = 0;
  for (const LawDesign& design : law_designs("fits")) {
    for (const BendShape shape : values_of<BendShape>()) {
      for (const double amplitude : {0.0, 0.01, 0.03, 0.1}) {
        const bool one = shape == BendShape::velocity || shape == BendShape::other_law;
        if (amplitude == 0.0 && !one) continue;
        if (amplitude > 0.0 && shape == BendShape::other_law) continue;
        if (shape == BendShape::by_size && distinct_diameters(design.datasets[0]).size() < 2)
          continue;
        if (!options.owns(next++)) continue;
        const std::string name =
            amplitude > 0.0 ? fmt::format("{}, laws wrong by {:g} % ({})", design.name,
                                          100.0 * amplitude, words_of(to_string(shape)))
            : shape == BendShape::other_law ? design.name + ", impacts of JKR"
                                            : fmt::format("{}, exact laws", design.name);
        if (!options.only.empty() && name.find(options.only) == std::string::npos) continue;
        FitSpec constants = design.spec;  // the truth draws them
        constants.uncertainty.materials = Materials::adjusted;
        const BentTruth bent{design.C_H, design.C_A, amplitude, shape};
        const CoverageOptions own = coverage_options(options, design.spec);
        add_measured(study, name, own, options.keep, name + fmt::format(" {}", own.datasets), [&] {
          return measure_coverage(
              design.spec,
              bent_truth(constants, design.datasets, bent, design.spec.uncertainty.seed), own);
        });
      }
    }
  }
  if (!wrote_part(options)) publish(options, study);
}

std::vector<hidden::Answered> answers_to(const std::vector<hidden::CaseOrder>& orders,
                                         const Options& options) {
  std::vector<hidden::Answered> answers(orders.size());
  {
    const InterruptGuard guard;
    Progress progress("hidden effects", orders.size());
    std::atomic<std::size_t> next = 0;  // in the order of the plan, whoever is free
    try {
      parallel_over(orders.size(), options.threads, [&](std::size_t) {
        const std::size_t i = next++;
        answers[i] = hidden::ask(orders[i], options.binary, options.keep, options.baseline);
        progress.advance();
      });
    } catch (const CalledOff&) {  // by a signal
    }
  }
  if (stop_requested()) {
    throw ComputationError(options.keep.empty()
                               ? "stopped; nothing is kept (--keep FOLDER would)"
                               : "stopped; what is finished is kept in " + options.keep);
  }
  return answers;
}

void study_hidden_effects(const Options& options) {
  std::vector<hidden::CaseOrder> orders;
  std::size_t next = 0;
  for (const hidden::CaseOrder& order : hidden::plan_study(options.size)) {
    if (order.key().find(options.only) == std::string::npos) continue;
    if (options.owns(next++)) orders.push_back(order);
  }
  const std::size_t planned = orders.size();
  if (options.first > 0) {
    std::size_t place = 0;
    std::erase_if(orders, [&](const hidden::CaseOrder& order) {
      const std::string_view arm = name_of(hidden::arm_of(order));
      return place++ >= options.first && std::ranges::count(options.whole, arm) == 0;
    });
  }
  const std::vector<hidden::Answered> answers = answers_to(orders, options);
  if (wrote_part(options)) return;
  if (!options.sets.empty()) hidden::write_benchmark(answers, options.sets, options.threads);
  hidden::StudyTally tally = hidden::tally_of(answers, planned, options.size);
  tally.whole = options.whole;
  publish(options, std::move(tally));
}

// ---- reconstructions ---------------------------------------------------------------------------

Sentence file_words(const ReconstructionResult& result) {
  if (result.written) return "points.csv: written";
  if (result.identical) return "points.csv: byte for byte what the recipe makes";
  return say("points.csv: NOT what the recipe makes ({})", result.difference);
}

std::string reconstruction_text(const ReconstructionResult& result) {
  Section made{"reconstruction", "Reconstruction",
               say("{}: {} points, seed {}", result.id, result.points, result.seed)};
  made.blocks = {Paragraph{
      "No point of it was measured: a committed recipe makes the points from the facts below."}};
  if (result.from_events) {
    made.blocks.emplace_back(
        Paragraph{"The points come from simulated passages, paired by recoil pair."});
  }
  made.blocks.emplace_back(Paragraph{file_words(result)});
  const Table facts = study_table<FactCheck>(
      result.facts,
      {{"fact", [](const FactCheck& fact) { return word_cell(fact.id); }},
       {"holds", [](const FactCheck& fact) { return word_cell(fact.holds ? "yes" : "NO"); }, true},
       {"as published",
        [](const FactCheck& fact) { return say("{} [{}]", fact.statement, fact.source); }, true},
       {"found", [](const FactCheck& fact) { return word_cell(fact.found); }, true}});
  const auto held = std::count_if(result.facts.begin(), result.facts.end(),
                                  [](const FactCheck& fact) { return fact.holds; });
  List assumptions;
  for (const std::string& one : result.assumptions) assumptions.entries.emplace_back(one);
  return terminal_text(std::vector<Section>{
      std::move(made),
      {"facts", "Facts", say("{} of {} hold", held, result.facts.size()), {facts}},
      {"assumptions", "Assumptions", "not published, chosen here", {std::move(assumptions)}}});
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

void reconstruct_dataset(const Options& options) {
  if (!options.passages.empty()) {
    require_writable_folder(fs::absolute(options.passages).parent_path());
    const Recipe recipe = load_recipe(options.folder);
    write_whole_file(options.passages, draw_passages(recipe, recipe.seed, options.times));
    fmt::print("{}: passages of a reconstruction; nothing here was measured\n", options.passages);
    return;
  }
  const ReconstructionResult result = reconstruct(options.folder, options.only_check);
  fmt::print("{}", reconstruction_text(result));
  if (result.from_events) fmt::print("\n{}", pair_command_words(load_recipe(options.folder)));
  if (!result.good()) {
    throw ComputationError(
        fmt::format("{}: {}", options.folder,
                    result.identical ? "a published fact is not met" : result.difference));
  }
}

// ---- the command line --------------------------------------------------------------------------

void add_out_and_threads(CLI::App& command, Options& options) {
  command.add_option("--out", options.out, "write the result here (JSON), its page beside it");
  command.add_option("--threads", options.threads, "threads to use (default: all cores)")
      ->check(CLI::Range(1, 4096));
}

void add_run_options(CLI::App& command, Options& options) {
  add_out_and_threads(command, options);
  command.add_option("--keep", options.keep,
                     "folder for finished work; a stopped study continues from it");
}

/// --shard, for a study whose pieces are kept one by one.
void add_shard_option(CLI::App& command, Options& options) {
  command
      .add_option("--shard", options.shard,
                  "make only the K-th of N shares and keep it (--keep), for recoil_study merge")
      ->type_name("K/N")
      ->needs(command.get_option("--keep"))
      ->check([](const std::string& text) -> std::string {
        return shard_named(text) ? "" : text + " is not K/N with K from 1 to N";
      });
}

CLI::App* add_coverage(CLI::App& program, const char* name, const char* what, Options& options) {
  CLI::App* command = program.add_subcommand(name, what);
  command->add_option("--datasets", options.datasets, "simulated data sets per design")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000000));
  command->add_option("--replicates", options.replicates, "bootstrap replicates of each")
      ->capture_default_str()
      ->check(CLI::Range(0, 1000000));
  add_run_options(*command, options);
  return command;
}

void add_coverages(CLI::App& program, Options& options) {
  CLI::App* grid = add_coverage(
      program, "coverage-grid",
      "how often the intervals contain the truth: 10, 20, 60 points, three kinds of scatter, "
      "stated or not, f0 fixed or free, with and without captures",
      options);
  add_shard_option(*grid, options);
  grid->add_option("FIT", options.fit_files, "whose system and estimate are the truth")
      ->required()
      ->expected(1);
  grid->add_option("--designs", options.designs,
                   "only the designs whose name has all these words, e.g. n20,stated")
      ->delimiter(',');
  grid->callback([&options] { study_grid(options); });

  CLI::App* designs =
      add_coverage(program, "coverage-designs",
                   "the same for the designs of several fits, as one table", options);
  add_shard_option(*designs, options);
  designs->add_option("FIT", options.fit_files, "fit files")->required();
  designs->add_flag("--exact-materials", options.exact_materials,
                    "take the constants of the materials as exact, as materials = false does");
  designs->callback([&options] { study_designs(options); });

  CLI::App* noise = add_coverage(program, "coverage-noise",
                                 "the same for noise that is hard to know: shared, of single "
                                 "impacts, stated from few events, of two targets",
                                 options);
  noise->callback([&options] {
    publish(options, study_noise(coverage_options(options, FitSpec{}), options.keep));
  });

  CLI::App* laws =
      add_coverage(program, "coverage-laws",
                   "the same where the laws are exact, and wrong by 1, 3 and 10 %", options);
  add_shard_option(*laws, options);
  laws->add_option("--only", options.only, "only designs whose name has this part");
  laws->callback([&options] { study_laws(options); });

  CLI::App* summary = program.add_subcommand(
      "coverage-summary", "one page and one picture of all studies of coverage in a folder");
  summary->add_option("DIR", options.folder, "with coverage-*.json")->default_val("reports");
  summary->callback([&options] { write_coverage_summary(options.folder); });
}

void add_hidden_effects(CLI::App& program, Options& options) {
  CLI::App* command = program.add_subcommand(
      "hidden-effects",
      "hides effects in simulated data, has recoil diagnose look for them, and counts its answers");
  for (const hidden::StudyPart& part : hidden::study_parts()) {
    command->add_option(part.option, options.size.*part.count, part.words);
  }
  command->add_option("--only", options.only, "only orders whose key contains this");
  command->add_option("--first", options.first,
                      "only so many of the shuffled orders: a random sample of the study");
  command->add_option("--whole", options.whole, "and all orders of these kinds")
      ->delimiter(',')
      ->check(CLI::IsMember(all_names<hidden::Arm>()));
  command->add_flag("--baseline", options.baseline,
                    "also ask stepwise AICc and the correlation with a Gaussian process");
  command->add_option("--sets", options.sets,
                      "write the data sets here, for other methods, with the truth beside them");
  // By default the command that was built together with this program.
  options.binary = (fs::read_symlink("/proc/self/exe").parent_path() / "recoil").string();
  command->add_option("--recoil", options.binary, "the command to be judged");
  command->add_option("--seed", options.size.seed, "of the data sets");
  add_run_options(*command, options);
  add_shard_option(*command, options);
  command->callback([&options] { study_hidden_effects(options); });
}

void add_pairing(CLI::App& program, Options& options) {
  CLI::App* command = program.add_subcommand(
      "pairing", "efficiency and purity of recoil pair on streams of which the truth is known");
  add_run_options(*command, options);
  command->callback([&options] { publish(options, study_pairing()); });
}

void add_ranks(CLI::App& program, Options& options) {
  CLI::App* command = program.add_subcommand(
      "posterior-ranks", "simulation-based calibration of the posterior: ranks of the truth");
  command->add_option("--datasets", options.rank_sets, "of each kind of data")
      ->capture_default_str()
      ->check(CLI::Range(10, 100000));
  command->add_option("--seed", options.rank_seed, "of the data sets");
  add_run_options(*command, options);
  command->callback([&options] {
    publish(options,
            study_ranks(options.rank_sets, options.rank_seed, options.threads, options.keep));
  });
}

void add_reconstruct(CLI::App& program, Options& options) {
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
  command->add_option("DIR", options.folder, "the dataset's folder")->required();
  command->add_flag("--check", options.only_check, "write nothing; compare, and verify the facts");
  CLI::Option* passages =
      command
          ->add_option("--passages", options.passages,
                       "write the passages that the instrument would have recorded (CSV, for "
                       "recoil pair) instead of the points; the recipe needs a table [passages]")
          ->type_name("FILE");
  command->add_option("--times", options.times, "how many times as many spheres as in the recipe")
      ->needs(passages)
      ->check(CLI::Range(1, 10000));
  command->callback([&options] { reconstruct_dataset(options); });
}

/// The committed studies as a whole: which are current, their merging, their pages.
void add_studies(CLI::App& program, Options& options) {
  program.add_subcommand("list", "the committed studies, and which are current")
      ->callback(list_studies);

  CLI::App* make =
      program.add_subcommand("make", "make those that are stale or missing, and all pages");
  make->add_option("STUDY", options.names, "only these");
  make->callback([&options] { make_studies(options); });

  CLI::App* render = program.add_subcommand("render", "make page and picture of results again");
  render->add_option("RESULT", options.names, "reports/NAME.json")->required();
  render->callback([&options] {
    for (const std::string& file : options.names) render_study(file);
  });

  CLI::App* merge = program.add_subcommand(
      "merge", "put the shards of a study together, as if one process had made it");
  merge->add_option("DIR", options.folder, "the folder that the shards keep (--keep)")->required();
  merge->add_flag("--missing", options.only_missing,
                  "only print which shards are missing, as --array=3,7-9");
  add_out_and_threads(*merge, options);
  merge->callback([&options] { merge_study(options); });
}

Words plain_words(const Words& words) {
  Words plain;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--out" || words[i] == "--keep" || words[i] == "--threads" ||
        words[i] == "--shard" || words[i] == "--sets") {
      ++i;
    } else {
      plain.push_back(words[i]);
    }
  }
  return plain;
}

int run_study_program(const Words& words) {
  Options options;
  options.plain = plain_words(words);
  CLI::App program(
      "Studies of recoil by its authors: each leaves its results as JSON, and a page "
      "made from it. Run it in the project's folder.",
      "recoil_study");
  program.require_subcommand(1);
  program.footer("Exit status: 0 done, 2 the command line or a file is wrong, 3 no answer.");
  add_studies(program, options);
  add_coverages(program, options);
  add_hidden_effects(program, options);
  add_pairing(program, options);
  add_ranks(program, options);
  add_reconstruct(program, options);
  try {
    program.parse(Words(words.rbegin(), words.rend()));
    return 0;
  } catch (const CLI::Success& request) {
    return program.exit(request);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "recoil_study: {}\n", error.what());
    return 2;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return stop_requested() ? 128 + stop_signal() : 3;
  }
}

}  // namespace
}  // namespace recoil

int main(int argc, char** argv) {
  recoil::Progress::show_in_this_process();
  return recoil::run_study_program(std::vector<std::string>(argv + 1, argv + argc));
}
