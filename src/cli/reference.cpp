#include "cli/reference.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <functional>
#include <utility>

#include "cli/manual.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "data/datapackage.hpp"
#include "data/limits.hpp"
#include "data/text.hpp"
#include "estimate/fit_keys.hpp"
#include "estimate/fit_spec.hpp"
#include "mechanism/catalogue.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

/// Text that stands for itself: bars and stars are none of Markdown's.
std::string literal(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|' || c == '*') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string code(std::string_view text) { return fmt::format("`{}`", text); }

// ---- commands --------------------------------------------------------------------------------

/// "FLOAT", "`fast` or `reference`", "INT from 1 to 4096": what CLI11 knows of an option's values.
std::string accepted_by(const CLI::Option& option) {
  std::string type = option.get_type_name();
  if (option.get_expected_max() == 0) return "";
  const std::size_t colon = type.find(':');
  if (colon == std::string::npos) return type;
  const std::string base = type.substr(0, colon);
  std::string rule = type.substr(colon + 1);
  if (rule.rfind("({auto}) OR", 0) == 0) return "a whole number, or `auto`";
  if (rule.front() == '{') {
    std::string words;
    for (const std::string& word : CLI::detail::split(rule.substr(1, rule.size() - 2), ',')) {
      words += (words.empty() ? "" : ", ") + code(word);
    }
    return words;
  }
  const std::size_t range = rule.find(" in [");
  if (range == std::string::npos) return base;
  const std::string limits = rule.substr(range + 5, rule.size() - range - 6);
  const std::size_t dash = limits.find(" - ");
  const std::string upper = limits.substr(dash + 3);
  if (upper.size() > 10) return fmt::format("{} from {}", base, limits.substr(0, dash));
  return fmt::format("{} from {} to {}", base, limits.substr(0, dash), upper);
}

std::string option_row(const CLI::Option& option) {
  const bool positional = option.get_positional();
  std::string name = code(option.get_name(positional));
  std::string remarks = option.get_description();
  if (option.get_required() && !positional) remarks += " (required)";
  if (!option.get_default_str().empty()) {
    remarks += fmt::format(" (default: {})", option.get_default_str());
  }
  return fmt::format("| {} | {} | {} |\n", name, literal(positional ? "" : accepted_by(option)),
                     literal(remarks));
}

std::string commands_block(const CLI::App& program) {
  std::string out;
  for (const CLI::App* command : program.get_subcommands({})) {
    std::string positionals;
    std::string rows;
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_group().empty() || option->get_name() == "--help") continue;
      if (option->get_positional()) {
        const std::string word = option->get_name(true);
        const bool several = option->get_expected_max() > 1;
        positionals += option->get_required() ? " " + word
                                              : fmt::format(" [{}{}]", word, several ? "..." : "");
      }
      rows += option_row(*option);
    }
    if (!out.empty()) out += "\n";
    out += fmt::format("## recoil {}{}\n\n{}.\n", command->get_name(), positionals,
                       capitalised(command->get_description()));
    if (!rows.empty()) out += "\n| option | takes | meaning |\n|---|---|---|\n" + rows;
  }
  return out;
}

// ---- catalogue -------------------------------------------------------------------------------

std::string mechanisms_block(const CLI::App&) {
  std::string out =
      "| id | kind | what it is | parameters (in brackets: fixed unless freed) "
      "|\n|---|---|---|---|\n";
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    std::string parameters;
    for (const Parameter& p : mechanism.info.parameters) {
      const std::string name = p.free ? code(p.name) : fmt::format("[{}]", code(p.name));
      parameters += (parameters.empty() ? "" : ", ") + name;
      if (p.unit != "1") parameters += fmt::format(" {}", p.unit);
      if (p.per_series) parameters += ", one per series";
    }
    out += fmt::format("| {} | {} | {} | {} |\n", code(mechanism.info.id),
                       to_string(mechanism.info.kind), literal(mechanism.info.title), parameters);
  }
  return out;
}

