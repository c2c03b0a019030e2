#include "cli/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "data/text.hpp"

namespace recoil {
namespace {

constexpr const char* auto_or_number = "auto or INT";

std::string see_help(const std::string& near, const std::string& command) {
  return near.empty() ? fmt::format("see recoil{} --help", command)
                      : fmt::format("did you mean {}?", near);
}

/// A message about the first unknown --option of a command, with the nearest known one; empty if
/// all are known.
std::string unknown_option(const CLI::App& command, const std::vector<std::string>& words) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string word = words[i].substr(0, words[i].find('='));
    if (word.rfind("--", 0) != 0 || word == "--") continue;
    if (std::find(known.begin(), known.end(), word) != known.end()) continue;
    return fmt::format("unknown option '{}' of recoil {}; {}", word, words[0],
                       see_help(nearest_word(word, known), " " + words[0]));
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
    const std::string option = unknown_option(*command, words);
    return option.empty() ? fmt::format("{}; see recoil {} --help", message, words[0]) : option;
  }
  return fmt::format("unknown command '{}'; {}", words[0],
                     see_help(nearest_word(words[0], known), ""));
}

/// What an option accepts, "FLOAT", "`fast`, `reference`", "INT from 1 to 4096", from CLI11's name
/// of its type and checks, "INT:INT in [1 - 4096]".
std::string accepted_by(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (option.get_expected_max() == 0) return "";
  const std::size_t colon = type.find(':');
  if (colon == std::string::npos) return type;
  const std::string base = type.substr(0, colon);
  const std::string rule = type.substr(colon + 1);
  if (rule == auto_or_number) return "a whole number, or `auto`";
  if (rule.front() == '{') {
    std::string words;
    for (const std::string& word : CLI::detail::split(rule.substr(1, rule.size() - 2), ',')) {
      words += fmt::format("{}`{}`", words.empty() ? "" : ", ", word);
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

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::takes(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::shows_default() {
  option_->capture_default_str();
  return *this;
}

Option& Option::hidden() {
  option_->group("");
  return *this;
}

Option& Option::one_of(const std::vector<std::string>& words) {
  option_->check(CLI::IsMember(words));
  return *this;
}

namespace {

/// Parses a number in any locale; nullopt for other words, and for numbers out of the type's range.
template <class Number>
std::optional<Number> number_in(std::string_view word) {
  if constexpr (std::is_floating_point_v<Number>) {
    return parse_number(word);
  } else {
    Number value{};
    const char* const end = word.data() + word.size();
    const auto read = std::from_chars(word.data(), end, value);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(value) : std::nullopt;
  }
}

template <class Value>
struct NumberOf {
  using type = Value;
};
template <class Value>
struct NumberOf<std::optional<Value>> : NumberOf<Value> {};
template <class Value>
struct NumberOf<std::vector<Value>> : NumberOf<Value> {};

/// Checks that an option of numbers gets finite numbers, or whole ones.
template <class Value>
void check_numbers(CLI::Option& option) {
  using Number = typename NumberOf<Value>::type;
  if constexpr (std::is_arithmetic_v<Number>) {
    option.check(CLI::Validator(
        [](const std::string& word) -> std::string {
          if (number_in<Number>(word)) return {};
          return fmt::format(
              "{} is not {}", word,
              std::is_floating_point_v<Number> ? "a finite number" : "a whole number of this size");
        },
        ""));
  }
}

}  // namespace

Option& Option::within(double lowest, double highest, const std::string& what) {
  option_->check(CLI::Validator(
      [=](const std::string& text) -> std::string {
        const std::optional<double> value = parse_number(text);
        if (value && *value >= lowest && *value <= highest) return {};
        return fmt::format("{} is not a {} from {} to {}", text, what, lowest, highest);
      },
      fmt::format("{} in [{} - {}]", what, lowest, highest)));
  return *this;
}

Option& Option::auto_or(int lowest, int highest) {
  option_->check(CLI::Validator(
      [=](const std::string& text) -> std::string {
        const std::optional<int> value = number_in<int>(text);
        if (text == "auto" || (value && *value >= lowest && *value <= highest)) return {};
        return fmt::format("{} is not auto, and not a number from {} to {}", text, lowest, highest);
      },
      auto_or_number));
  return *this;
}

Option& Option::check(const std::function<std::string(const std::string&)>& complaint) {
  option_->check(complaint);
  return *this;
}

Option& Option::list() {
  option_->delimiter(',');
  return *this;
}

Option& Option::values(int least, int most) {
  option_->expected(least, most);
  return *this;
}

Option& Option::repeats() {
  option_->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

template <class Value>
Option Command::option(const std::string& name, Value& value, const std::string& meaning) const {
  CLI::Option* const option = app_->add_option(name, value, meaning);
  check_numbers<Value>(*option);
  return Option(option);
}
template Option Command::option(const std::string&, std::string&, const std::string&) const;
template Option Command::option(const std::string&, std::filesystem::path&,
                                const std::string&) const;
template Option Command::option(const std::string&, int&, const std::string&) const;
template Option Command::option(const std::string&, std::int64_t&, const std::string&) const;
template Option Command::option(const std::string&, std::size_t&, const std::string&) const;
template Option Command::option(const std::string&, double&, const std::string&) const;
template Option Command::option(const std::string&, std::optional<double>&,
                                const std::string&) const;
template Option Command::option(const std::string&, std::optional<std::int64_t>&,
                                const std::string&) const;
template Option Command::option(const std::string&, std::vector<std::string>&,
                                const std::string&) const;
template Option Command::option(const std::string&, std::vector<double>&, const std::string&) const;

Option Command::option(const std::string& name, const std::function<void(double)>& take,
                       const std::string& meaning) const {
  return Option(app_->add_option_function<double>(name, take, meaning));
}

Option Command::flag(const std::string& name, bool& value, const std::string& meaning) const {
  return Option(app_->add_flag(name, value, meaning));
}

void Command::runs(const std::function<void()>& action) const { app_->callback(action); }

void Command::allows_other_words() const { app_->allow_extras(); }

std::string Command::name() const { return app_->get_name(); }

std::string Command::meaning() const { return app_->get_description(); }

std::string Command::help() const { return app_->help("recoil"); }

std::vector<OptionText> Command::options() const {
  std::vector<OptionText> texts;
  for (const CLI::Option* option : app_->get_options()) {
    if (option->get_group().empty() || option->get_name() == "--help") continue;
    const bool positional = option->get_positional();
    OptionText text = {option->get_name(positional), positional ? "" : accepted_by(*option),
                       option->get_description(), option->get_required(),
                       option->get_expected_max() > 1};
    if (text.required && !positional) text.meaning += " (required)";
    if (!option->get_default_str().empty()) {
      text.meaning += fmt::format(" (default: {})", option->get_default_str());
    }
    texts.push_back(std::move(text));
  }
  return texts;
}

bool Command::given(const std::string& option) const { return app_->count(option) > 0; }

std::vector<std::string> Command::other_words() const { return app_->remaining(); }

std::vector<std::string> Command::words(const std::vector<std::string>& left_out) const {
  std::vector<std::string> words = {name()};
  std::vector<std::string> options;
  for (const CLI::Option* option : app_->get_options()) {
    if (option->count() == 0 || option->get_group().empty()) continue;
    if (std::count(left_out.begin(), left_out.end(), option->get_name()) > 0) continue;
    std::vector<std::string>& to = option->get_positional() ? words : options;
    if (!option->get_positional()) to.push_back(option->get_name());
    const bool flag = option->get_expected_max() == 0;
    if (!flag) to.insert(to.end(), option->results().begin(), option->results().end());
  }
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

Program::Program(const std::string& meaning, const std::string& footer, const std::string& version)
    : app_(std::make_unique<CLI::App>(meaning, "recoil")) {
  app_->set_version_flag("--version", "recoil " + version);
  app_->require_subcommand(1);
  app_->footer(footer);
}

Program::~Program() = default;

Command Program::command(const std::string& name, const std::string& meaning,
                         const std::string& footer) {
  CLI::App* const app = app_->add_subcommand(name, meaning);
  app->footer(footer.substr(footer.starts_with('\n') ? 1 : 0));
  return Command(app);
}

std::vector<Command> Program::commands() const {
  std::vector<Command> commands;
  for (CLI::App* app : app_->get_subcommands([](CLI::App*) { return true; })) {
    commands.emplace_back(app);
  }
  return commands;
}

void Program::run(const std::vector<std::string>& words) {
  try {
    app_->parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::Success& request) {  // --help, --version
    app_->exit(request);
  } catch (const CLI::ParseError& error) {
    throw UsageError(one_line(error, *app_, words));
  }
}

std::vector<std::string> Program::values_in(const std::vector<std::string>& words,
                                            const std::string& name) {
  for (CLI::App* command : app_->get_subcommands([](CLI::App*) { return true; })) {
    command->parse_complete_callback([] { throw CLI::Success(); });
  }
  try {
    app_->parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::Success&) {
    const std::vector<std::string> unknown = app_->remaining(true);
    if (!unknown.empty()) throw UsageError(CLI::ExtrasError("recoil", unknown).what());
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  return app_->get_subcommand(words.front())->get_option(name)->results();
}

}  // namespace recoil
