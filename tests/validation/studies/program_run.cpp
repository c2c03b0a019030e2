#include "validation/studies/program_run.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "core/child.hpp"
#include "core/files.hpp"
#include "core/json.hpp"

namespace hidden {

ProgramRun run_program(const std::vector<std::string>& command) {
  const auto start = std::chrono::steady_clock::now();
  const recoil::ChildOutcome outcome = recoil::run_child(command, "", std::chrono::hours(24));
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  if (outcome.failed != 0) return {-1, 0.0, "cannot be started"};
  return {outcome.status, time.count(), outcome.err};
}

PlainFit plain_fit(const std::filesystem::path& fit, const std::vector<std::string>& mechanisms,
                   const std::filesystem::path& binary) {
  std::string text = recoil::read_text_file(fit);
  if (!mechanisms.empty()) {
    const std::string model = "[model]\n";
    text.insert(text.find(model) + model.size(),
                fmt::format("mechanisms = [\"{}\"]\n", fmt::join(mechanisms, "\", \"")));
  }
  const std::filesystem::path changed = std::filesystem::path(fit).replace_extension(".with.toml");
  recoil::write_whole_file(changed, text);
  const std::filesystem::path out = fit.parent_path() / "out";
  PlainFit found;
  if (run_program({binary.string(), "fit", changed.string(), "--replicates", "0", "--threads", "1",
                   "--out", out.string()})
          .status != 0) {
    return found;
  }
  std::ifstream in(out / "fit.json");
  const recoil::Json answer = recoil::Json::parse(in);
  double k = 0.0;
  for (const auto& [name, parameter] : answer.at("parameters").items()) {
    if (parameter.at("free").get<bool>()) k += 1.0;
  }
  for (const recoil::Json& point : answer.at("residuals")) {
    found.predicted.push_back(point.at("predicted"));
    found.residuals.push_back(point.at("weighted_residual"));
    found.sd.push_back(point.at("sd_used"));
    found.log_velocity.push_back(std::log(point.at("incident_velocity").get<double>()));
    found.log_diameter.push_back(std::log(point.at("diameter_um").get<double>()));
  }
  const auto n = static_cast<double>(found.residuals.size());
  found.chi2 = answer.at("goodness").at("chi2");
  found.aicc = found.chi2 + 2.0 * k + 2.0 * k * (k + 1.0) / (n - k - 1.0);
  return found;
}

ScratchFolder::ScratchFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "impacts-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace hidden
