#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "core/quoting.hpp"
#include "data/dataset.hpp"
#include "report/dataset_page.hpp"

namespace recoil {

void add_check(Program& program) {
  const Command command =
      program.command("check", "validate a dataset folder and show what it holds");
  command.footer(
      "Reads datapackage.json and the points that it names, converts the units and prints what "
      "was\n"
      "understood. A mistake is answered with one line:\n"
      "  file:line:column: problem (why it is one); suggestion\n\n"
      "  recoil check datasets/dahneke1975-quartz");
  const auto folder = std::make_shared<std::string>();
  command.option("DIR", *folder, "the dataset's folder").required();
  command.runs([folder] { print_text("{}", dataset_text(load_dataset(*folder))); });
}

}  // namespace recoil
