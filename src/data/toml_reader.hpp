#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/names.hpp"

namespace recoil {

/// Reads values of a TOML file. Every mistake throws an InputError with file, line and column.
class TomlReader {
 public:
  explicit TomlReader(std::string file) : file_(std::move(file)) {}

  const std::string& file() const { return file_; }
  Location at(const toml::source_region& region) const;

  /// Parses the file. @throws InputError if `text` is not TOML, not UTF-8 or nested too deeply
  toml::table parse(const std::string& text) const;

  [[noreturn]] void fail(const toml::node& node, const std::string& problem, const std::string& why,
                         const std::string& suggestion) const;
  [[noreturn]] void wrong_type(const toml::node& node, const std::string& name,
                               const std::string& wanted, const std::string& example) const;

  /// Refuses keys of `table` (called `name` in the message) that are not in `known`.
  void allow_only(const toml::table& table, const std::string& name,
                  const std::vector<std::string>& known) const;

  /// The table `name` of `parent`; null if there is none.
  const toml::table* table(const toml::table& parent, const std::string& name) const;
  const toml::table& table(const toml::node& node, const std::string& name) const;
  const toml::array& array(const toml::node& node, const std::string& name,
                           const std::string& example) const;
  std::string string(const toml::node& node, const std::string& name,
                     const std::string& example) const;
  double number(const toml::node& node, const std::string& name) const;  ///< finite
  std::int64_t integer(const toml::node& node, const std::string& name) const;
  bool boolean(const toml::node& node, const std::string& name) const;

  /// A number from `lower` to `upper`; `suggestion` is that of the message about another one.
  double number_in(const toml::node& node, const std::string& name, double lower, double upper,
                   const std::string& suggestion) const;
  /// One of the words `known`; the message about another one calls it a `what`.
  std::string one_of(const toml::node& node, const std::string& name, const std::string& what,
                     const std::vector<std::string>& known) const;
  /// The value of an enumeration with that name.
  template <class Enum>
  Enum one_of(const toml::node& node, const std::string& name, const std::string& what) const {
    return *value_named<Enum>(one_of(node, name, what, all_names<Enum>()));
  }

 private:
  std::string file_;
};

}  // namespace recoil
