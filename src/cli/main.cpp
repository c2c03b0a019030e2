#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>

#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/gsl_errors.hpp"
#include "core/interrupt.hpp"

namespace {

constexpr int wrong_input = 2;
constexpr int no_answer = 3;

/// The first --option that its command does not have, with the nearest that it has; empty when all
/// are known.
std::string unknown_option(const CLI::App& program, int argc, char** argv) {
  const std::vector<const CLI::App*> commands = program.get_subcommands({});
  const auto found = std::find_if(commands.begin(), commands.end(), [&](const CLI::App* command) {
    return argc > 1 && command->get_name() == argv[1];
  });
  if (found == commands.end()) return "";
  std::vector<std::string> known;
  for (const CLI::Option* option : (*found)->get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (int i = 2; i < argc; ++i) {
    const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (word.rfind("--", 0) != 0 || word == "--") continue;
    if (std::find(known.begin(), known.end(), word) != known.end()) continue;
    const std::string near = recoil::nearest_word(word, known);
    return fmt::format("unknown option '{}' of recoil {}; {}", word, argv[1],
                       near.empty() ? fmt::format("see recoil {} --help", argv[1])
                                    : fmt::format("did you mean {}?", near));
  }
  return "";
}

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
    return fmt::format("unknown command '{}'; {}", argv[1],
                       near.empty() ? "see recoil --help" : fmt::format("did you mean {}?", near));
  }
  if (const std::string option = unknown_option(program, argc, argv); !option.empty()) {
    return option;
  }
  if (argc == 1) return "a command is missing; recoil --help lists them";
  const std::string command = argc > 1 && argv[1][0] != '-' ? fmt::format(" {}", argv[1]) : "";
  return fmt::format("{}; see recoil{} --help", message, command);
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
      "recoil COMMAND --help shows an example of each, recoil help lists the pages of the manual.");
  recoil::add_check(program);
  recoil::add_simulate(program);
  recoil::add_fit(program);
  recoil::add_diagnose(program);
  recoil::add_coverage(program);
  recoil::add_init(program);
  recoil::add_import(program);
  recoil::add_predict(program);
  recoil::add_export(program);
  recoil::add_compare(program);
  recoil::add_report(program);
  recoil::add_merge(program);
  recoil::add_cluster(program);
  recoil::add_pair(program);
  recoil::add_plan(program);
  recoil::add_help(program);
  constexpr const char* output_is_lost =
      "the output could not be written: standard output is full or closed";
  try {
    program.parse(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      throw recoil::ComputationError(output_is_lost);
    }
    return 0;
  } catch (const CLI::Success& request) {  // --help, --version
    return program.exit(request);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "recoil: {}\n", one_line(error, program, argc, argv));
    return wrong_input;
  } catch (const recoil::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return wrong_input;
  } catch (const recoil::Interrupted& stopped) {
    fmt::print(stderr, "{}\n", stopped.what());
    const int signal = recoil::stop_signal();
    std::fflush(nullptr);
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // so that the shell sees what stopped it
    return 128 + signal;
  } catch (const recoil::ComputationError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return no_answer;
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) {  // {fmt} throws where it cannot print
      fmt::print(stderr, "{}\n", output_is_lost);
      return no_answer;
    }
    fmt::print(stderr, "recoil: {} (this is a defect of recoil); please report it\n", error.what());
    return no_answer;
  }
}
