#include "cli/program.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "core/quoting.hpp"
#include "data/text.hpp"
#include "document/terminal.hpp"
#include "options/useless_options.hpp"

namespace recoil {

/// A command with the values of its options.
struct Program::Entry {
  std::string name, meaning;
  Action action;
  CLI::App* app = nullptr;
  std::map<const OptionRow*, std::vector<std::string>> values = {};

  GivenOptions given() const;
};

namespace {

constexpr std::size_t meanings_from = 28;  // column of the meanings in a help

/// A line that begins with a space: a command is continued behind a backslash, other words are
/// wrapped.
std::string wrapped_line(std::string line) {
  const std::string_view words = std::string_view(line).substr(line.find_first_not_of(' '));
  const std::size_t depth = line.size() - words.size();
  const bool command = words.starts_with("recoil ") || words.starts_with("--");
  std::string out;
  while (line.size() > terminal_columns) {
    const std::size_t cut = line.rfind(' ', terminal_columns - (command ? 2 : 0));
    if (cut == std::string::npos || cut <= depth + 4) break;
    out += line.substr(0, cut) + (command ? " \\\n" : "\n");
    line = std::string(depth + 4, ' ') + line.substr(cut + 1);
  }
  return out + line;
}

/// The paragraphs of `text` wrapped; lines that begin with a space stay lines.
std::string wrapped_paragraphs(const std::string& text) {
  std::string out, paragraph;
  const auto end_paragraph = [&] {
    if (!paragraph.empty()) out += wrap(paragraph, terminal_columns, 0) + '\n';
    paragraph.clear();
  };
  for (const std::string& line : lines_of(text)) {
    const bool kept = line.empty() || line.front() == ' ';
    if (kept) {
      end_paragraph();
      out += (line.empty() ? line : wrapped_line(line)) + '\n';
    } else {
      paragraph += line + ' ';
    }
  }
  end_paragraph();
  return out;
}

/// The first words of a meaning, up to what explains them, in one line.
std::string first_words(const std::string& meaning) {
  constexpr std::size_t room = terminal_columns - meanings_from;
  std::string words = meaning.substr(0, meaning.find_first_of(";:("));
  if (words.size() > room) words.resize(words.rfind(' ', room));
  words.erase(words.find_last_not_of(" ,") + 1);
  return words;
}
}  // namespace

/// Help in the width of a terminal. A command with so many options that their meanings do not fit
/// on a screen gets one line for each option.
class HelpFormatter : public CLI::Formatter {
 public:
  bool in_full = false;  ///< however long it becomes

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    constexpr std::ptrdiff_t most_lines = 46;
    brief_ = false;
    std::string text = Formatter::make_help(app, name, mode);
    if (in_full || std::ranges::count(text, '\n') <= most_lines) return text;
    brief_ = true;
    return Formatter::make_help(app, name, mode) +
           fmt::format("Examples, and all of every option: recoil help {}\n", app->get_name());
  }
  std::string make_option(const CLI::Option* option, bool positional) const override {
    std::string name = make_option_name(option, positional);
    const std::string more = make_option_opts(option);
    if (!brief_ || name.size() + more.size() + 4 < meanings_from) name += more;
    return entry(name, brief_ ? first_words(option->get_description()) : option->get_description());
  }
  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_name(), command->get_description());
  }
  std::string make_description(const CLI::App* app) const override {
    return wrapped_paragraphs(app->get_description());
  }
  std::string make_footer(const CLI::App* app) const override {
    const std::string footer = app->get_footer();  // behind an empty line: examples
    return wrapped_paragraphs(brief_ ? footer.substr(0, footer.find("\n\n")) : footer);
  }

 private:
  static std::string entry(const std::string& name, const std::string& meaning) {
    std::string out = "  " + wrap(name, terminal_columns - 2, 6);
    if (meaning.empty()) return out + '\n';
    out += out.size() < meanings_from ? std::string(meanings_from - out.size(), ' ')
                                      : '\n' + std::string(meanings_from, ' ');
    return out + wrap(meaning, terminal_columns, meanings_from) + '\n';
  }

  mutable bool brief_ = false;
};

namespace {

/// What the option `word` of another command is called here; empty if it is not known.
std::string same_elsewhere(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::array<std::string_view, 2> folder = {"--out", "--into"};  // where results go
  if (std::ranges::find(folder, word) == folder.end()) return "";
  const auto here = std::find_first_of(known.begin(), known.end(), folder.begin(), folder.end());
  return here == known.end() ? "" : *here;
}

/// A message about the first unknown --option of a command, with the nearest known one; empty if
/// all are known.
std::string unknown_option(const std::string& command, const std::vector<std::string>& words) {
  std::vector<std::string> known = {"--help"};
  for (const OptionRow* row : options_of(command)) known.emplace_back(row->name);
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string word = words[i].substr(0, words[i].find('='));
    if (!word.starts_with("--") || word == "--") continue;
    if (std::ranges::find(known, word) != known.end()) continue;
    std::string near = nearest_word(word, known);
    if (near.empty()) near = same_elsewhere(word, known);
    return fmt::format("unknown option '{}' of recoil {}; {}", word, command,
                       near.empty() ? fmt::format("see recoil {} --help", command)
                                    : fmt::format("did you mean {}?", near));
  }
  return "";
}

