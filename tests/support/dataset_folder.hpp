#pragma once

#include <optional>
#include <string>

#include "support/mistake.hpp"
#include "support/temporary_folder.hpp"

/// A valid dataset to begin with, and a folder to write it to.
namespace example {

/// `datapackage.json` with all columns but rebound_velocity, over 27 lines.
extern const std::string package;
/// Four points of two series below a header.
extern const std::string points;

/// A folder of its own with a dataset in it.
class DatasetFolder : public support::TemporaryFolder {
 public:
  explicit DatasetFolder(const std::string& package_text = package,
                         const std::string& points_text = points);

  /// The error with which loading fails, if it fails.
  std::optional<recoil::InputError> error() const;
  /// Loading fails with `mistake`, whose place is seen from this folder.
  void expect(const support::Mistake& mistake) const;
};

}  // namespace example
