#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "diagnosis/candidate.hpp"

namespace recoil {

/// The columns of a refit's Jacobian that belong to what moves, each of unit length: the units of
/// the parameters lie twenty decades apart.
struct MovingColumns {
  std::vector<std::size_t> slots;  ///< [columns]
  Eigen::MatrixXd unit;            ///< [points x columns]
  Eigen::VectorXd length;          ///< [columns]
};

/// Nothing where no slot moves, or where no residual feels one that does.
std::optional<MovingColumns> moving_columns(const Refit& refit);

}  // namespace recoil
