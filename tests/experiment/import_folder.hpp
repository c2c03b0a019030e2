#pragma once

#include <filesystem>
#include <string>

#include "experiment/import.hpp"

/// A folder to import into, and a request that lacks nothing.
namespace import_folder {

class Place {
 public:
  Place();
  ~Place();
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  const std::filesystem::path& folder() const { return folder_; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  bool has(const std::string& name) const;

  /// `text` as input.csv into the dataset `made`, polystyrene of 2 um on silicon.
  recoil::ImportRequest request(const std::string& text, recoil::ImportFormat format) const;

 private:
  std::filesystem::path folder_;
};

/// What an import throws; "no complaint" when it throws nothing.
std::string complaint(const recoil::ImportRequest& request);

}  // namespace import_folder
