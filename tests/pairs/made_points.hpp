#pragma once

#include <filesystem>
#include <vector>

#include "covering_array.hpp"

namespace pairs {

/// What a fit may have. The forms "no" and "yes" are those of columns of the points.
const std::vector<Feature>& features();

/// What recoil refuses, by a message of one line.
const std::vector<Pair>& refused_pairs();

/// What takes too long or has no meaning.
const std::vector<Pair>& pairs_left_out();

/// The plain form of every feature.
Choice plain_choice();

/// Writes the folder `data` and the file `fit.toml` of a fit with these features into `folder`.
/// Its 8 to 10 points are made by the code of tests/validation/truth, with the effect of the
/// mechanism and with a draw of every error, and are printed to six decimals.
void write_fit(const Choice& choice, const std::filesystem::path& folder);

}  // namespace pairs
