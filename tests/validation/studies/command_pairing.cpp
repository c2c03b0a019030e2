#include <fmt/format.h>

#include <memory>

#include "validation/studies/commands.hpp"
#include "validation/studies/pairing_study.hpp"
#include "validation/synthetic/event_stream.hpp"

namespace recoil {

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

}  // namespace recoil
