#include "diagnosis/moving_columns.hpp"

namespace recoil {

std::optional<MovingColumns> moving_columns(const Refit& refit) {
  const std::size_t slots = refit.theta.size();
  MovingColumns found;
  for (std::size_t j = 0; j < slots; ++j) {
    if (refit.moving[j]) found.slots.push_back(j);
  }
  if (found.slots.empty()) return std::nullopt;
  const std::size_t rows = refit.jacobian.size() / slots;
  found.unit.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(found.slots.size()));
  for (Eigen::Index j = 0; j < found.unit.cols(); ++j) {
    const std::size_t slot = found.slots[static_cast<std::size_t>(j)];
    for (Eigen::Index i = 0; i < found.unit.rows(); ++i) {
      found.unit(i, j) = refit.jacobian[static_cast<std::size_t>(i) * slots + slot];
    }
  }
  found.length = found.unit.colwise().norm();
  if (!(found.length.minCoeff() > 0.0)) return std::nullopt;
  found.unit *= found.length.cwiseInverse().asDiagonal();
  return found;
}

}  // namespace recoil
