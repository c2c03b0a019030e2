#include "cli/shell_pages.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace recoil {
namespace {

/// The words that an option takes, if it takes one of a list.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find(":{");
  const std::size_t close = type.find('}', open == std::string::npos ? 0 : open);
  if (open == std::string::npos || close == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 2, close - open - 2), ',');
}

/// "FILE" of "FILE:rule".
std::string plain_type(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

struct KnownOption {
  std::string name;  // without dashes
  std::string meaning;
  bool takes_value = false;
  std::vector<std::string> choices;
};

struct KnownCommand {
  std::string name, meaning;
  std::vector<KnownOption> options;
};

std::vector<const CLI::Option*> shown_options(const CLI::App& command, bool positional) {
  std::vector<const CLI::Option*> shown;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_group().empty() || option->get_positional() != positional) continue;
    shown.push_back(option);
  }
  return shown;
}

std::vector<KnownCommand> known_commands(const CLI::App& program) {
  std::vector<KnownCommand> commands;
  for (const CLI::App* command : program.get_subcommands({})) {
    KnownCommand known = {command->get_name(), command->get_description(), {}};
    for (const CLI::Option* option : shown_options(*command, false)) {
      for (const std::string& name : option->get_lnames()) {
        known.options.push_back(
            {name, option->get_description(), option->get_expected_max() > 0, choices_of(*option)});
      }
    }
    commands.push_back(std::move(known));
  }
  return commands;
}

std::string names_of(const std::vector<KnownCommand>& commands) {
  std::vector<std::string> names;
  for (const KnownCommand& command : commands) names.push_back(command.name);
  return fmt::format("{}", fmt::join(names, " "));
}

std::string bash_script(const std::vector<KnownCommand>& commands) {
  std::string values;
  std::string options;
  for (const KnownCommand& command : commands) {
    std::vector<std::string> names;
    for (const KnownOption& option : command.options) {
      names.push_back("--" + option.name);
      if (option.choices.empty()) continue;
      values += fmt::format("    {}:--{}) words='{}' ;;\n", command.name, option.name,
                            fmt::join(option.choices, " "));
    }
    options += fmt::format("    {}) words='{}' ;;\n", command.name, fmt::join(names, " "));
  }
  return fmt::format(R"bash(# bash completion of recoil, made by recoil help --completion bash
_recoil() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=''
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W '{} --help --version' -- "$current")
    return
  fi
  case "${{COMP_WORDS[1]}}:$before" in
{}  esac
  if [ -z "$words" ] && [[ $current == -* ]]; then
    case "${{COMP_WORDS[1]}}" in
{}    esac
  fi
  if [ -n "$words" ]; then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  else
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}}
complete -F _recoil recoil
)bash",
                     names_of(commands), values, options);
}

/// Within single quotes of zsh's _arguments: no quote, bracket or colon means anything.
std::string zsh_words(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'') {
      out += "'\\''";
    } else if (c == '[' || c == ']' || c == ':') {
      out += '\\';
      out += c;
    } else {
      out += c == '\n' ? ' ' : c;
    }
  }
  return out;
}

std::string zsh_script(const std::vector<KnownCommand>& commands) {
  std::string list;
  std::string cases;
  for (const KnownCommand& command : commands) {
    list += fmt::format("    '{}:{}'\n", command.name, zsh_words(command.meaning));
    cases += fmt::format("    {}) _arguments \\\n", command.name);
    for (const KnownOption& option : command.options) {
      std::string value;
      if (!option.choices.empty()) {
        value = fmt::format(":value:({})", fmt::join(option.choices, " "));
      } else if (option.takes_value) {
        value = ":value:_files";
      }
      cases +=
          fmt::format("      '--{}[{}]{}' \\\n", option.name, zsh_words(option.meaning), value);
    }
    cases += "      '*:file:_files' ;;\n";
  }
  return fmt::format(R"zsh(#compdef recoil
# zsh completion of recoil, made by recoil help --completion zsh
_recoil() {{
  local -a commands
  commands=(
{}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
{}  esac
}}
_recoil "$@"
)zsh",
                     list, cases);
}

std::string fish_words(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out;
}

