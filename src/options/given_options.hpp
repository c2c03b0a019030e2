#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/option_table.hpp"

namespace recoil {

/// The options that a person gave to one command, by their names in the table of options. Reading
/// an option that the table does not have is a defect of the program (std::logic_error).
class GivenOptions {
 public:
  /// @param command of the table
  explicit GivenOptions(std::string command) : command_(std::move(command)) {}

  /// The keyword arguments of a function of Python as texts by their names in Python.
  /// @throws InputError for a value that its option does not accept
  static GivenOptions of_python(const std::string& function,
                                const std::map<std::string, std::vector<std::string>>& arguments);

  const std::string& command() const { return command_; }
  /// Sets the values of an option; a flag has none. @pre `expected_instead` finds nothing wrong
  void set(std::string_view name, std::vector<std::string> values);

  /// Is it an option of this command?
  bool takes(std::string_view name) const { return find_row(name) != nullptr; }
  /// Was it given?
  bool has(std::string_view name) const;
  /// The value, or the default; empty if there is neither.
  std::string text(std::string_view name) const;
  /// All values; empty if the option was not given.
  std::vector<std::string> texts(std::string_view name) const;
  /// NAME=VALUE pairs. @throws InputError for a name that is given twice
  std::map<std::string, std::string> assignments(std::string_view name) const;

  /// Values in SI, or the default. @pre the option has a default or was given
  double number(std::string_view name) const;
  std::int64_t whole(std::string_view name) const;
  /// Values in SI; nullopt if there is no default, either.
  std::optional<double> number_if_any(std::string_view name) const;
  std::optional<std::int64_t> whole_if_any(std::string_view name) const;
  std::vector<double> numbers(std::string_view name) const;

  /// The name of an option in messages: "--height", or "height" in Python.
  std::string_view name_of(std::string_view name) const;

  /// The command with its options, in the order of the table, without those in `left_out`.
  std::vector<std::string> words(const std::vector<std::string_view>& left_out) const;

  /// Words behind the options of a command that takes another one.
  std::vector<std::string> other_words;

 private:
  const OptionRow* find_row(std::string_view name) const;
  const OptionRow& row(std::string_view name) const;

  std::string command_;
  bool python_ = false;
  std::map<std::string, std::vector<std::string>, std::less<>> values_;
};

}  // namespace recoil
