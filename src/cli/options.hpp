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

/// The command line: commands with options that write into variables. Only
/// options.cpp includes the parser (CLI11), which is large.
namespace recoil {

/// A mistake on the command line, in one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One option of a command. Its members describe it further and return it.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  /// The name of its value in the help: "DIR".
  Option& takes(const std::string& name);
  /// The help states the value that the variable has now as the default.
  Option& shows_default();
  /// Neither the help nor the manual mentions it.
  Option& hidden();
  /// One word of a list.
  Option& one_of(const std::vector<std::string>& words);
  /// A number in [lowest, highest]; NaN is refused. @param what it is, for messages: "velocity"
  Option& within(double lowest, double highest, const std::string& what = "number");
  /// "auto", or a whole number in [lowest, highest].
  Option& auto_or(int lowest, int highest);
  /// Texts without a complaint, which is empty for a good one. It may throw
  /// InputError.
  Option& check(const std::function<std::string(const std::string&)>& complaint);
  /// Several values in one word, separated by commas.
  Option& list();
  /// A fixed number of values.
  Option& values(int least, int most);
  /// One value each time that it is given.
  Option& repeats();
  /// Only together with `other`, or never.
  Option& needs(const Option& other);
  Option& excludes(const Option& other);

 private:
  CLI::Option* option_;
};

/// An option as the manual describes it.
struct OptionText {
  std::string name;     ///< "--out", or "FIT" without dashes
  std::string takes;    ///< "INT from 1 to 4096"; empty for a flag
  std::string meaning;  ///< with "(required)" and the default
  bool required = false;
  bool several = false;  ///< takes more than one value
};

/// One command of the program.
class Command {
 public:
  explicit Command(CLI::App* app) : app_(app) {}

  /// An option ("--out") or an argument by its place ("FIT") whose value is
  /// written into `value`, a text, path, number, std::optional of a number, or
  /// vector of texts or numbers. The variable has to outlive the parsing.
  template <class Value>
  Option option(const std::string& name, Value& value, const std::string& meaning) const;
  /// An option with a number, passed to `take`.
  Option option(const std::string& name, const std::function<void(double)>& take,
                const std::string& meaning) const;
  Option flag(const std::string& name, bool& value, const std::string& meaning) const;

  /// Called once the command line was read.
  void runs(const std::function<void()>& action) const;
  /// Words that are no options are kept for `other_words`.
  void allows_other_words() const;

  std::string name() const;
  std::string meaning() const;
  std::string help() const;
  std::vector<OptionText> options() const;
  bool given(const std::string& option) const;
  std::vector<std::string> other_words() const;
  /// The words of the command line, in the order of the help, without hidden
  /// options and those of `left_out`.
  std::vector<std::string> words(const std::vector<std::string>& left_out) const;

 private:
  CLI::App* app_;
};

/// The program: its commands, one of which is run.
class Program {
 public:
  Program(const std::string& meaning, const std::string& footer, const std::string& version);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// @param footer text after the list of options; it may begin on a line of its own
  Command command(const std::string& name, const std::string& meaning, const std::string& footer);
  std::vector<Command> commands() const;

  /// Runs the command in `words`, or prints the help.
  /// @throws UsageError and the exceptions of the command
  void run(const std::vector<std::string>& words);

  /// Reads `words` without running the command.
  /// @return the values of its option `name`
  /// @throws UsageError
  std::vector<std::string> values_in(const std::vector<std::string>& words,
                                     const std::string& name);

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace recoil
