#pragma once

#include <toml++/toml.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace recoil {

/// Strict reading of one TOML table: every key is asked for by name, whatever was not asked for is
/// an error that names the nearest known key, and every message carries file, line and column.
class TomlTable {
 public:
  TomlTable(const toml::table& table, std::string file, std::string name)
      : table_(table), file_(std::move(file)), name_(std::move(name)) {}

  double number(const std::string& key);
  double positive(const std::string& key);
  double not_negative(const std::string& key);
  std::optional<double> optional_positive(const std::string& key);
  std::int64_t whole(const std::string& key, std::int64_t lowest);
  std::string text(const std::string& key);
  std::optional<std::vector<std::string>> optional_texts(const std::string& key);
  std::optional<std::vector<double>> optional_numbers(const std::string& key);
  TomlTable table(const std::string& key);
  std::optional<TomlTable> optional_table(const std::string& key);
  std::vector<TomlTable> tables(const std::string& key);
  bool has(const std::string& key) const { return table_.contains(key); }
  std::vector<std::string> keys() const;

  /// @throws InputError when the table holds a key that nobody asked for.
  void finish() const;

  Location where() const;
  Location where(const std::string& key) const;
  [[noreturn]] void fail(const std::string& key, const std::string& why,
                         const std::string& suggestion) const;

 private:
  const toml::node& need(const std::string& key, const std::string& kind);
  Location locate(const toml::node& node) const;

  const toml::table& table_;
  std::string file_;
  std::string name_;
  std::set<std::string> asked_;
};

}  // namespace recoil
