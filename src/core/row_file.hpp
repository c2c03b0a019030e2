#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"

namespace recoil {

/// A file of what came of numbered pieces of work: its first line is a head, an object, to which
/// are added "rows", how many follow, and their "bytes" and "sha256"; every further line is one
/// row, [number of the piece, ...]. Written whole or not at all.
/// @throws InputError when the place cannot be written
void write_rows(const std::filesystem::path& file, Json head, const std::vector<Json>& rows);

/// The head alone, without reading further; none for a file that is missing, cut short or of
/// another kind.
std::optional<Json> read_row_head(const std::filesystem::path& file);

/// Are its rows, which are all read, those that were written?
bool is_unaltered(const std::filesystem::path& file);

/// Hands every row on, in order, and none of a file that was altered. @return whether that was all:
/// `take` may refuse a row by false.
bool read_rows(const std::filesystem::path& file, const std::function<bool(const Json& row)>& take);

}  // namespace recoil
