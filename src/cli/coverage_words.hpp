#pragma once

#include <string>

#include "coverage/coverage.hpp"

namespace recoil {

/// The coverage of one fit as a Markdown table with a sentence on what was done.
std::string coverage_markdown(const CoverageResult& result, const FitSpec& spec,
                              const CoverageOptions& options);

}  // namespace recoil