/// What a parameter can be: its range, its limit, or both.
std::string plausible_words(const Parameter& p) {
  std::string words;
  if (p.limit.of == nullptr || p.plausible.lower != p.lower || p.plausible.upper != p.upper) {
    words = fmt::format("{:.4g} to {:.4g}: {}", p.plausible.lower, p.plausible.upper,
                        literal(p.plausible.why));
  }
  if (p.limit.of == nullptr) return words;
  const bool least = std::isfinite(p.limit.lower);
  const bool most = std::isfinite(p.limit.upper);
  const std::string within = least && most
                                 ? fmt::format("{:g} to {:g}", p.limit.lower, p.limit.upper)
                                 : fmt::format("at {} {:g}", least ? "least" : "most",
                                               least ? p.limit.lower : p.limit.upper);
  return fmt::format("{}{}{} {}: {}", words, words.empty() ? "" : "; ", literal(p.limit.quantity),
                     within, literal(p.limit.why));
}

std::string mechanism_details_block(const CLI::App&) {
  std::string out;
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    const MechanismInfo& info = mechanism.info;
    out += fmt::format("{}### {}\n\n{} ({}).\n\n", out.empty() ? "" : "\n", info.id, info.title,
                       to_string(info.kind));
    out += fmt::format("- Law: {}\n- Leaves: {}\n- Source: {}\n", info.formula, info.fingerprint,
                       info.source);
    if (!info.cause.empty()) out += fmt::format("- A law of: {}.\n", info.cause);
    out +=
        "\n| parameter | unit | meaning | absent at | start | bounds | plausible |\n"
        "|---|---|---|---|---|---|---|\n";
    for (const Parameter& p : info.parameters) {
      out += fmt::format("| {} | {} | {} | {:.4g} | {:.4g} | {:.4g} to {:.4g} | {} |\n",
                         code(p.name), p.unit, literal(p.meaning), p.null_value, p.initial, p.lower,
                         p.upper, plausible_words(p));
    }
  }
  return out;
}

std::string base_parameters_block(const CLI::App&) {
  std::string out =
      "| parameter | unit | meaning | start | bounds | fitted unless the file says otherwise |\n"
      "|---|---|---|---|---|---|\n";
  for (const Parameter& p : base_parameters()) {
    const bool derived = default_of(p).is_derived();
    out += fmt::format("| {} | {} | {} | {} | {:g} to {:g} | {} |\n", code(p.name), p.unit,
                       literal(p.meaning), derived ? "equation 12" : fmt::format("{:g}", p.initial),
                       p.lower, p.upper, p.free ? "yes" : "no");
  }
  return out;
}

// ---- fit files -------------------------------------------------------------------------------

std::string fit_keys_block(std::string_view table) {
  const bool defaults = table != "parameter";
  std::string out =
      defaults ? "| key | default | meaning |\n|---|---|---|\n" : "| key | meaning |\n|---|---|\n";
  for (const FitKey& key : fit_keys()) {
    if (key.table != table) continue;
    out += fmt::format("| {} |", code(key.name));
    if (defaults) out += fmt::format(" {} |", code(key.standard));
    out += fmt::format(" {} |\n", literal(key.meaning));
  }
  return out;
}

template <NamedEnum Enum>
std::string words_block(std::string_view key) {
  std::string words;
  for (const Enum value : values_of<Enum>()) words += fmt::format(", {}", code(name_of(value)));
  return fmt::format("{} takes {}.\n", code(key), words.substr(2));
}

// ---- datasets --------------------------------------------------------------------------------

std::string units_block(const CLI::App&) {
  std::string out = "| columns | measure a | units |\n|---|---|---|\n";
  for (const Dimension dimension : values_of<Dimension>()) {
    std::string columns;
    for (const Quantity quantity : values_of<Quantity>()) {
      if (dimension_of(quantity) != dimension) continue;
      columns += (columns.empty() ? "" : ", ") + code(name_of(quantity));
    }
    std::string units;
    for (const std::string& unit : unit_names(dimension)) {
      units += (units.empty() ? "" : ", ") + code(unit);
    }
    if (columns.empty() || units.empty()) continue;
    out += fmt::format("| {} | {} | {} |\n", columns, name_of(dimension), units);
  }
  return out;
}

