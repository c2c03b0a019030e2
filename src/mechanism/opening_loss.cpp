#include "mechanism/opening_loss.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mechanism/radau.hpp"

namespace recoil {
namespace {

// The slopes of a `Sloped` number: in the groups, in their order, and in the deepest point.
constexpr std::size_t by_deepest = OpeningGroups::count;
constexpr std::size_t by_returned = by_deepest - 1;
using Sloped = Dual<by_deepest + 1>;

/// Potential energy of the contact at x.
double potential(double x, double beta) { return x * std::sqrt(x) * (0.4 * x - 2.0 / 3.0 * beta); }
double potential_by_place(double x, double beta) { return std::sqrt(x) * (x - beta); }
double potential_by_beta(double x) { return -2.0 / 3.0 * x * std::sqrt(x); }

/// A node of the quadrature in s, with x = X cos^4(pi s / 2).
struct Node {
  double part;     ///< x / X
  double stretch;  ///< |dx / ds| / X
};

template <int steps>
const std::array<Node, 3 * steps>& nodes_of() {
  static const std::array<Node, 3 * steps> nodes = [] {
    std::array<Node, 3 * steps> made;
    for (int k = 0; k < 3 * steps; ++k) {
      const double angle = 0.5 * std::numbers::pi * radau_place(k, steps);
      const double cosine = k + 1 == 3 * steps ? 0.0 : std::cos(angle);
      const double cube = cosine * cosine * cosine;
      made[static_cast<std::size_t>(k)] = {cube * cosine,
                                           2.0 * std::numbers::pi * cube * std::sin(angle)};
    }
    return made;
  }();
  return nodes;
}

/// One phase between the deepest point X (s = 0) and x = 0 (s = 1): x = X cos^4(pi s / 2), in which
/// u and the rates of all losses are smooth.
struct Phase {
  const OpeningGroups& g;
  double direction;  ///< 1 in, -1 out
  bool gamma_acts;
  double deepest;
  bool opens = false;     ///< the opening takes energy, too
  Sloped elsewhere = {};  ///< other losses, distributed evenly in x
  double bottom = potential(deepest, g.beta);

  /// The energy lost per s, if `lost` was lost since the deepest point.
  RateOfLoss rate(const Node& node, double lost, Sloped* sloped = nullptr) const {
    const auto [part, stretch] = node;
    const double x = deepest * part;
    const double dx = deepest * stretch;
    if (sloped != nullptr) *sloped = stretch * elsewhere;
    if (stretch == 0.0) return {0.0, 0.0};  // faster than u / x^(1/2) grows
    const double gamma = gamma_acts ? g.gamma : 0.0;
    const double root = std::sqrt(x);
    const double square = 2.0 * (bottom - potential(x, g.beta) + direction * lost);
    // A captured sphere stops, and the opening with it: u^2 is smoothed over this width.
    constexpr double width = 1e-4;
    const double hypotenuse = std::sqrt(square * square + width * width);
    const double seen =
        square > 0.0 ? 0.5 * (square + hypotenuse) : 0.5 * width * width / (hypotenuse - square);
    const double u = std::sqrt(seen);
    const double damping = root * (g.alpha * x + g.beta * gamma + g.kappa) * u;
    const double per_strength = opens ? std::pow(seen / x, 0.5 * g.exponent) : 0.0;
    const double opening = g.strength * per_strength;
    const double by_square = 0.5 * (damping + g.exponent * opening) / hypotenuse * dx;
    if (sloped != nullptr) {
      auto& by = sloped->slope;
      by[0] += root * x * u * dx;
      by[1] += root * gamma * u * dx +
               2.0 * by_square * (potential_by_beta(deepest) - potential_by_beta(x));
      if (gamma_acts) by[2] += root * g.beta * u * dx;
      by[3] += root * u * dx;
      by[4] += per_strength * dx;
      by[5] += 0.5 * opening * std::log(seen / x) * dx;
      // x and dx are proportional to the deepest point.
      by[by_deepest] +=
          (1.5 * damping + root * g.alpha * x * u + (1.0 - 0.5 * g.exponent) * opening) * dx /
              deepest +
          2.0 * by_square *
              (potential_by_place(deepest, g.beta) - potential_by_place(x, g.beta) * part);
    }
    return {(damping + opening) * dx + elsewhere.value * stretch, 2.0 * direction * by_square};
  }

