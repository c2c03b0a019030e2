#pragma once

#include <filesystem>
#include <string>

#include "experiment/import.hpp"
#include "support/temporary_folder.hpp"

/// A folder to import into, and a request that lacks nothing.
namespace import_folder {

class Place : public support::TemporaryFolder {
 public:
  const std::filesystem::path& folder() const { return path(); }

  /// `text` as input.csv into the dataset `made`, polystyrene of 2 um on silicon, in vacuum.
  recoil::ImportRequest request(const std::string& text, recoil::ImportFormat format) const;
};

/// What an import throws; "no error" when it throws nothing.
std::string complaint(const recoil::ImportRequest& request);

}  // namespace import_folder
