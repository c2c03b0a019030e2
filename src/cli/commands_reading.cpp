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

void add_check(Program& program) {
  program.command("check", "validate a dataset folder and show its contents", R"(
Reads datapackage.json and the points that it names, converts the units and prints the result.
If a file contains an error, recoil prints one line:
  file:line:column: problem (why it is one); suggestion

  recoil check datasets/dahneke1975-quartz)",
                  [](const GivenOptions& given) {
                    print_text("{}", dataset_text(load_dataset(given.text("DIR"))));
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
  program.command(
      "materials", "list the materials that --particle and --surface know by name", R"(
import and init take --particle NAME and --surface NAME; NAME,key=value changes a
constant. The constants enter the dataset with their errors.

  recoil import drops.csv --format heights --into ball --particle steel --surface glass ...
  recoil init my-spheres --particle steel,density=7700 --surface silicon --diameter 70)",
      [](const GivenOptions&) {
        print_text("{:<22}{:>16}{:>20}{:>18}{:>9}  {}\n", "name", "density [kg/m3]", "E [GPa]",
                   "nu", "Y [MPa]", "");
        for (const TabledMaterial& one : tabled_materials()) {
          print_text(
              "{:<22}{:>8.0f} +- {:<4.0f}{:>12.4g} +- {:<7.2g}{:>7.3g} +- {:<6.2g}{:>9}  {}\n",
              one.name, one.density, tabled_density_error * one.density,
              one.youngs_modulus() / units::GPa, one.youngs_modulus_sd() / units::GPa,
              one.poisson_ratio, one.poisson_ratio_sd,
              one.yield_strength > 0.0 ? fmt::format("{:.4g}", 1e-6 * one.yield_strength)
                                       : std::string("-"),
              one.what);
        }
        print_text(
            "Source: {}.\n"
            "Errors are one standard deviation: a range of Young's modulus is taken as uniform. "
            "For a single value, 2 % of E, 1 % of the density and 0.01 of nu are assumed. Y is the "
            "yield strength in this state; another state of a metal has another one.\n",
            tabled_materials_source);
        for (const TabledMaterial& one : tabled_materials()) {
          if (one.source != tabled_materials_source) print_text("{}: {}.\n", one.name, one.source);
        }
      });
}

}  // namespace recoil