/// The message of CLI11 as one line, with a suggestion.
std::string one_line(const CLI::ParseError& error, const CLI::App& program,
                     const std::vector<std::string>& words) {
  if (words.empty()) return "a command is missing; recoil --help lists them";
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  if (words[0].starts_with('-')) return fmt::format("{}; see recoil --help", message);
  std::vector<std::string> known;
  for (const CLI::App* command : program.get_subcommands({})) {
    known.push_back(command->get_name());
    if (known.back() != words[0]) continue;
    // Other words of a command are options of another one.
    const std::string option =
        command->get_allow_extras() ? "" : unknown_option(command->get_name(), words);
    return option.empty() ? fmt::format("{}; see recoil {} --help", message, words[0]) : option;
  }
  const std::string near = nearest_word(words[0], known);
  return fmt::format("unknown command '{}'; {}", words[0],
                     near.empty() ? "see recoil --help" : fmt::format("did you mean {}?", near));
}

/// Adds an option of the table to a command.
void add(CLI::App& app, const OptionRow& row, std::vector<std::string>& values) {
  const OptionType& type = row.type;
  const std::string name(row.name);
  std::string meaning(row.meaning);
  if (!row.default_text().empty()) meaning = meaning_words(row);
  if (type.is_flag()) {
    app.add_flag_callback(
        name, [&values] { values.clear(); }, meaning);
    return;
  }
  CLI::Option* const option = app.add_option(name, values, meaning);
  std::string value = row.is_argument() ? "" : value_words(type);
  std::erase(value, '`');
  option->type_name(value);
  option->required(row.is_required());
  if (row.is_hidden()) option->group("");
  if (type.commas) option->delimiter(',');
  const bool repeats = type.most > 1 && !type.commas && !row.is_argument();
  if (type.most == 1 || repeats) option->allow_extra_args(false);
  if (repeats) {
    option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  } else {
    option->expected(static_cast<int>(type.least), static_cast<int>(type.most));
  }
  option->check([&type](const std::string& text) -> std::string {
    const std::string expected = expected_instead(type, text);
    return expected.empty() ? "" : fmt::format("{} is not {}", quote(text), expected);
  });
}

}  // namespace

GivenOptions Program::Entry::given() const {
  GivenOptions given(name);
  for (const auto& [row, texts] : values) {
    if (app->count(std::string(row->name)) > 0) given.set(row->name, texts);
  }
  given.other_words = app->remaining();
  return given;
}

Program::Program(const std::string& meaning, const std::string& footer, const std::string& version)
    : app_(std::make_unique<CLI::App>(meaning, "recoil")),
      help_(std::make_shared<HelpFormatter>()) {
  app_->formatter(help_);
  app_->set_version_flag("--version", "recoil " + version);
  app_->require_subcommand(1);
  app_->footer(footer);
}

Program::~Program() = default;

void Program::help_in_full() { help_->in_full = true; }

void Program::command(const std::string& name, const std::string& meaning,
                      const std::string& footer, Action action) {
  CLI::App* const app = app_->add_subcommand(name, meaning);
  app->footer(footer.substr(footer.starts_with('\n') ? 1 : 0));
  entries_.push_back({name, meaning, std::move(action), app});
  for (const OptionRow* row : options_of(name)) add(*app, *row, entries_.back().values[row]);
}

void Program::command_with_other_words(const std::string& name, const std::string& meaning,
                                       const std::string& footer, Action action) {
  command(name, meaning, footer, std::move(action));
  entries_.back().app->allow_extras();
}

GivenOptions Program::parse(const std::vector<std::string>& words) {
  try {
    app_->parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::Success&) {  // --help, --version
    throw;
  } catch (const CLI::ParseError& error) {
    throw UsageError(one_line(error, *app_, words));
  }
  const auto parsed =
      std::ranges::find_if(entries_, [](const Entry& entry) { return entry.app->parsed(); });
  return parsed->given();
}

void Program::run(const std::vector<std::string>& words) {
  try {
    const GivenOptions given = parse(words);
    refuse_useless_options(given);
    std::ranges::find(entries_, given.command(), &Entry::name)->action(given);
  } catch (const CLI::Success& request) {
    app_->exit(request);
  }
}

std::vector<Program::CommandText> Program::commands() const {
  std::vector<CommandText> texts;
  for (const Entry& entry : entries_) texts.push_back({entry.name, entry.meaning});
  return texts;
}

}  // namespace recoil
