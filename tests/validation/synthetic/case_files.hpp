#pragma once

#include <filesystem>

#include "validation/synthetic/case.hpp"

namespace hidden {

/// Writes what the diagnosis may see into `folder`: the dataset NAME/ and the fit NAME.toml beside
/// it; NAME says nothing. @return the path of the fit
std::filesystem::path write_case(const Case& made, const std::filesystem::path& folder);

}  // namespace hidden
