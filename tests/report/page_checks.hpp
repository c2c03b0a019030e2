#pragma once

#include <string>

namespace recoil {

/// Fails unless `html` is one page that needs nothing else: under 1 MB, every id once, links that
/// lead somewhere, no script but its own, no network.
void expect_self_contained(const std::string& html);

}  // namespace recoil
