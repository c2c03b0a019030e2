#pragma once

#include <string>

#include "report/report.hpp"

namespace recoil {

/// All points and fitted curves of e(V), of one dataset with their bands, in one small picture;
/// `id` is part of its name.
plot::Picture restitution_overview(const Analysis& analysis, const std::string& id);

}  // namespace recoil
