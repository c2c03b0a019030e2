#pragma once

#include <string>

#include "coverage/coverage.hpp"

namespace recoil {

/// The result of `recoil coverage` as JSON.
std::string coverage_json(const CoverageResult& result, const FitSpec& spec,
                          const CoverageOptions& options, const std::vector<Dataset>& datasets);

}  // namespace recoil
