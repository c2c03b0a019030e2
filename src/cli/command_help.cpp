#include "cli/commands.hpp"

namespace recoil {

void add_help(Program& program) {
  program.command("help", "show the help of recoil or of a command", R"(
  recoil help
  recoil help fit)",
                  [&program](const GivenOptions& given) {
                    if (given.has("COMMAND")) {
                      program.run({given.text("COMMAND"), "--help"});
                    } else {
                      program.run({"--help"});
                    }
                  });
}

}  // namespace recoil
