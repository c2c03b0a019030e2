#pragma once

#include <string>
#include <vector>

#include "document/document.hpp"
#include "predict/validity.hpp"

namespace recoil {

/// What the value of one check means, "the contact grows to 0.53 of the sphere's radius (100 m/s,
/// 4.9 um); Hertz' theory is good to about 0.3".
std::string validity_sentence(const Validity& validity);

/// The sentences of those that passed their limits, with the name of the dataset where there are
/// several.
std::vector<std::string> passed_limits(const std::vector<Validity>& validity,
                                       const std::vector<Dataset>& datasets);

/// All of one impact: quantity, value, limit.
Table validity_table(const std::vector<Validity>& validity);

}  // namespace recoil
