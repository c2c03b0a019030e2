#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include "cli/commands.hpp"
#include "core/error.hpp"
#include "core/gsl_errors.hpp"
#include "core/interrupt.hpp"
#include "core/program.hpp"

namespace recoil {
namespace {

constexpr int wrong_input = 2;
constexpr int no_answer = 3;
constexpr const char* output_is_lost =
    "the output could not be written: standard output is full or closed";

void add_commands(Program& program) {
  add_check(program);
  add_simulate(program);
  add_fit(program);
  add_diagnose(program);
  add_coverage(program);
  add_init(program);
  add_import(program);
  add_materials(program);
  add_predict(program);
  add_export(program);
  add_compare(program);
  add_report(program);
  add_merge(program);
  add_cluster(program);
  add_pair(program);
  add_plan(program);
  add_help(program);
}

int run(const std::vector<std::string>& words) {
  Program program(
      "recoil: how well does a model of microsphere impact fit measured restitution, and how sure\n"
      "are its parameters? Start with: recoil check DIR, then recoil fit FIT.",
      "Exit status: 0 done, 2 the input or the command line is wrong, 3 no usable answer.\n"
      "recoil COMMAND --help shows an example of each, recoil help lists the pages of the manual.",
      version());
  add_commands(program);
  try {
    program.run(words);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      throw ComputationError(output_is_lost);
    }
    return 0;
  } catch (const UsageError& error) {
    fmt::print(stderr, "recoil: {}\n", error.what());
    return wrong_input;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return wrong_input;
  } catch (const Interrupted& stopped) {
    fmt::print(stderr, "{}\n", stopped.what());
    const int signal = stop_signal();
    std::fflush(nullptr);
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // so that the shell sees what stopped it
    return 128 + signal;
  } catch (const ComputationError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return no_answer;
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) {  // {fmt} throws if it cannot print
      fmt::print(stderr, "{}\n", output_is_lost);
      return no_answer;
    }
    fmt::print(stderr, "recoil: {} (this is a defect of recoil); please report it\n", error.what());
    return no_answer;
  }
}

}  // namespace
}  // namespace recoil

int main(int argc, char** argv) {
  recoil::gsl_errors_are_values();
  return recoil::run(std::vector<std::string>(argv + 1, argv + argc));
}
