#pragma once

#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace pairs {

/// A fit of one kind: its folder holds `fit.toml`, and a dataset `data` or several.
struct MadeFit {
  std::string name;
  std::vector<std::string> datasets = {"data"};  ///< folders
  double diameter = 4.9e-6;                      ///< of a sphere of the fit [m]
  double velocity = 5.0;                         ///< within the range of the points [m/s]
  bool quick = true;                             ///< false: a fit takes minutes
};

/// Every kind of fit, each in a folder of its name below `place`.
std::vector<MadeFit> write_made_fits(const support::TemporaryFolder& place);

}  // namespace pairs
