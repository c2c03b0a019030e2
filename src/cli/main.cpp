#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>

#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/gsl_errors.hpp"

namespace {

constexpr int wrong_input = 2;
constexpr int no_answer = 3;

/// CLI11's complaint as one line, with a suggestion.
std::string one_line(const CLI::ParseError& error, const CLI::App& program, int argc, char** argv) {
  std::string message = error.what();
  for (char& c : message) {
    if (c == '\n') c = ' ';
  }
  std::vector<std::string> known;
  for (const CLI::App* command : program.get_subcommands({})) known.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' &&
      std::find(known.begin(), known.end(), argv[1]) == known.end()) {
    const std::string near = recoil::nearest_word(argv[1], known);
    return fmt::format("unknown command '{}' {}", argv[1],
                       near.empty() ? "see recoil --help" : fmt::format("did you mean {}?", near));
  }
  const std::string command = argc > 1 && argv[1][0] != '-' ? fmt::format(" {}", argv[1]) : "";
  return fmt::format("{} (the command line is wrong) see recoil{} --help", message, command);
}

}  // namespace

int main(int argc, char** argv) {
  recoil::gsl_errors_are_values();
  CLI::App program(
      "recoil: how well does a model of microsphere impact fit measured restitution, and how sure\n"
      "are its parameters? Start with: recoil check DIR, then recoil fit FIT.",
      "recoil");
  program.set_version_flag("--version", "recoil " RECOIL_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Exit status: 0 done, 2 the input or the command line is wrong, 3 no usable answer.\n"
      "recoil COMMAND --help shows an example of each.");
  recoil::add_check(program);
  recoil::add_simulate(program);
  recoil::add_fit(program);
  recoil::add_coverage(program);
  recoil::add_reconstruct(program);
  recoil::add_report(program);
  try {
    program.parse(argc, argv);
    return 0;
  } catch (const CLI::Success& request) {  // --help, --version
    return program.exit(request);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "recoil: {}\n", one_line(error, program, argc, argv));
    return wrong_input;
  } catch (const recoil::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return wrong_input;
  } catch (const recoil::ComputationError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return no_answer;
  } catch (const std::exception& error) {
    fmt::print(stderr, "recoil: unexpected: {} (this is a defect of recoil) please report it\n",
               error.what());
    return no_answer;
  }
}