std::string limits_block(const CLI::App&) {
  const std::pair<const char*, Range> rows[] = {
      {"diameter", limits::diameter},
      {"velocity", limits::velocity},
      {"restitution (above 1: kept, with a warning)", limits::restitution},
      {"density", limits::density},
      {"Young's modulus", limits::youngs_modulus},
      {"surface energy", limits::surface_energy},
      {"adhesion energy", limits::adhesion_energy},
      {"ambient pressure", limits::pressure},
      {"stiffness K", limits::stiffness_K},
      {"adhesion force f0", limits::adhesion_force_f0}};
  std::string out = "| quantity | unit | accepted |\n|---|---|---|\n";
  for (const auto& [what, range] : rows) {
    out += fmt::format("| {} | {} | {:g} to {:g} |\n", what, range.unit, range.lower, range.upper);
  }
  return out;
}

std::string topics_block(const CLI::App&) {
  std::string out = "| page | is about |\n|---|---|\n";
  for (const ManualPage& page : manual_pages()) {
    out += fmt::format("| [{0}]({0}.md) | {1} |\n", page.topic, page.title());
  }
  return out;
}

struct GeneratedPart {
  const char* name;
  std::function<std::string(const CLI::App&)> text;
};

const std::vector<GeneratedPart>& blocks() {
  static const std::vector<GeneratedPart> all = {
      {"topics", topics_block},
      {"commands", commands_block},
      {"base parameters", base_parameters_block},
      {"keys of [model]", [](const CLI::App&) { return fit_keys_block("model"); }},
      {"keys of a parameter", [](const CLI::App&) { return fit_keys_block("parameter"); }},
      {"keys of [noise]",
       [](const CLI::App&) {
         return fit_keys_block("noise") + "\n" + words_block<VarianceFunction>("variance");
       }},
      {"keys of [uncertainty]",
       [](const CLI::App&) {
         return fit_keys_block("uncertainty") + "\n" + words_block<Scheme>("scheme");
       }},
      {"keys of [diagnosis]", [](const CLI::App&) { return fit_keys_block("diagnosis"); }},
      {"mechanisms", mechanisms_block},
      {"mechanism details", mechanism_details_block},
      {"units", units_block},
      {"limits", limits_block}};
  return all;
}

}  // namespace

std::vector<std::string> reference_block_names() {
  std::vector<std::string> names;
  for (const GeneratedPart& block : blocks()) names.emplace_back(block.name);
  return names;
}

std::string with_reference_blocks(const std::string& page, const std::string& file,
                                  const CLI::App& program) {
  const std::string begin = "<!-- made by ./run docs: ";
  const std::string begin_end = " -->\n";
  const std::string end = "<!-- end -->";
  std::string out;
  std::size_t at = 0;
  while (true) {
    const std::size_t found = page.find(begin, at);
    if (found == std::string::npos) break;
    const std::size_t name_end = page.find(begin_end, found);
    const std::size_t last = page.find(end, found);
    if (name_end == std::string::npos || last == std::string::npos) {
      throw InputError({file}, "a block has no end", "its text is replaced",
                       "write <!-- end --> after it");
    }
    const std::size_t name_at = found + begin.size();
    const std::string name = page.substr(name_at, name_end - name_at);
    out += page.substr(at, name_end + begin_end.size() - at);
    bool made = false;
    for (const GeneratedPart& block : blocks()) {
      if (name != block.name) continue;
      out += block.text(program);
      made = true;
    }
    if (!made) {
      throw InputError({file}, fmt::format("unknown block {}", quote(name)),
                       "nothing in the code makes it", did_you_mean(name, reference_block_names()));
    }
    at = last;
  }
  return out + page.substr(at);
}

}  // namespace recoil
