#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "core/files.hpp"
#include "core/quoting.hpp"
#include "document/terminal.hpp"
#include "report/comparison_page.hpp"
#include "report/result_json.hpp"

namespace recoil {

void add_compare(Program& program) {
  const Command command =
      program.command("compare", "fits of the same data side by side, such as laws of adhesion");
  command.footer(
      "Reads what `recoil fit FIT --out DIR` has written. AICc is given where the data state\n"
      "standard deviations; held out is the error at diameters that the fit has not seen.\n\n"
      "  recoil compare ring/fit.json jkr/fit.json dmt/fit.json");
  const auto files = std::make_shared<std::vector<std::string>>();
  command.option("FIT.json", *files, "two or more fit.json of the same datasets")
      .required()
      .values(2, 100);
  const auto json = std::make_shared<bool>(false);
  add_json_flag(command, *json);
  command.runs([files, json] {
    std::vector<ComparedFit> fits;
    for (const std::string& file : *files) fits.push_back(compared_fit(file, read_text_file(file)));
    print_text("{}", *json ? comparison_json(fits) : terminal_text(comparison_sections(fits)));
  });
}

}  // namespace recoil
