#pragma once

#include <string>

namespace recoil {

/// Fails unless `html` is a self-contained page: under 1 MB, unique ids, links with targets, no
/// foreign script, no network access.
void expect_self_contained(const std::string& html);

}  // namespace recoil
