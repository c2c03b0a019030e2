#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/units.hpp"

namespace recoil {

/// The unit in "V [cm/s]" or "V (cm/s)"; empty if there is none.
std::string unit_in_brackets(std::string_view header);

/// The places in `headers` of the columns that mean `quantity`, from the best kind of name on which
/// there is one: the name itself, the name with a unit behind it, another usual name. Blanks,
/// hyphens, underscores and case do not count in the last two. A name of up to three letters that
/// is not the quantity's own counts only with a unit of `dimension`, unless that is a ratio.
/// @param units of the columns, from a row below the header; may be empty
std::vector<std::size_t> columns_of(const std::string& quantity, Dimension dimension,
                                    const std::vector<std::string>& headers,
                                    const std::vector<std::string>& units = {});

}  // namespace recoil
