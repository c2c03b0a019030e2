#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiment/import.hpp"

namespace recoil {

/// What a file holds, found without importing it.
struct FileLook {
  std::size_t points = 0;
  std::vector<ImportNote> notes;     ///< among them the columns that were taken by their names
  std::vector<std::string> missing;  ///< the options that `recoil import` still needs
};

/// The format of a file: the one whose needed columns it has, by their names. Columns of a film are
/// also those of a list of times, and count as a film.
/// @param request its `format` is not used
/// @throws InputError if no format fits or several do
ImportFormat format_of(const ImportRequest& request);

/// Reads the file as `request.format`, writes nothing, and needs neither materials nor sizes.
/// @throws InputError for a mistake in the file
FileLook look_at(const ImportRequest& request);

}  // namespace recoil
