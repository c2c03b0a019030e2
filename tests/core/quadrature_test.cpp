#include <gtest/gtest.h>

#include <cmath>

#include "core/numerics.hpp"

namespace recoil {
namespace {

TEST(GaussLegendre, IsExactForPolynomialsOfTwiceItsOrder) {
  const std::vector<QuadratureNode> nodes = gauss_legendre(12);
  for (int degree = 0; degree <= 23; ++degree) {
    double sum = 0.0;
    for (const QuadratureNode& node : nodes) sum += node.weight * std::pow(node.at, degree);
    EXPECT_NEAR(sum, 1.0 / (degree + 1), 1e-15) << degree;
  }
  for (std::size_t i = 1; i < nodes.size(); ++i) EXPECT_LT(nodes[i - 1].at, nodes[i].at);
}

}  // namespace
}  // namespace recoil
