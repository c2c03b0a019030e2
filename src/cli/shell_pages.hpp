#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/names.hpp"

/// What shells and `man` know of the program, made from the description that CLI11 parses with.
namespace recoil {

enum class Shell { bash, zsh, fish };

template <>
struct NamesOf<Shell> {
  static constexpr std::array<std::string_view, 3> names = {"bash", "zsh", "fish"};
};

/// A script that completes commands, options, and those values that are words of a list.
std::string completion_script(const CLI::App& program, Shell shell);

/// A page of `man` in roff.
struct ManPage {
  std::string name;  ///< "recoil-fit.1"
  std::string text;
};

/// recoil.1 and one page for every command.
std::vector<ManPage> man_pages(const CLI::App& program, const std::string& version);

}  // namespace recoil
