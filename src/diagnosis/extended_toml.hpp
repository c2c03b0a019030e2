#pragma once

#include <filesystem>
#include <string>

#include "diagnosis/diagnosis_result.hpp"

namespace recoil {

/// The fit file of a diagnosis with the extended model, as a text that `parse_fit` reads: the same
/// datasets (seen from `folder`), noise and uncertainty, the mechanisms that were found, every
/// parameter starting at its estimate. Without a cause it is the fit file as it was.
std::string extended_toml(const Diagnosis& diagnosis, const std::filesystem::path& folder);

}  // namespace recoil
