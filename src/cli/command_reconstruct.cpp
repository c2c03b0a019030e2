#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "core/error.hpp"
#include "reconstruction/reconstruction.hpp"

namespace recoil {

void add_reconstruct(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "reconstruct", "regenerate a reconstruction from its recipe, or check it");
  command->footer(
      "Makes points.csv of DIR from DIR/recipe.toml and verifies every published fact that the\n"
      "recipe names. With --check nothing is written: the file has to be what the recipe makes,\n"
      "byte for byte.\n\n"
      "  recoil reconstruct datasets/wall1990-silicon --check");
  const auto folder = std::make_shared<std::string>();
  const auto check = std::make_shared<bool>(false);
  command->add_option("DIR", *folder, "the dataset's folder")->required();
  command->add_flag("--check", *check, "only compare, and verify the facts");
  command->callback([folder, check] {
    const ReconstructionResult result = reconstruct(*folder, *check);
    fmt::print("{}", describe(result));
    if (!result.good()) {
      throw ComputationError(
          fmt::format("{}: {}", *folder,
                      result.identical ? "a fact of the recipe does not hold" : result.difference));
    }
  });
}

}  // namespace recoil
