#include <memory>

#include "validation/studies/commands.hpp"
#include "validation/studies/event_chain.hpp"

namespace recoil {

void add_event_chain(CLI::App& program, const std::string& words) {
  CLI::App* command = program.add_subcommand(
      "event-chain",
      "events, pairing, points and fit of the steel reconstructions, beside their "
      "truth, with each correction left out");
  const auto run = std::make_shared<StudyRun>();
  run->command = words;
  add_run_options(*command, *run);
  command->callback([run] {
    EventChain chain = study_event_chain(".");
    chain.stamp = run->stamp();
    publish(*run, event_chain_json(chain), event_chain_page(chain));
  });
}

}  // namespace recoil
