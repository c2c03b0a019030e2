#pragma once

#include "data/toml_reader.hpp"
#include "estimate/noise_spec.hpp"

namespace recoil {

/// Reads the `[noise]` table of a fit file. @throws InputError with file, line and column.
NoiseSpec read_noise_spec(const TomlReader& reader, const toml::table& table);

}  // namespace recoil