std::string fish_script(const std::vector<KnownCommand>& commands) {
  std::string out = "# fish completion of recoil, made by recoil help --completion fish\n";
  for (const KnownCommand& command : commands) {
    out += fmt::format("complete -c recoil -n __fish_use_subcommand -f -a {} -d '{}'\n",
                       command.name, fish_words(command.meaning));
    for (const KnownOption& option : command.options) {
      out += fmt::format("complete -c recoil -n '__fish_seen_subcommand_from {}' -l {}",
                         command.name, option.name);
      if (!option.choices.empty()) {
        out += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
      } else if (option.takes_value) {
        out += " -r";
      }
      out += fmt::format(" -d '{}'\n", fish_words(option.meaning));
    }
  }
  return out;
}

/// Text as roff shows it: no line is a request, no character an escape.
std::string roff(const std::string& text) {
  std::string out;
  bool first = true;
  for (const char c : text) {
    if (first && (c == '.' || c == '\'')) out += "\\&";
    first = c == '\n';
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out;
}

/// The footer's words, with its indented lines as examples.
std::string roff_footer(const std::string& footer) {
  std::string out;
  bool example = false;
  for (const std::string& line : CLI::detail::split(footer, '\n')) {
    const bool indented = line.rfind("  ", 0) == 0;
    if (indented && !example) out += ".PP\n.nf\n";
    if (!indented && example) out += ".fi\n.PP\n";
    example = indented;
    if (!line.empty()) out += roff(line) + "\n";
  }
  return example ? out + ".fi\n" : out;
}

std::string option_entry(const CLI::Option& option, bool positional) {
  const std::vector<std::string> choices = choices_of(option);
  std::string values;
  if (option.get_expected_max() > 0 && !positional) {
    values = choices.empty() ? plain_type(option) : fmt::format("{}", fmt::join(choices, "|"));
  }
  std::string remarks = option.get_description();
  if (option.get_required() && !positional) remarks += " (required)";
  if (!option.get_default_str().empty()) {
    remarks += fmt::format(" (default: {})", option.get_default_str());
  }
  return fmt::format(".TP\n\\fB{}\\fR {}\n{}\n", roff(option.get_name(positional)), roff(values),
                     roff(remarks));
}

std::string command_page(const CLI::App& command, const std::string& version) {
  const std::string name = "recoil-" + command.get_name();
  std::string synopsis = fmt::format("\\fBrecoil {}\\fR", roff(command.get_name()));
  std::string entries;
  for (const CLI::Option* option : shown_options(command, true)) {
    const std::string word = roff(option->get_name(true));
    synopsis += option->get_required() ? " " + word : " [" + word + "]";
    entries += option_entry(*option, true);
  }
  for (const CLI::Option* option : shown_options(command, false)) {
    entries += option_entry(*option, false);
  }
  return fmt::format(
      ".TH {} 1 \"\" \"recoil {}\" \"recoil\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n{} "
      "[\\fIoptions\\fR]\n.SH OPTIONS\n{}.SH DESCRIPTION\n{}.SH SEE ALSO\n\\fBrecoil\\fR(1); "
      "\\fBrecoil help\\fR lists the pages of the manual.\n",
      roff(name), version, roff(name), roff(command.get_description()), synopsis, entries,
      roff_footer(command.get_footer()));
}

}  // namespace

std::string completion_script(const CLI::App& program, Shell shell) {
  const std::vector<KnownCommand> commands = known_commands(program);
  switch (shell) {
    case Shell::bash:
      return bash_script(commands);
    case Shell::zsh:
      return zsh_script(commands);
    case Shell::fish:
      break;
  }
  return fish_script(commands);
}

std::vector<ManPage> man_pages(const CLI::App& program, const std::string& version) {
  std::vector<ManPage> pages;
  std::string list;
  for (const CLI::App* command : program.get_subcommands({})) {
    list += fmt::format(".TP\n\\fBrecoil {}\\fR\n{}\n", roff(command->get_name()),
                        roff(command->get_description()));
    pages.push_back(
        {fmt::format("recoil-{}.1", command->get_name()), command_page(*command, version)});
  }
  pages.insert(
      pages.begin(),
      {"recoil.1",
       fmt::format(".TH recoil 1 \"\" \"recoil {}\" \"recoil\"\n.SH NAME\nrecoil \\- impact "
                   "of microspheres with surfaces: estimation and uncertainty\n.SH "
                   "SYNOPSIS\n\\fBrecoil\\fR \\fICOMMAND\\fR [\\fIoptions\\fR]\n.SH "
                   "COMMANDS\n{}.SH DESCRIPTION\n{}\n{}",
                   version, list, roff(program.get_description()),
                   roff_footer(program.get_footer()))});
  return pages;
}

}  // namespace recoil
