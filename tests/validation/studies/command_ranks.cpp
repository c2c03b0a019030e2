#include <memory>

#include "validation/studies/commands.hpp"
#include "validation/studies/rank_study.hpp"

namespace recoil {

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

}  // namespace recoil
