#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"

namespace recoil {

/// A constant that a dataset states and another one with the same materials does not take over.
struct LeftOverride {
  std::string key;       ///< as in datapackage.json: "stiffness_K"
  double stated = 0.0;   ///< [Pa], [J/m2] or [N/m]
  double derived = 0.0;  ///< what the materials give, in the same unit
};

/// Takes out of `system`, an object as under the key `recoil` of datapackage.json, every override
/// that contradicts its materials (see `derive_contact`): it is what one paper printed, and nothing
/// that follows from the materials. f0 is compared with eq. 12 after the others are gone, and takes
/// its `reference_diameter` [m] along. A stated 0 (no adhesion) contradicts nothing.
///
/// @param own keys that are stated anew and not taken over: they are kept, and the others compared
///   with what follows from them
///
/// A system that cannot be read is left as it is, since whoever reads it says where it is wrong.
std::vector<LeftOverride> leave_out_contradictions(Json& system,
                                                   const std::vector<std::string>& own = {});

}  // namespace recoil