  /// The energy lost in the whole phase.
  template <class N, int steps>
  N loss() const {
    const auto& nodes = nodes_of<steps>();
    return integrate_loss<N, steps>(
        [&](int k, double lost) { return rate(nodes[static_cast<std::size_t>(k)], lost); },
        [&](int k, double lost) {
          Sloped sloped;
          rate(nodes[static_cast<std::size_t>(k)], lost, &sloped);
          return sloped;
        });
  }
};

constexpr int in_steps = 4;
constexpr int out_steps = 8;

/// The deepest point X: 1/2 = U(X) + the loss on the way in. Newton's method.
Sloped deepest_point(const OpeningGroups& g, bool damps_both) {
  // First without damping. U is convex above the root, so that no step overshoots from there.
  double deepest = std::pow(1.25, 0.4) + 5.0 / 3.0 * g.beta;
  for (double change = deepest; change > 1e-6 * deepest; deepest -= change) {
    change = (potential(deepest, g.beta) - 0.5) / potential_by_place(deepest, g.beta);
  }
  for (int step = 0;; ++step) {
    const Sloped lost = Phase{g, 1.0, damps_both, deepest}.loss<Sloped, in_steps>();
    const double by_place = potential_by_place(deepest, g.beta) + lost.slope[by_deepest];
    const double change = (potential(deepest, g.beta) + lost.value - 0.5) / by_place;
    deepest = std::max(deepest - change, 0.1 * deepest);
    // The error after a step is of the order of its square.
    if (std::abs(change) > 1e-6 * deepest && step < 8) continue;
    Sloped found = (-1.0 / by_place) * lost;
    found.value = deepest;
    found.slope[1] -= potential_by_beta(deepest) / by_place;
    found.slope[by_deepest] = 0.0;
    return found;
  }
}

/// u^2 at x = 0 on the way out.
template <class N>
N square_out(const OpeningGroups& g, const N& deepest, bool opens, const N& elsewhere) {
  const double X = value_of(deepest);
  const Phase phase{g, -1.0, true, X, opens, Sloped(elsewhere)};
  N square = 2.0 * (potential(X, g.beta) - phase.loss<N, out_steps>());
  if constexpr (std::is_same_v<N, Sloped>) {
    square.slope[1] += 2.0 * potential_by_beta(X);
    const double by_place = square.slope[by_deepest] + 2.0 * potential_by_place(X, g.beta);
    square.slope[by_deepest] = 0.0;
    add_slopes(square, by_place, deepest);
  }
  return square;
}

}  // namespace

OpeningLoss opening_loss(const OpeningGroups& groups, bool damps_both, bool slopes) {
  if (!slopes && groups.strength == 0.0) return {};
  const Sloped deepest = deepest_point(groups, damps_both);
  const auto taken = [&]<class N>(const N& at, const N& by_square) {
    const N plain = square_out(groups, at, false, N(0.0));
    const N elsewhere = 0.5 * (plain - groups.returned) + by_square;
    return N(square_out(groups, at, false, elsewhere) - square_out(groups, at, true, elsewhere));
  };
  if (!slopes) return {taken(deepest.value, 0.0), {}};
  Sloped by_square(0.0);
  by_square.slope[by_returned] = -0.5;
  const Sloped all = taken(deepest, by_square);
  OpeningLoss loss{all.value, {}};
  std::copy_n(all.slope.begin(), OpeningGroups::count, loss.slopes.begin());
  return loss;
}

}  // namespace recoil
