#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "document/document.hpp"

namespace recoil::paper {

/// What recoil gives for one statement of the paper.
struct Finding {
  std::optional<double> value;  ///< of a number, in the unit of the statement
  bool holds = false;           ///< of a claim
  Sentence words;               ///< of a claim: the numbers that decide
};

/// What recoil gives for one table or figure of the paper.
struct PartResult {
  Sentence gain;   ///< in a few words, what the fit to all points adds
  Sentence words;  ///< the same with its numbers
  Blocks blocks;   ///< recoil's own pictures, in the quantities of the paper's axes, and tables
};

/// What recoil gives for the whole paper.
struct Comparison {
  std::map<std::string, Finding, std::less<>> findings;  ///< by Statement::id
  std::map<std::string, PartResult, std::less<>> parts;  ///< by Part::id
  bool is_reconstruction = true;  ///< no dataset has points that were imported since
};

/// Fits the reconstructions of the paper's data and makes the events, impacts and averages that its
/// figures show. The parameters come from the fit to all points and from the paper's calibration by
/// two points; the constants of Table 1 come from E and nu of the materials.
/// @param root folder with `fits` and `datasets`
Comparison compare_with_paper(const std::filesystem::path& root);

}  // namespace recoil::paper
