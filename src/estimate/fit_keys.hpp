#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace recoil {

/// A key of a fit file, as a reader of the manual needs it.
struct FitKey {
  std::string_view table;  ///< "noise"; empty for those above all tables
  std::string_view name;   ///< "variance"
  std::string standard;    ///< its default as the file would write it; empty where it needs one
  std::string_view meaning;
};

/// Every key of a fit file; `parameter` is the table of any single parameter. What stands here is
/// what a fit file may have: its reader asks for no other.
const std::vector<FitKey>& fit_keys();

/// The names of one table, in order.
std::vector<std::string> fit_keys_of(std::string_view table);

}  // namespace recoil
