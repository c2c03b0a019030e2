#pragma once

#include <functional>
#include <list>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "options/given_options.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace recoil {

/// A mistake on the command line, in one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class HelpFormatter;

/// The program with its commands, whose options are those of the table of options. Only program.cpp
/// includes the large parser CLI11.
class Program {
 public:
  using Action = std::function<void(const GivenOptions&)>;

  Program(const std::string& meaning, const std::string& footer, const std::string& version);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Adds a command. @param footer text after the list of options; it may begin on a line of its
  /// own
  void command(const std::string& name, const std::string& meaning, const std::string& footer,
               Action action);
  /// The same; words that are no options of the command become its `other_words`.
  void command_with_other_words(const std::string& name, const std::string& meaning,
                                const std::string& footer, Action action);

  /// Parses `words` and runs their command, or prints the help.
  /// @throws UsageError and the exceptions of the command
  void run(const std::vector<std::string>& words);
  /// Parses `words` without running their command. @throws UsageError
  GivenOptions parse(const std::vector<std::string>& words);

  /// A command as the manual describes it.
  struct CommandText {
    std::string name, meaning;
  };
  std::vector<CommandText> commands() const;

  /// Prints the whole meaning of every option in a help, even if it does not fit on a screen.
  void help_in_full();

 private:
  struct Entry;

  std::unique_ptr<CLI::App> app_;
  std::shared_ptr<HelpFormatter> help_;
  std::list<Entry> entries_;  // CLI11 writes into them
};

}  // namespace recoil
