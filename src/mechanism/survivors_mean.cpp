#include "mechanism/survivors_mean.hpp"

#include <cassert>
#include <cmath>
#include <vector>

#include "core/numerics.hpp"
#include "core/units.hpp"
#include "mechanism/mechanism.hpp"

namespace recoil {
namespace {

using Weights = std::array<double, spread_nodes>;

/// Lagrange polynomials at z and their derivatives, by the product formula.
struct Basis {
  Weights value{};
  Weights slope{};
};

Basis basis_at(double z) {
  const Weights& x = spread_positions();
  Basis basis;
  for (std::size_t k = 0; k < spread_nodes; ++k) {
    double product = 1.0;
    double derivative = 0.0;
    for (std::size_t j = 0; j < spread_nodes; ++j) {
      if (j == k) continue;
      const double inverse = 1.0 / (x[k] - x[j]);
      derivative = (derivative * (z - x[j]) + product) * inverse;
      product *= (z - x[j]) * inverse;
    }
    basis.value[k] = product;
    basis.slope[k] = derivative;
  }
  return basis;
}

/// Gauss-Legendre points and weights on [0, 1].
constexpr std::size_t quadrature_points = 12;
struct Quadrature {
  std::array<double, quadrature_points> at{};
  std::array<double, quadrature_points> weight{};
  std::array<Basis, quadrature_points> whole_from_low{};  // bases of the undivided interval
  std::array<Basis, quadrature_points> whole_from_high{};
};

const Quadrature& quadrature() {
  static const Quadrature rule = [] {
    Quadrature q;
    const std::vector<QuadratureNode> nodes = gauss_legendre(quadrature_points);
    for (std::size_t k = 0; k < quadrature_points; ++k) {
      q.at[k] = nodes[k].at;
      q.weight[k] = nodes[k].weight;
      const double s2 = q.at[k] * q.at[k];
      q.whole_from_low[k] = basis_at(spread_reach * (2.0 * s2 - 1.0));
      q.whole_from_high[k] = basis_at(spread_reach * (1.0 - 2.0 * s2));
    }
    return q;
  }();
  return rule;
}

template <class T>
T combine(const Weights& of_node, std::span<const T> x) {
  // Relative to the typical sphere, which is exact if all spheres are equal.
  const T& middle = x[spread_nodes / 2];
  T sum = middle;
  for (std::size_t k = 0; k < spread_nodes; ++k) sum += of_node[k] * (x[k] - middle);
  return sum;
}

template <class T>
double slope_at(const Basis& basis, std::span<const T> x) {
  double sum = 0.0;
  const double middle = value_of(x[spread_nodes / 2]);
  for (std::size_t k = 0; k < spread_nodes; ++k) sum += basis.slope[k] * (value_of(x[k]) - middle);
  return sum;
}

/// The z at which the interpolated e^2 is `seen`, which lies between the values at both ends.
template <class T>
T crossing(std::span<const T> x, const T& seen) {
  double inside =
      value_of(x.front()) > value_of(x.back()) ? -spread_reach : spread_reach;  // comes back
  double outside = -inside;
  // No call of find_root, because this is the innermost loop of a fit.
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    const Basis basis = basis_at(middle);
    double at = 0.0;
    for (std::size_t k = 0; k < spread_nodes; ++k) at += basis.value[k] * value_of(x[k]);
    (at > value_of(seen) ? inside : outside) = middle;
  }
  const Basis basis = basis_at(inside);
  const T there = combine(basis.value, x) - seen;
  T z = inside;
  add_slopes(z, -1.0 / slope_at(basis, x), there);
  return z;
}

/// The continuation of e^2 if no sphere rebounds, or no rebound is detected. `last` belongs to the
/// sphere that rebounds most easily, `other` to the opposite end. The slope begins with 4/9 (the
/// mean of sqrt(t) over a short interval from 0 is 2/3 of its largest value), or with 1/2 if `seen`
/// is above zero (the square root is nearly linear over a short interval). It is 1 far below, and
/// if all spheres are equal.
template <class T>
T beyond_the_last(const T& last, const T& other, const T& seen) {
  const T depth = seen - last;
  const T width = last - other;
  if (value_of(depth) + value_of(width) == 0.0) return last;
  const double at_first = value_of(seen) > 0.0 ? 0.5 : 4.0 / 9.0;
  return seen - depth * ((at_first * width + depth) / (width + depth));
}

/// Accumulates the mean e of the detected rebounds.
template <class T>
class SeenMean {
 public:
  void add(const T& weight, const T& square) {
    if (!(value_of(square) > 0.0)) return;  // within rounding of the edge
    total_ += weight * sqrt(square);
    weights_ += weight;
  }
  /// @param single the result if the weights vanish
  T square(const T& single) const {
    if (!(value_of(weights_) > 0.0)) return single;
    const T mean = total_ / weights_;
    return mean * mean;
  }

