#include "mechanism/mixed_sizes.hpp"

#include <cmath>

#include "core/quadrature.hpp"
#include "core/units.hpp"
#include "mechanism/survivors_mean.hpp"

namespace recoil {
namespace {

/// Standard deviation of ln d, with the spheres of a bin spread evenly over it.
double spread_of(const MeasuredSizes& sizes) {
  constexpr int parts = 50;
  const std::vector<SizeBin> fine = spread_within_bins(sizes.bins, parts);
  double mean = 0.0;
  double square = 0.0;
  for (const SizeBin& bin : fine) mean += bin.weight / sizes.total() * std::log(bin.diameter);
  for (const SizeBin& bin : fine) {
    square += bin.weight / sizes.total() * std::pow(std::log(bin.diameter) - mean, 2);
  }
  return std::sqrt(square);
}

std::vector<SizePiece::Sphere> spheres_of(const SizeBin& bin, double part, double middle,
                                          double rate) {
  constexpr std::size_t count = 5;  // of a bin, of which e is a smooth function
  std::vector<SizePiece::Sphere> spheres;
  for (const QuadratureNode& node : gauss_legendre(bin.width > 0.0 ? count : 1)) {
    const double d = bin.diameter + (node.at - 0.5) * bin.width;
    spheres.push_back({part * node.weight, interpolation_weights((std::log(d) - middle) / rate)});
  }
  return spheres;
}

}  // namespace

MixedSizes mixed_sizes_of(const MeasuredSizes& sizes) {
  MixedSizes out;
  double smallest = INFINITY;
  double largest = 0.0;
  for (const SizeBin& bin : sizes.bins) {
    smallest = std::min(smallest, bin.diameter - 0.5 * bin.width);
    largest = std::max(largest, bin.diameter + 0.5 * bin.width);
  }
  if (!(largest > smallest)) return out;
  out.spread = spread_of(sizes);
  const double middle = 0.5 * std::log(smallest * largest);
  out.rate = std::log(largest / smallest) / (2.0 * spread_reach);
  for (std::size_t k = 0; k < spread_nodes; ++k) {
    out.shape[k] =
        (middle + out.rate * spread_positions()[k] - std::log(sizes.mean_diameter())) / out.spread;
  }
  std::vector<SizePiece> pieces;
  for (const SizeBin& bin : sizes.bins) {
    const auto place = [&](double diameter) { return (std::log(diameter) - middle) / out.rate; };
    const double part = bin.weight / sizes.total();
    pieces.push_back({place(bin.diameter - 0.5 * bin.width), place(bin.diameter + 0.5 * bin.width),
                      part, spheres_of(bin, part, middle, out.rate)});
  }
  out.pieces = std::make_shared<const std::vector<SizePiece>>(std::move(pieces));
  out.slowest_seen = std::sqrt(2.0 * standard_gravity * sizes.probe_height.value_or(0.0));
  return out;
}

}  // namespace recoil
