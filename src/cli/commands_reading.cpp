#include <fmt/format.h>

#include "cli/commands.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "core/units.hpp"
#include "data/dataset.hpp"
#include "data/material_table.hpp"
#include "document/terminal.hpp"
#include "report/comparison_report.hpp"
#include "report/dataset_report.hpp"
#include "report/result_json.hpp"

namespace recoil {
namespace {

/// At most `width` characters of `text`, cut behind a word.
std::string cut_to(const std::string& text, std::size_t width) {
  return text.size() <= width ? text : text.substr(0, text.rfind(' ', width - 4)) + " ...";
}

void print_materials(const GivenOptions& given) {
  constexpr std::size_t widest_note = 25;
  print_text("{:<20}{:>6}{:>9}{:>6}{:>6}{:>6}\n", "", "kg/m3", "E [GPa]", "+- %", "nu", "Y");
  for (const TabledMaterial& one : tabled_materials()) {
    print_text("{:<20}{:>6.0f}{:>9.4g}{:>6.2g}{:>6.3g}{:>6}  {}\n", one.name, one.density,
               one.youngs_modulus() / units::GPa,
               100.0 * one.youngs_modulus_sd() / one.youngs_modulus(), one.poisson_ratio,
               one.yield_strength > 0.0 ? fmt::format("{:.4g}", 1e-6 * one.yield_strength) : "-",
               cut_to(std::string(one.what), widest_note));
  }
  print_line(
      "Errors are one standard deviation: a range of Young's modulus is taken as uniform; for a "
      "single value, 2 % of E, 1 % of the density and 0.01 of nu are assumed. Y is the yield "
      "strength [MPa] in this state; another state of a metal has another one.");
  print_line(fmt::format("Source: {}.", tabled_materials_source));
  if (!given.has("--verbose")) {
    print_text("Other sources: recoil materials --verbose\n");
    return;
  }
  for (const TabledMaterial& one : tabled_materials()) {
    const bool common = one.source == tabled_materials_source;
    if (common && one.what.size() <= widest_note) continue;
    print_line(fmt::format("{}: {}{}{}.", one.name, one.what,
                           common || one.what.empty() ? "" : "; ",
                           common ? "" : std::string(one.source)));
  }
}

}  // namespace

void add_check(Program& program) {
  program.command("check", "validate a dataset folder and show its contents", R"(
Reads datapackage.json and the points that it names, converts the units and prints the result.
If a file contains an error, recoil prints one line:
  file:line:column: problem (why it is one); suggestion

  recoil check datasets/dahneke1975-quartz)",
                  [](const GivenOptions& given) {
                    print_text("{}",
                               dataset_text(load_dataset(given.text("DIR")), Importance::detail));
                  });
}

void add_compare(Program& program) {
  program.command(
      "compare", "compare fits of the same data, for example with different laws of adhesion", R"(
Reads the fit.json files that `recoil fit FIT --out DIR` writes. AICc needs data with stated
standard deviations. The column "held out" is the error at diameters left out of the fit.

  recoil compare ring/fit.json jkr/fit.json dmt/fit.json)",
      [](const GivenOptions& given) {
        std::vector<ComparedFit> fits;
        for (const std::string& file : given.texts("FIT.json")) {
          fits.push_back(compared_fit(file, read_text_file(file)));
        }
        fits = told_apart(std::move(fits));
        print_text("{}", given.has("--json") ? comparison_json(fits)
                                             : terminal_text(comparison_sections(fits)));
      });
}

void add_materials(Program& program) {
  program.command("materials", "list the materials that --particle and --surface know by name", R"(
import and init take --particle NAME and --surface NAME; NAME,key=value changes a
constant. The constants enter the dataset with their errors.

  recoil import drops.csv --format heights --into ball --particle steel --surface glass ...
  recoil init my-spheres --particle steel,density=7700 --surface silicon --diameter 70)",
                  print_materials);
}

}  // namespace recoil
