#include <algorithm>

#include "cli/commands.hpp"

namespace recoil {

void add_help(Program& program) {
  program.command("help", "show the help of recoil, or all of that of a command", R"(
  recoil help
  recoil help fit)",
                  [&program](const GivenOptions& given) {
                    std::vector<std::string> words = given.texts("COMMAND");
                    const auto commands = program.commands();
                    const bool known =
                        words.empty() ||
                        std::ranges::find(commands, words.front(), &Program::CommandText::name) !=
                            commands.end();
                    if (known) words.emplace_back("--help");
                    program.help_in_full();
                    program.run(words);  // says what is wrong with an unknown command
                  });
}

}  // namespace recoil
