#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "data/toml_reader.hpp"

namespace recoil {

/// Strict reading of one TOML table key by key: whatever was not asked for is an error that names
/// the nearest key that was. It points into the table, which has to live longer.
class TomlTable {
 public:
  /// @param name as messages call the table: "the recipe", "[noise]"
  TomlTable(const toml::table& table, const TomlReader& reader, std::string name)
      : table_(table), reader_(reader), name_(std::move(name)) {}

  double number(const std::string& key);
  double positive(const std::string& key);
  double not_negative(const std::string& key);
  std::optional<double> optional_positive(const std::string& key);
  std::int64_t whole(const std::string& key, std::int64_t lowest);
  std::string text(const std::string& key);
  std::optional<std::vector<std::string>> optional_texts(const std::string& key);
  std::optional<std::vector<double>> optional_positives(const std::string& key);
  TomlTable table(const std::string& key);
  std::optional<TomlTable> optional_table(const std::string& key);
  std::vector<TomlTable> tables(const std::string& key);
  bool has(const std::string& key) const { return table_.contains(key); }
  std::vector<std::string> keys() const;

  /// @throws InputError when the table holds a key that nobody asked for.
  void finish() const;

  Location where() const;
  Location where(const std::string& key) const;
  /// At the value of `key`, or at the table when there is none.
  [[noreturn]] void fail(const std::string& key, const std::string& problem, const std::string& why,
                         const std::string& suggestion) const;

 private:
  const toml::node& need(const std::string& key, const std::string& kind);

  const toml::table& table_;
  TomlReader reader_;
  std::string name_;
  std::set<std::string> asked_;
};

}  // namespace recoil
