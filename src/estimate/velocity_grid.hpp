#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "estimate/observation.hpp"

namespace recoil {

/// Velocities at which spheres are simulated in place of many points. Between them e^2, a smooth
/// function of ln V for one dataset, series and diameter, is interpolated through eight neighbours:
/// to 1e-9, and to 1e-8 where `rough_points` just accepts a kink, such as that at the capture
/// velocity.
class VelocityGrid {
 public:
  /// Nullopt if the grid would not be much smaller than `points`.
  static std::optional<VelocityGrid> for_points(std::span<const PointConditions> points);

  const std::vector<PointConditions>& nodes() const { return nodes_; }
  std::size_t size() const { return places_.size(); }

  /// The points that cannot be interpolated. A point with few others alike is a node itself.
  /// @param squares e^2 at the nodes; NaN where it has no solution
  std::vector<std::size_t> rough_points(std::span<const double> squares) const;

  /// Calls act(node, weight) for every node whose value counts at point i.
  template <class Act>
  void for_each_neighbour(std::size_t i, const Act& act) const {
    const Place& place = places_[i];
    if (place.alone) return act(place.node, 1.0);
    for (std::size_t k = 0; k < place.weights.size(); ++k) act(place.node + k, place.weights[k]);
  }

 private:
  struct Place {
    std::size_t node = 0;  ///< the first of the neighbours, or that of the point
    bool alone = true;     ///< the point is a node
    std::array<double, 8> weights = {};
  };

  std::vector<PointConditions> nodes_;
  std::vector<Place> places_;
};

}  // namespace recoil
