#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <sstream>

#include "diagnosis/diagnose.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

toml::table& subtable(toml::table& table, std::string_view key) {
  if (!table.contains(key)) table.insert(key, toml::table{});
  return *table.get(key)->as_table();
}

toml::array paths_from(const FitSpec& spec, const std::filesystem::path& folder) {
  toml::array paths;
  for (const std::filesystem::path& path : spec.datasets) {
    const std::filesystem::path seen =
        std::filesystem::absolute(path).lexically_normal().lexically_relative(
            std::filesystem::absolute(folder).lexically_normal());
    paths.push_back(seen.empty() ? std::filesystem::absolute(path).string() : seen.string());
  }
  return paths;
}

/// Writes the entry of one parameter with its estimate (that of its first dataset). A parameter per
/// series gets no entry: it starts at its null value, the default.
void start_at_estimate(toml::table& parameters, const ParameterSpec& spec,
                       const FitResult& fitted) {
  const auto slot = std::ranges::find_if(fitted.model.slots, [&](const ParameterSlot& s) {
    return s.parameter == spec.parameter && !s.stated;  // the data state the others
  });
  if (slot == fitted.model.slots.end() || !slot->series.empty()) return;
  toml::table& entry = subtable(parameters, spec.parameter->name);
  entry.insert_or_assign("free", spec.free);
  if (spec.free && !entry.contains("bounds")) {
    entry.insert("bounds", toml::array{spec.lower, spec.upper});
  }
  if (spec.is_derived() && !spec.free) return;
  const double value = fitted.theta[static_cast<std::size_t>(slot - fitted.model.slots.begin())];
  entry.insert_or_assign("initial", spec.free ? std::clamp(value, spec.lower, spec.upper) : value);
}

}  // namespace

std::string extended_toml(const Diagnosis& diagnosis, const std::filesystem::path& folder) {
  toml::table root = toml::parse(diagnosis.spec.text);
  toml::array paths = paths_from(diagnosis.spec, folder);
  if (paths.size() == 1) {
    root.insert_or_assign("dataset", *paths.get(0)->as_string());
  } else {
    root.insert_or_assign("dataset", paths);
  }
  const Mechanism* const loss = dry_loss_mechanism(diagnosis.spec.loss);
  if (!diagnosis.spec.loss.empty()) {
    subtable(root, "model").insert_or_assign("loss", diagnosis.spec.loss);
  }
  std::string head = fmt::format("# {}, ", diagnosis.spec.id);
  if (const ExtendedModel* extended = diagnosis.extended(); extended && extended->fit) {
    const FitSpec& spec = extended->cause.candidate.spec;
    head += fmt::format("extended by {}: {}\n", extended->cause.candidate.name(),
                        to_string(diagnosis.verdict()));
    toml::array mechanisms;
    for (const std::string& id : spec.mechanisms) {
      if (loss == nullptr || id != loss->info.id) mechanisms.push_back(id);
    }
    subtable(root, "model").insert_or_assign("mechanisms", mechanisms);
    toml::table& parameters = subtable(root, "parameters");
    for (const ParameterSpec& parameter : spec.parameters) {
      start_at_estimate(parameters, parameter, *extended->fit);
    }
  } else {
    head += fmt::format("as it was: {}\n", to_string(diagnosis.verdict()));
  }
  std::ostringstream text;
  text << root;
  return head + text.str() + "\n";
}

}  // namespace recoil