 private:
  T total_ = 0.0;
  T weights_ = 0.0;
};

/// e^2 at z, with the derivatives of z.
template <class T>
T moving_square(std::span<const T> x, const T& z) {
  const Basis basis = basis_at(value_of(z));
  T square = combine(basis.value, x);
  add_slopes(square, slope_at(basis, x), z);
  return square;
}

/// Adds spheres with normally distributed z, from the edge of detection to the end `from`.
template <class T>
void add_normal(std::span<const T> x, const T& edge, double from, bool whole, SeenMean<T>& mean) {
  // The nodes are denser at the edge, where sqrt(e^2) is steep.
  const Quadrature& rule = quadrature();
  for (std::size_t i = 0; i < quadrature_points; ++i) {
    const double s = rule.at[i];
    const T z = edge + (from - edge) * (s * s);
    const Basis& fixed = from < 0.0 ? rule.whole_from_high[i] : rule.whole_from_low[i];
    mean.add(rule.weight[i] * s * normal_density(z),
             whole ? combine(fixed.value, x) : moving_square(x, z));
  }
}

/// Adds the spheres of a piece of the sizes between the edge of detection and `end`.
template <class T>
void add_seen_part(std::span<const T> x, const T& edge, double end, const SizePiece& piece,
                   double rate, SeenMean<T>& mean) {
  // The density of diameters is uniform, so that the density of z is proportional to exp(rate z).
  const double density =
      piece.weight * rate / (std::exp(rate * piece.to) - std::exp(rate * piece.from));
  const T width = value_of(edge) < end ? end - edge : edge - end;
  const Quadrature& rule = quadrature();
  for (std::size_t i = 0; i < quadrature_points; ++i) {
    const double s = rule.at[i];
    const T z = edge + (end - edge) * (s * s);
    mean.add(2.0 * s * rule.weight[i] * density * width * exponential(rate * z),
             moving_square(x, z));
  }
}

/// Standard deviation of ln d, with a uniform density within each bin.
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
  constexpr std::size_t count = 5;  // per bin; e is a smooth function of d
  std::vector<SizePiece::Sphere> spheres;
  for (const QuadratureNode& node : gauss_legendre(bin.width > 0.0 ? count : 1)) {
    const double d = bin.diameter + (node.at - 0.5) * bin.width;
    spheres.push_back({part * node.weight, basis_at((std::log(d) - middle) / rate).value});
  }
  return spheres;
}

}  // namespace

const std::array<double, spread_nodes>& spread_positions() {
  static const Weights positions = [] {
    Weights z{};
    for (std::size_t k = 0; k < spread_nodes; ++k) {
      z[k] = -spread_reach *
             std::cos(std::numbers::pi * static_cast<double>(k) / (spread_nodes - 1.0));
    }
    z[spread_nodes / 2] = 0.0;
    return z;
  }();
  return positions;
}

double cut_scale() {
  // Variance of a normal distribution truncated at b: 1 - 2 b phi(b) / (2 Phi(b) - 1).
  static const double scale =
      1.0 / std::sqrt(1.0 - 2.0 * spread_reach * normal_density(spread_reach) /
                                (2.0 * normal_probability(spread_reach) - 1.0));
  return scale;
}

template <class T>
T survivors_square(std::span<const T> x, const T& seen, const MixedSizes& sizes) {
  assert(x.size() == spread_nodes);
  const double low = value_of(x.front());
  const double high = value_of(x.back());
  const bool low_best = low >= high;  // the smallest z rebounds most easily
  const T& best = low_best ? x.front() : x.back();
  const T& worst = low_best ? x.back() : x.front();
  if (!(value_of(best) > value_of(seen))) return beyond_the_last(best, worst, seen);
  const bool whole = value_of(worst) > value_of(seen);
  const double from = low_best ? -spread_reach : spread_reach;
  const T edge = whole ? T(-from) : crossing(x, seen);
  SeenMean<T> mean;
  if (!sizes.mixed()) {
    add_normal(x, edge, from, whole, mean);
    return mean.square(best);
  }
  for (const SizePiece& piece : *sizes.pieces) {
    const double at = value_of(edge);
    const bool outside = !whole && (low_best ? piece.from >= at : piece.to <= at);
    if (outside) continue;
    if (whole || (low_best ? piece.to <= at : piece.from >= at)) {
      for (const SizePiece::Sphere& sphere : piece.spheres) {
        mean.add(T(sphere.weight), combine(sphere.of_node, x));
      }
    } else {
      add_seen_part(x, edge, low_best ? piece.from : piece.to, piece, sizes.rate, mean);
    }
  }
  return mean.square(best);
}

template double survivors_square(std::span<const double>, const double&, const MixedSizes&);
template FewDirections survivors_square(std::span<const FewDirections>, const FewDirections&,
                                        const MixedSizes&);
template SomeDirections survivors_square(std::span<const SomeDirections>, const SomeDirections&,
                                         const MixedSizes&);
template SeveralDirections survivors_square(std::span<const SeveralDirections>,
                                            const SeveralDirections&, const MixedSizes&);
template ManyDirections survivors_square(std::span<const ManyDirections>, const ManyDirections&,
                                         const MixedSizes&);

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
