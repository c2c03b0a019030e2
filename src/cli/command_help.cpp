#include "cli/commands.hpp"

namespace recoil {

void add_help(Program& program) {
  program.command("help", "show the help of recoil or of a command", R"(
  recoil help
  recoil help fit)",
                  [&program](const GivenOptions& given) {
                    std::vector<std::string> words = given.texts("COMMAND");
                    words.emplace_back("--help");
                    program.run(words);
                  });
}

}  // namespace recoil
