#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// The command line: commands with options that write into variables. Only options.cpp includes the
/// large parser CLI11.
namespace recoil {

/// A mistake on the command line, in one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One option of a command. Each member adds a property and returns the option.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  /// Sets the name of its value in the help: "DIR".
  Option& takes(const std::string& name);
  /// Shows the present value of the variable as the default in the help.
  Option& shows_default();
  /// Omits it from help and manual.
  Option& hidden();
  /// Accepts one of these words.
  Option& one_of(const std::vector<std::string>& words);
  /// Accepts a number in [lowest, highest], but not NaN. @param what for messages: "velocity"
  Option& within(double lowest, double highest, const std::string& what = "number");
  /// Accepts "auto", or a whole number in [lowest, highest].
  Option& auto_or(int lowest, int highest);
  /// Accepts texts for which `complaint` returns an empty text. It may throw InputError.
  Option& check(const std::function<std::string(const std::string&)>& complaint);
  /// Accepts several values in one word, separated by commas.
  Option& list();
  /// Accepts `least` to `most` values.
  Option& values(int least, int most);
  /// May be given several times, with one value each.
  Option& repeats();
  /// Requires or excludes `other`.
  Option& needs(const Option& other);
  Option& excludes(const Option& other);

 private:
  CLI::Option* option_;
};

/// The description of an option in the manual.
struct OptionText {
  std::string name;     ///< "--out", or "FIT" without dashes
  std::string takes;    ///< "INT from 1 to 4096"; empty for a flag
  std::string meaning;  ///< including "(required)" and the default
  bool required = false;
  bool several = false;  ///< takes more than one value
};

/// One command of the program.
class Command {
 public:
  explicit Command(CLI::App* app) : app_(app) {}

  /// Adds an option ("--out") or a positional argument ("FIT") whose value is written into `value`:
  /// a text, path, number, std::optional of a number, or vector of texts or numbers. The variable
  /// has to outlive the parsing.
  template <class Value>
  Option option(const std::string& name, Value& value, const std::string& meaning) const;
  /// Adds an option with a number, which is passed to `take`.
  Option option(const std::string& name, const std::function<void(double)>& take,
                const std::string& meaning) const;
  Option flag(const std::string& name, bool& value, const std::string& meaning) const;

  /// Sets the action of the command, which is called after parsing.
  void runs(const std::function<void()>& action) const;
  /// Keeps words that are no options for `other_words`.
  void allows_other_words() const;

  std::string name() const;
  std::string meaning() const;
  std::string help() const;
  std::vector<OptionText> options() const;
  bool given(const std::string& option) const;
  std::vector<std::string> other_words() const;
  /// The words of the command line, in the order of the help, without hidden options and the
  /// options `left_out`.
  std::vector<std::string> words(const std::vector<std::string>& left_out) const;

 private:
  CLI::App* app_;
};

/// The program with its commands.
class Program {
 public:
  Program(const std::string& meaning, const std::string& footer, const std::string& version);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// @param footer text after the list of options; it may begin on a line of its own
  Command command(const std::string& name, const std::string& meaning, const std::string& footer);
  std::vector<Command> commands() const;

  /// Parses `words` and runs their command, or prints the help.
  /// @throws UsageError and the exceptions of the command
  void run(const std::vector<std::string>& words);

  /// Parses `words` without running the command.
  /// @return the values of its option `name`
  /// @throws UsageError
  std::vector<std::string> values_in(const std::vector<std::string>& words,
                                     const std::string& name);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace recoil
