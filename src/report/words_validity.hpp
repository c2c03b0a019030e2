#pragma once

#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "document/document.hpp"
#include "predict/validity.hpp"

/// The limits of the model, in words and as a table.
namespace recoil {

/// One check of the limits of the model: "the contact grows to 0.53 of the sphere's radius (100
/// m/s, 4.9 um); Hertz' theory holds up to about 0.3".
std::string validity_sentence(const Validity& validity);

/// For each exceeded limit of the model, a sentence about the impact that exceeds it most.
std::vector<std::string> exceeded_limits(const std::vector<Validity>& validity,
                                         const std::vector<Dataset>& datasets);

/// The checks of one impact: quantity, value and limit.
Table validity_table(const std::vector<Validity>& validity);

}  // namespace recoil
