#include "mechanism/adhesive_yield.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics.hpp"

namespace recoil {
namespace {

/// The loading at a tension kappa as a function of the contact radius x.
class LoadedContact {
 public:
  explicit LoadedContact(double tension)
      : kappa(tension), touch(std::cbrt(4.0 * kappa * kappa)), yield(onset()) {
    at_touch_ = 0.15 * touch * touch * touch * touch * touch;
  }

  struct Load {
    double root;   ///< x^(1/2)
    double s;      ///< the pressure is limited inside of this s
    double force;  ///< f
  };
  Load at(double x) const {
    const double root = std::sqrt(x);
    const double s = x > yield ? 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * kappa * root)) / x : 1.0;
    return {root, s, x * x * (1.0 - s * s + 2.0 / 3.0 * x * s * s * s - 2.0 * kappa * s / root)};
  }
  /// d approach / d x.
  double path(double x) const { return 2.0 * x - kappa / std::sqrt(x); }

  /// Work of loading from touch to x.
  double work(double x) const {
    const double x2 = x * x;
    double sum =
        x2 * (x2 * x * (4.0 / 15.0) - 4.0 / 3.0 * kappa * x * std::sqrt(x) + kappa * kappa) +
        at_touch_;
    over_yield(x, [&](const Node& n) { sum -= n.weight * n.missing * n.path; });
    return sum;
  }
  /// Its derivative by kappa at the same x.
  double work_by_tension(double x) const {
    double sum = -4.0 / 3.0 * x * x * x * std::sqrt(x) + 2.0 * kappa * x * x + std::pow(touch, 3.5);
    over_yield(x, [&](const Node& n) {
      sum += n.weight * (2.0 * n.z * n.z * n.z * (1.0 - n.s) * n.path + n.missing / n.z);
    });
    // If the contact yields from the beginning, the sum begins at touch, which depends on kappa.
    if (touch > yield) {
      const Node first = node_at(std::sqrt(touch));
      sum += first.missing * first.path * 2.0 / 3.0 * touch / kappa;
    }
    return sum;
  }

  double kappa;
  double touch;  ///< x where the approach is 0
  double yield;  ///< x where the pressure in the middle is 1

 private:
  /// The root of z^3 - z = kappa, z = x^(1/2), squared.
  double onset() const {
    double z = 1.0 + std::cbrt(kappa);
    for (int step = 0; step < 60; ++step) {
      const double next = z - (z * z * z - z - kappa) / (3.0 * z * z - 1.0);
      const bool done = std::abs(next - z) <= 1e-15 * z;
      z = next;
      if (done) break;
    }
    return z * z;
  }
  struct Node {
    double z;  ///< x^(1/2)
    double s;
    double missing;  ///< force of JKR less f
    double path;
    double weight;
  };
  Node node_at(double z) const {
    const double x = z * z;
    const double s = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * kappa * z)) / x;
    const double missing =
        2.0 * x * x * (1.0 - s) * (x * (1.0 + s + s * s) / 3.0 - kappa / z - 0.5 * (1.0 + s));
    return {z, s, missing, 2.0 * x - kappa / z, 0.0};
  }
  /// Sums the difference to JKR, from the onset of yield to x, over nodes in z.
  template <class Add>
  void over_yield(double x, Add add) const {
    const double start = std::max(yield, touch);
    if (x <= start) return;
    static const std::vector<QuadratureNode> nodes = gauss_legendre(10);
    const double from = std::sqrt(start);
    const double width = std::sqrt(x) - from;
    for (const QuadratureNode& node : nodes) {
      Node n = node_at(from + width * node.at);
      n.weight = node.weight * width * 2.0 * n.z;
      add(n);
    }
  }

  double at_touch_ = 0.0;  ///< minus the stored energy of JKR at zero approach
};

/// The x at which the work of loading is `energy`, in the range where the force is positive.
double turning_point(const LoadedContact& contact, double energy) {
  // Without adhesion u = x^2 - 1 solves u^2 / 2 + 2 u / 3 = energy - 4 / 15; adhesion pulls deeper.
  const double rest = std::max(energy - 4.0 / 15.0, 0.0);
  double x = std::sqrt(1.0 - 2.0 / 3.0 + std::sqrt(4.0 / 9.0 + 2.0 * rest));
  x = std::max({x, contact.yield, contact.touch});
  for (int grow = 0; grow < 100 && !(contact.at(x).force > 0.0); ++grow) x *= 1.2;
  // The work is convex there. Newton's first step may be too long; the others approach the root
  // from above and double the digits.
  for (int step = 0; step < 60; ++step) {
    const double next = x - (contact.work(x) - energy) / (contact.at(x).force * contact.path(x));
    if (!(contact.at(next).force > 0.0)) {
      x *= 1.2;
      continue;
    }
    const bool done = std::abs(next - x) <= 1e-8 * x;
    x = next;
    if (done) break;
  }
  return x;
}

}  // namespace

AdhesiveYield adhesive_yield(double energy, double tension) {
  const LoadedContact contact(tension);
  AdhesiveYield result;
  result.recovered = energy;
  const bool rises = contact.yield > contact.touch && contact.at(contact.yield).force > 0.0;
  if (rises && contact.work(contact.yield) >= energy) return result;

  result.yielded = true;
  const double kappa = tension;
  const double x = turning_point(contact, energy);
  result.contact = x;
  const auto [root, s, force] = contact.at(x);
  const double slope = force * contact.path(x);  // d work / d x
  const double x_by_energy = 1.0 / slope;
  const double x_by_tension = -contact.work_by_tension(x) / slope;

  // The derivative in s does not contribute, because the pressure is continuous there.
  const double force_by_x =
      2.0 * force / x + x * x * (2.0 / 3.0 * s * s * s + kappa * s / (x * root));
  const double pull = 2.0 * kappa * x * root;
  const double hertz = force + pull;
  const double flat = 2.0 / 3.0 * x * x * x / hertz;
  const double flat_by_x = flat * (3.0 / x - (force_by_x + 3.0 * kappa * root) / hertz);
  const double flat_by_tension = -flat * 2.0 * x * root * (1.0 - s) / hertz;

  // JKR with R_p between its zero approach and x.
  const double x2 = x * x;
  const double x3 = x2 * x;
  const double well = 0.15 * std::pow(2.0 * kappa, 10.0 / 3.0) * std::cbrt(flat);  // over R_p / R
  result.recovered = 4.0 / 15.0 * x3 * x2 / (flat * flat) - 4.0 / 3.0 * kappa * x3 * root / flat +
                     kappa * kappa * x2 + well * flat;
  const double by_x = 4.0 / 3.0 * x2 * x2 / (flat * flat) - 14.0 / 3.0 * kappa * x2 * root / flat +
                      2.0 * kappa * kappa * x;
  const double by_flat = -8.0 / 15.0 * x3 * x2 / (flat * flat * flat) +
                         4.0 / 3.0 * kappa * x3 * root / (flat * flat) + 4.0 / 3.0 * well;
  const double by_tension = -4.0 / 3.0 * x3 * root / flat + 2.0 * kappa * x2 +
                            std::pow(contact.touch, 3.5) * flat * std::cbrt(flat);

  const double along = by_x + by_flat * flat_by_x;
  result.recovered_by_energy = along * x_by_energy;
  result.recovered_by_tension = along * x_by_tension + by_flat * flat_by_tension + by_tension;
  result.flatness = flat;
  result.flatness_by_energy = flat_by_x * x_by_energy;
  result.flatness_by_tension = flat_by_x * x_by_tension + flat_by_tension;
  return result;
}

}  // namespace recoil
