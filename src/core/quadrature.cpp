#include "core/quadrature.hpp"

#include <gsl/gsl_integration.h>

#include <memory>

namespace recoil {

std::vector<QuadratureNode> gauss_legendre(std::size_t count) {
  const std::unique_ptr<gsl_integration_glfixed_table,
                        decltype(&gsl_integration_glfixed_table_free)>
      table(gsl_integration_glfixed_table_alloc(count), &gsl_integration_glfixed_table_free);
  std::vector<QuadratureNode> nodes(count);
  for (std::size_t i = 0; i < count; ++i) {
    gsl_integration_glfixed_point(0.0, 1.0, i, &nodes[i].at, &nodes[i].weight, table.get());
  }
  return nodes;
}

}  // namespace recoil
