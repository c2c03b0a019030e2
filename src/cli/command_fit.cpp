#include <fmt/format.h>

#include <memory>

#include "cli/analysis.hpp"
#include "cli/commands.hpp"
#include "cli/common_options.hpp"
#include "core/files.hpp"
#include "report/json_report.hpp"
#include "report/posterior_report.hpp"

namespace recoil {

void add_fit(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("fit", "fit all points, with intervals and the two-point comparison");
  command->footer(
      "Prints the report and writes DIR/fit.json. Every digit depends only on the fit file, the\n"
      "data and the seed, not on the number of threads. Ctrl-C keeps finished replicates in DIR,\n"
      "and the same command goes on from there.\n\n"
      "  recoil fit fits/dahneke1975-quartz.toml --out results");
  const auto options = std::make_shared<AnalysisFlags>();
  const auto out = std::make_shared<std::string>();
  const auto fit_file = std::make_shared<std::string>();
  command->add_option("FIT", *fit_file, "a fit file")->required();
  command->add_option("--out", *out, "folder for fit.json (default: nothing is written)")
      ->type_name("DIR");
  add_analysis_flags(*command, *options);
  const auto json = std::make_shared<bool>(false);
  add_json_flag(*command, *json);
  command->callback([=] {
    if (!out->empty()) require_writable_folder(*out);
    AnalysisOptions resolved = options->resolved();
    resolved.folder = *out;
    const Analysis analysis = analyse(load_inputs(*fit_file), resolved);
    const std::string result = json_report(analysis);
    if (!out->empty()) {
      const std::filesystem::path folder = *out;
      write_whole_file(folder / "fit.json", result);
      const std::string draws = posterior_csv(analysis);
      if (!draws.empty()) write_whole_file(folder / "posterior.csv", draws);
      forget_replicates(*out);
    }
    fmt::print("{}", *json ? result : text_report(analysis));
  });
}

}  // namespace recoil
