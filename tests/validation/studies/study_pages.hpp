#pragma once

#include <filesystem>

namespace recoil {

/// Writes NAME.md, and NAME.svg where there is a picture, beside the study NAME.json.
/// @throws InputError when the file is not the result of a study that has a page
void render_study(const std::filesystem::path& json);

/// Writes coverage.md and coverage.svg beside the studies coverage-*.json of `folder`.
/// @throws InputError when there is none
void write_coverage_summary(const std::filesystem::path& folder);

}  // namespace recoil
