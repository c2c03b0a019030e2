#include "validation/studies/nearest_rival.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/files.hpp"
#include "validation/studies/program_run.hpp"
#include "validation/synthetic/case_files.hpp"

namespace hidden {

namespace fs = std::filesystem;

Case without_noise(Case made) {
  for (std::size_t i = 0; i < made.points.size(); ++i) {
    made.readings[i] = made.points[i].restitution;
  }
  made.design.decimals = 6;
  return made;
}

double misfit_left(const fs::path& fit, const std::string& mechanism, const fs::path& binary) {
  std::string text = recoil::read_text_file(fit);
  if (!mechanism.empty()) {
    const std::string model = "[model]\n";
    text.insert(text.find(model) + model.size(), "mechanisms = [\"" + mechanism + "\"]\n");
  }
  const fs::path changed = fs::path(fit).replace_extension(".with.toml");
  recoil::write_whole_file(changed, text);
  const fs::path out = fit.parent_path() / "out";
  const ProgramRun run = run_program({binary.string(), "fit", changed.string(), "--replicates", "0",
                                      "--threads", "1", "--out", out.string()});
  if (run.status != 0) return std::numeric_limits<double>::infinity();
  std::ifstream in(out / "fit.json");
  return std::sqrt(nlohmann::json::parse(in)["goodness"]["chi2"].get<double>());
}

namespace {

/// Fits with a spread take a hundred times as long as others.
bool spreads(std::string_view id) { return id == "polydispersity" || id == "survivor_bias"; }

bool worth_trying(std::string_view other, std::string_view truth) {
  if (other == truth) return false;
  return !spreads(other) || spreads(truth) || truth == "rebound_truncation" || truth == "outliers";
}

}  // namespace

NearestRival nearest_rival(const Case& made, const fs::path& binary) {
  const ScratchFolder scratch;
  const fs::path fit = write_case(without_noise(made), scratch.path());
  NearestRival closest{"", std::numeric_limits<double>::infinity()};
  for (const HiddenEffect& effect : hidden_effects()) {
    const bool in_catalogue =
        effect.kind == EffectKind::physics || effect.kind == EffectKind::measurement;
    if (!in_catalogue || !worth_trying(effect.id, made.order.effects.front())) {
      continue;
    }
    const double left = misfit_left(fit, std::string(effect.id), binary);
    if (left < closest.misfit) closest = {std::string(effect.id), left};
  }
  return closest;
}

}  // namespace hidden
