#pragma once

#include <optional>
#include <string>
#include <vector>

#include "data/system.hpp"

namespace recoil {

/// A capture velocity that is published as a number. No uncertainty is given in what could be read.
struct PublishedCapture {
  std::string particle;   ///< material
  std::string surface;    ///< material
  double diameter = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
  bool measured = false;  ///< false: the result of a model
  std::string what;       ///< "JKR", "elastoplastic model", "measured", ...
  std::string source;
};

/// All that are known to this program.
const std::vector<PublishedCapture>& published_captures();

/// Those of a particle and a surface of these materials, by the names that a dataset gives them
/// ("316 stainless steel" is stainless steel, "silicon [100]" silicon).
std::vector<PublishedCapture> published_captures_for(const Material& particle,
                                                     const Material& surface);

/// A published yield pressure p_Y [Pa] of a material, with where it stands.
struct PublishedYield {
  double pressure = 0.0;  ///< [Pa]
  std::string source;
};
std::optional<PublishedYield> published_yield_pressure(const Material& particle);

}  // namespace recoil
