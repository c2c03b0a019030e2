#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/units.hpp"
#include "validation/recipe/passages.hpp"
#include "validation/recipe/reconstruction.hpp"
#include "validation/studies/commands.hpp"
#include "validation/studies/reconstruction_document.hpp"

namespace recoil {
namespace {

/// How to make the points of `recipe` by hand.
std::string pair_command_words(const Recipe& recipe) {
  const PairingDesign& pairing = recipe.pairing.value();
  return fmt::format(
      "  The same by hand, {0} being this folder:\n"
      "    ./run study reconstruct {0} --passages passages.csv\n"
      "    recoil pair passages.csv --unit time=s,velocity=m/s,tangential_velocity=m/s,diameter=um "
      "\\\n"
      "        --height {1:g} --angle {2:.6g} --per-bin {3} --mean-diameter --out points.csv\n",
      recipe.id, pairing.height / units::mm, pairing.angle * 180.0 / M_PI, pairing.per_bin);
}

}  // namespace

void add_reconstruct(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "reconstruct", "regenerate a reconstruction from its recipe, or check it");
  command->footer(
      "Makes points.csv of DIR from DIR/recipe.toml and verifies every published fact that the\n"
      "recipe names. With --check nothing is written: the file has to be what the recipe makes,\n"
      "byte for byte. A recipe with a table [pairing] simulates passages and makes its points\n"
      "of them with recoil pair.\n\n"
      "  ./run study reconstruct datasets/wall1990-silicon --check\n\n"
      "Where the recipe says what the instrument records, --passages writes the passages:\n\n"
      "  ./run study reconstruct datasets/li1999-sst65-silicon --passages passages.csv\n"
      "  recoil pair passages.csv --unit time=s,velocity=m/s,tangential_velocity=m/s,diameter=um");
  const auto folder = std::make_shared<std::string>();
  const auto check = std::make_shared<bool>(false);
  command->add_option("DIR", *folder, "the dataset's folder")->required();
  command->add_flag("--check", *check, "write nothing; compare, and verify the facts");
  const auto passages = std::make_shared<std::string>();
  const auto times = std::make_shared<int>(1);
  CLI::Option* to =
      command
          ->add_option("--passages", *passages,
                       "write the passages that the instrument would have recorded (CSV, for "
                       "recoil pair) instead of the points; the recipe needs a table [passages]")
          ->type_name("FILE");
  command->add_option("--times", *times, "how many times as many spheres as in the recipe")
      ->needs(to)
      ->check(CLI::Range(1, 10000));
  command->callback([folder, check, passages, times] {
    if (!passages->empty()) {
      require_writable_folder(std::filesystem::absolute(*passages).parent_path());
      const Recipe recipe = load_recipe(*folder);
      write_whole_file(*passages, draw_passages(recipe, recipe.seed, *times));
      fmt::print("{}: passages of a reconstruction; nothing here was measured\n", *passages);
      return;
    }
    const ReconstructionResult result = reconstruct(*folder, *check);
    fmt::print("{}", reconstruction_text(result));
    if (result.from_events) fmt::print("\n{}", pair_command_words(load_recipe(*folder)));
    if (!result.good()) {
      throw ComputationError(fmt::format(
          "{}: {}", *folder, result.identical ? "a published fact is not met" : result.difference));
    }
  });
}

}  // namespace recoil
