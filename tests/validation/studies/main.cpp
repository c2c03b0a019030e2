// recoil_study: what its authors study with recoil, apart from the product. ./run study runs it.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "validation/studies/commands.hpp"

namespace recoil {
namespace {

/// The words that decide the numbers.
std::string plain_command(const std::vector<std::string>& words) {
  std::string plain;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--out" || words[i] == "--keep" || words[i] == "--threads" ||
        words[i] == "--shard") {
      ++i;
    } else {
      plain += (plain.empty() ? "" : " ") + words[i];
    }
  }
  return plain;
}

}  // namespace

int run_study_program(const std::vector<std::string>& words) {
  const std::string plain = plain_command(words);
  CLI::App program(
      "Studies of recoil by its authors: each leaves its results as JSON, and a page "
      "made from it. Run it in the project's folder.",
      "recoil_study");
  program.require_subcommand(1);
  program.footer("Exit status: 0 done, 2 the command line or a file is wrong, 3 no answer.");
  add_list(program);
  add_make(program);
  add_render(program);
  add_coverage_designs(program, plain);
  add_coverage_grid(program, plain);
  add_coverage_noise(program, plain);
  add_coverage_summary(program);
  add_hidden_effects(program, plain);
  add_pairing(program, plain);
  add_pairing_events(program);
  add_ranks(program, plain);
  add_reconstruct(program);
  add_study_merge(program);
  try {
    program.parse(std::vector<std::string>(words.rbegin(), words.rend()));
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

}  // namespace recoil

int main(int argc, char** argv) {
  return recoil::run_study_program(std::vector<std::string>(argv + 1, argv + argc));
}
