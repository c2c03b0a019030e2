#pragma once

#include <cstddef>
#include <vector>

namespace recoil {

struct QuadratureNode {
  double at = 0.0;
  double weight = 0.0;
};

/// Points and weights of the Gauss-Legendre rule with `count` nodes on [0, 1], ascending (GSL's
/// table): exact for polynomials up to degree 2 count - 1.
std::vector<QuadratureNode> gauss_legendre(std::size_t count);

}  // namespace recoil
