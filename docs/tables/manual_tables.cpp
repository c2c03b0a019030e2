#include "tables/manual_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <utility>

#include "core/error.hpp"
#include "core/units.hpp"
#include "data/datapackage.hpp"
#include "data/limits.hpp"
#include "data/text.hpp"
#include "estimate/fit_spec.hpp"
#include "mechanism/mechanism.hpp"
#include "tables/result_formats.hpp"

namespace recoil {
namespace {

/// Text with bars and stars escaped for Markdown.
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

// ---- commands ----------------------------------------------------------------------------------

/// The options of these commands.
std::string commands_table(const Program& program, const std::vector<std::string>& names) {
  std::string out;
  for (const Program::CommandText& command : program.commands()) {
    if (std::ranges::find(names, command.name) == names.end()) continue;
    std::string arguments;
    std::string rows;
    for (const OptionRow* option : options_of(command.name)) {
      if (option->is_hidden()) continue;
      if (option->is_argument()) {
        arguments += option->is_required()
                         ? fmt::format(" {}", option->name)
                         : fmt::format(" [{}{}]", option->name, option->type.most > 1 ? "..." : "");
      }
      rows += fmt::format("| {} | {} | {} |\n", code(option->name),
                          literal(option->is_argument() ? "" : value_words(option->type)),
                          literal(meaning_words(*option)));
    }
    out += fmt::format("{}## recoil {}{}\n\n{}.\n", out.empty() ? "" : "\n", command.name,
                       arguments, capitalised(command.meaning));
    if (!rows.empty()) out += "\n| option | takes | meaning |\n|---|---|---|\n" + rows;
  }
  return out;
}

// ---- Python ------------------------------------------------------------------------------------

/// The default of a keyword argument as Python.
std::string python_default(const OptionRow& row) {
  if (row.type.is_flag()) return "False";
  if (row.default_text().empty()) return "None";
  if (row.type.is_number()) return std::string(row.standard);
  return fmt::format("\"{}\"", row.standard);
}

/// The keyword arguments of a function of Python, one per line.
std::string python_arguments(const std::string& function, const std::string& before) {
  std::string lines;
  for (const OptionRow* row : arguments_of(function)) {
    const std::string value = python_default(*row);
    const std::string& type = row->type.python;
    lines += fmt::format("{}    {}: {} = {},\n", before, row->python,
                         value == "None" ? fmt::format("Optional[{}]", type) : type, value);
  }
  return lines;
}

// ---- catalogue ---------------------------------------------------------------------------------

std::string mechanisms_table() {
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

/// The plausible values of a parameter: a range, a limit of a derived quantity, or both.
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

enum class Where { measurement, surroundings, contact, adhesion };

Where where_of(const MechanismInfo& info) {
  if (info.place == MechanismPlace::gas || info.place == MechanismPlace::field) {
    return Where::surroundings;
  }
  if (info.place != MechanismPlace::contact) return Where::measurement;
  return info.needs_adhesion ? Where::adhesion : Where::contact;
}

std::string mechanism_details_table(Where where) {
  std::string out;
  for (const Mechanism& mechanism : mechanism_catalogue()) {
    const MechanismInfo& info = mechanism.info;
    if (where_of(info) != where) continue;
    out += fmt::format("{}## {}\n\n{} ({}).\n\n", out.empty() ? "" : "\n", info.id, info.title,
                       to_string(info.kind));
    out += fmt::format("- Law: {}\n- Effect: {}\n- Source: {}\n", info.formula, info.fingerprint,
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

std::string base_parameters_table() {
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

// ---- fit files ---------------------------------------------------------------------------------

std::string fit_keys_table(std::string_view table) {
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
std::string words_table(std::string_view key) {
  std::string words;
  for (const Enum value : values_of<Enum>()) words += fmt::format(", {}", code(name_of(value)));
  return fmt::format("{} takes {}.\n", code(key), words.substr(2));
}

// ---- datasets ----------------------------------------------------------------------------------

std::string units_table() {
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

std::string limits_table() {
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

// ---- JSON --------------------------------------------------------------------------------------

/// "meaning [unit]", and the names of an enum.
std::string key_meaning(const Json& schema) {
  std::string words = schema.at("description");
  std::string names;
  for (const Json& name : schema.value("enum", Json::array())) {
    if (!name.is_null()) names += fmt::format(", {}", code(name.get<std::string>()));
  }
  return literal(names.empty() ? words : fmt::format("{}: {}", words, names.substr(2)));
}

/// Adds a row for `key` and, unless they were listed before, rows for all keys inside.
/// @param listed the objects listed so far, and the keys at which they are
void add_key(const Json& schema, std::string key, std::vector<std::pair<Json, std::string>>& listed,
             std::string& rows) {
  const Json* inner = &schema;
  while (true) {
    const bool by_name = inner->contains("additionalProperties") && !inner->contains("properties");
    const bool list = inner->contains("items") && inner->at("items").contains("properties");
    if (!by_name && !list) break;
    key += by_name ? ".NAME" : "[]";
    inner = &inner->at(by_name ? "additionalProperties" : "items");
  }
  const Json members = inner->value("properties", Json::object());
  const auto before = std::find_if(listed.begin(), listed.end(),
                                   [&](const auto& one) { return one.first == members; });
  const bool known = !members.empty() && before != listed.end();
  rows += fmt::format("| {} | {}{} |\n", code(key), key_meaning(schema),
                      known ? fmt::format("; keys as in {}", code(before->second)) : "");
  if (known) return;
  listed.emplace_back(members, key);
  for (const auto& member : members.items()) {
    if (member.key().ends_with("_why")) continue;
    add_key(member.value(), fmt::format("{}.{}", key, member.key()), listed, rows);
  }
}

/// The keys below `keys` ("goodness, noise"; empty: all) in the JSON of `result`; empty if one of
/// them does not exist.
std::string json_table(std::string_view result, std::string_view keys) {
  std::vector<std::pair<Json, std::string>> listed;
  std::string rows;
  for (const ResultFormat& format : result_formats()) {
    if (format.name != result) continue;
    const Json& members = format.schema.at("properties");
    std::vector<std::string> chosen = json_detail::split_names(keys);
    if (keys.empty()) {
      for (const auto& member : members.items()) chosen.push_back(member.key());
    }
    for (const std::string& key : chosen) {
      if (!members.contains(key)) return {};
      add_key(members.at(key), key, listed, rows);
    }
  }
  return rows.empty() ? rows : "| key | meaning |\n|---|---|\n" + rows;
}

/// A part that the code makes.
struct MadePart {
  std::string name;
  std::function<std::string(const Program&)> text;
};

template <class Text>
MadePart table(const char* name, const Text& text) {
  return {name, [text](const Program&) { return text(); }};
}

MadePart arguments(const std::string& function, const std::string& before) {
  return {fmt::format("arguments of {}", function),
          [=](const Program&) { return python_arguments(function, before); }};
}

const std::vector<MadePart>& parts() {
  static const std::vector<MadePart> all = {
      {"commands for data",
       [](const Program& program) {
         return commands_table(program, {"check", "init", "import", "bounce", "materials"});
       }},
      {"commands for fits",
       [](const Program& program) {
         return commands_table(program, {"fit", "diagnose", "simulate", "report", "figure",
                                         "compare", "predict", "export"});
       }},
      {"other commands",
       [](const Program& program) {
         return commands_table(program, {"pair", "plan", "coverage", "cluster", "merge", "help"});
       }},
      table("base parameters", base_parameters_table),
      table("keys of [model]", [] { return fit_keys_table("model"); }),
      table("keys of a parameter", [] { return fit_keys_table("parameter"); }),
      table("keys of [noise]",
            [] {
              return fit_keys_table("noise") + "\n" + words_table<VarianceFunction>("variance");
            }),
      table("keys of [uncertainty]",
            [] { return fit_keys_table("uncertainty") + "\n" + words_table<Scheme>("scheme"); }),
      table("keys of [diagnosis]", [] { return fit_keys_table("diagnosis"); }),
      table("mechanisms", mechanisms_table),
      table("mechanisms of the measurement",
            [] { return mechanism_details_table(Where::measurement); }),
      table("mechanisms of the surroundings",
            [] { return mechanism_details_table(Where::surroundings); }),
      table("mechanisms of the contact", [] { return mechanism_details_table(Where::contact); }),
      table("mechanisms of the adhesion", [] { return mechanism_details_table(Where::adhesion); }),
      table("units", units_table),
      table("limits", limits_table),
      arguments("fit", ""),
      arguments("model", ""),
      arguments("coverage", ""),
      arguments("pair", ""),
      arguments("diagnose", "    "),
      arguments("predict", "    ")};
  return all;
}

/// The part `name`; "JSON fit: goodness, noise" lists keys of a result. Empty if there is none.
std::string text_of_part(std::string_view name, const Program& program) {
  constexpr std::string_view json = "JSON ";
  if (name.starts_with(json)) {
    const std::size_t end = std::min(name.find(": "), name.size());
    return json_table(name.substr(json.size(), end - json.size()),
                      name.substr(std::min(end + 2, name.size())));
  }
  for (const MadePart& part : parts()) {
    if (part.name == name) return part.text(program);
  }
  return {};
}

/// Text for troff.
std::string roff(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '-' ? "\\-" : c == '\\' ? "\\e" : std::string(1, c);
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

}  // namespace

std::string man_page(const Program& program) {
  std::string out =
      ".TH RECOIL 1\n.SH NAME\nrecoil \\- fit a model of microsphere impact to measured "
      "restitution\n"
      ".SH SYNOPSIS\n.B recoil\n.I COMMAND\n[options]\n.SH COMMANDS\n";
  for (const Program::CommandText& command : program.commands()) {
    out += fmt::format(".SS recoil {}\n{}.\n", command.name, roff(capitalised(command.meaning)));
    for (const OptionRow* row : options_of(command.name)) {
      if (row->is_hidden()) continue;
      std::string value = row->is_argument() ? "" : value_words(row->type);
      std::erase(value, '`');
      out += fmt::format(".TP\n\\fB{}\\fR {}\n{}\n", roff(row->name), roff(value),
                         roff(meaning_words(*row)));
    }
  }
  return out +
         ".SH EXIT STATUS\n0 success, 2 error in the input or on the command line, 3 no usable "
         "result.\n.SH SEE ALSO\nThe manual: /usr/share/doc/recoil/README.md\n";
}

std::string bash_completion(const Program& program) {
  std::string commands, options, words;
  for (const Program::CommandText& command : program.commands()) {
    commands += (commands.empty() ? "" : " ") + command.name;
    std::string names = "--help";
    for (const OptionRow* row : options_of(command.name)) {
      if (row->is_hidden() || row->is_argument()) continue;
      names += fmt::format(" {}", row->name);
      if (row->type.words.empty() || row->type.is_number()) continue;
      words += fmt::format("    '{} {}') words='{}' ;;\n", command.name, row->name,
                           fmt::join(row->type.words, " "));
    }
    options += fmt::format("      {}) words='{}' ;;\n", command.name, names);
  }
  return fmt::format(
      R"(# Completion of recoil for bash, made by ./run docs.
_recoil() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} words=''
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{} --help --version' -- "$word"))
    return
  fi
  case "${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD-1]}}" in
    help\ *) words='{}' ;;
{}  esac
  if [ -z "$words" ] && [[ $word == -* ]]; then
    case ${{COMP_WORDS[1]}} in
{}    esac
  fi
  if [ -n "$words" ]; then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}}
complete -o filenames -F _recoil recoil
)",
      commands, commands, words, options);
}

std::string with_made_parts(const std::string& text, const std::string& file,
                            const Program& program) {
  const bool python = file.ends_with(".py");
  const std::string begin = python ? "# made by ./run docs: " : "<!-- made by ./run docs: ";
  const std::string begin_end = python ? "\n" : " -->\n";
  const std::string end = python ? "# end" : "<!-- end -->";
  std::string out;
  std::size_t at = 0;
  for (std::size_t found; (found = text.find(begin, at)) != std::string::npos;) {
    const std::size_t name_at = found + begin.size();
    const std::size_t name_end = text.find(begin_end, name_at);
    std::size_t last = text.find(end, found);
    if (name_end == std::string::npos || last == std::string::npos) {
      throw InputError({file}, "a part that the code makes has no end", "its text is replaced",
                       fmt::format("write {} after it", end));
    }
    while (text[last - 1] == ' ') --last;  // the indent of the mark
    const std::string name = text.substr(name_at, name_end - name_at);
    const std::string made = text_of_part(name, program);
    if (made.empty()) {
      std::vector<std::string> names;
      for (const MadePart& part : parts()) names.push_back(part.name);
      throw InputError({file}, fmt::format("unknown part {}", quote(name)),
                       "nothing in the code makes it", did_you_mean(name, names));
    }
    out += text.substr(at, name_end + begin_end.size() - at) + made;
    at = last;
  }
  return out + text.substr(at);
}

}  // namespace recoil
