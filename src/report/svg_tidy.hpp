#pragma once

#include <string>

namespace recoil {

/// Makes what gnuplot drew small and fit to stand beside others in one page: ids that begin with
/// `name`, colours and coordinates in few characters, dots packed into paths, no points within
/// a horizontal, nothing repeated that can be said once. Nobody sees a difference.
void tidy_svg(std::string& svg, const std::string& name);

}  // namespace recoil
