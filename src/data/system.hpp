#pragma once

#include "data/dataset.hpp"
#include "data/json_document.hpp"

namespace recoil {

/// The `provenance` of the object under the key `recoil`.
/// @throws InputError at the value, or when there is none.
Provenance read_provenance(const JsonNode& recoil);

/// The two materials, the overrides and the conditions of the object under the key `recoil`, which
/// is refused when it has keys that are not known.
/// @throws InputError at the key or value that is missing or physically impossible.
ImpactSystem read_system(const JsonNode& recoil);

}  // namespace recoil
