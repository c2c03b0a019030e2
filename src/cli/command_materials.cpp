#include <fmt/format.h>

#include "cli/commands.hpp"
#include "core/quoting.hpp"
#include "core/units.hpp"
#include "data/material_table.hpp"

namespace recoil {

void add_materials(Program& program) {
  const Command command =
      program.command("materials", "list the materials that --particle and --surface know by name");
  command.footer(
      "import and init take --particle NAME and --surface NAME; NAME,key=value changes a\n"
      "constant. The errors go with them into the dataset.\n\n"
      "  recoil import drops.csv --format heights --into ball --particle steel --surface glass "
      "...\n"
      "  recoil init my-spheres --particle steel,density=7700 --surface silicon --diameter 70");
  command.runs([] {
    print_text("{:<16}{:>16}{:>20}{:>18}  {}\n", "name", "density [kg/m3]", "E [GPa]", "nu", "");
    for (const TabledMaterial& one : tabled_materials()) {
      print_text("{:<16}{:>8.0f} +- {:<4.0f}{:>12.4g} +- {:<7.2g}{:>7.3g} +- {:<6.2g}  {}\n",
                 one.name, one.density, tabled_density_error * one.density,
                 one.youngs_modulus() / units::GPa, one.youngs_modulus_sd() / units::GPa,
                 one.poisson_ratio, one.poisson_ratio_sd, one.what);
    }
    print_text(
        "Source: {}.\nErrors are one standard deviation: a range of Young's modulus counts as "
        "uniform. Where it gives one value, 2 % of E, 1 % of the density and 0.01 of nu are "
        "assumed.\n",
        tabled_materials_source);
  });
}

}  // namespace recoil
