#include "estimate/friction.hpp"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "estimate/restitution_summary.hpp"

namespace recoil {
namespace {

constexpr double lost_by_rolling = 2.0 / 7.0;  ///< 1 - e_t of a solid sphere that rolls
constexpr double resolution = 1e-9;            ///< e_t is not known better [1]

struct TangentialLoss {
  double slope = 0.0;  ///< (1 + e) V_n / V_t [1]
  double lost = 0.0;   ///< 1 - e_t [1]
};

/// The losses, first those that roll only at a large mu.
std::vector<TangentialLoss> tangential_losses(const Dataset& dataset) {
  std::vector<TangentialLoss> losses;
  for (const ImpactPoint& point : dataset.points) {
    if (!point.tangential_restitution || point.counts_only || point.all_captured()) continue;
    losses.push_back({(1.0 + point.restitution) / std::tan(point.incidence_angle),
                      1.0 - *point.tangential_restitution});
  }
  std::ranges::sort(losses, {}, &TangentialLoss::slope);
  return losses;
}

/// S(mu) = a - 2 b mu + c mu^2 where the first `sliding` spheres slide, from `lower` to `upper`.
struct FrictionPiece {
  std::size_t sliding = 0;
  double a = 0.0, b = 0.0, c = 0.0;
  double lower = 0.0;
  double upper = std::numeric_limits<double>::infinity();

  double best() const { return sliding == 0 ? lower : std::clamp(b / c, lower, upper); }
  double sum(double mu) const { return std::max(0.0, a - 2.0 * b * mu + c * mu * mu); }
};

/// The pieces of S(mu), from that on which all spheres roll to that on which all slide.
std::vector<FrictionPiece> friction_pieces(const std::vector<TangentialLoss>& losses) {
  std::vector<FrictionPiece> pieces(losses.size() + 1);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    FrictionPiece& piece = pieces[k];
    piece.sliding = k;
    for (std::size_t i = 0; i < losses.size(); ++i) {
      const auto& [slope, lost] = losses[i];
      piece.a += std::pow(i < k ? lost : lost - lost_by_rolling, 2);
      if (i >= k) continue;
      piece.b += slope * lost;
      piece.c += slope * slope;
    }
    if (k < losses.size()) piece.lower = lost_by_rolling / losses[k].slope;
    if (k > 0) piece.upper = lost_by_rolling / losses[k - 1].slope;
  }
  return pieces;
}

/// The smallest and the largest mu with S(mu) <= level.
std::array<double, 2> friction_range(double level, const std::vector<FrictionPiece>& pieces,
                                     double best) {
  std::array<double, 2> range = {best, best};
  for (const FrictionPiece& piece : pieces) {
    double lower = piece.lower;
    double upper = piece.upper;
    if (piece.sliding > 0) {
      const double square = piece.b * piece.b - piece.c * (piece.a - level);
      if (square < 0.0) continue;
      lower = std::max(lower, (piece.b - std::sqrt(square)) / piece.c);
      upper = std::min(upper, (piece.b + std::sqrt(square)) / piece.c);
    } else if (piece.a > level) {
      continue;
    }
    if (lower > upper) continue;
    range = {std::min(range[0], lower), std::max(range[1], upper)};
  }
  return range;
}

}  // namespace

std::optional<Friction> fit_friction(const Dataset& dataset) {
  const std::vector<TangentialLoss> losses = tangential_losses(dataset);
  if (losses.empty()) return std::nullopt;
  const std::vector<FrictionPiece> pieces = friction_pieces(losses);
  const FrictionPiece& best = *std::ranges::min_element(
      pieces, {}, [](const FrictionPiece& piece) { return piece.sum(piece.best()); });
  Friction found;
  found.points = losses.size();
  found.sliding = best.sliding;
  const double mu = best.best();
  const auto n = static_cast<double>(losses.size());
  double level = best.sum(mu) + n * resolution * resolution;
  if (n > 1.0) {
    const double t = gsl_cdf_tdist_Qinv(0.5 * (1.0 - summary_level), n - 1.0);
    level *= 1.0 + t * t / (n - 1.0);
  }
  const std::array<double, 2> range = friction_range(level, pieces, mu);
  if (std::isinf(range[1])) {
    found.least = range[0];
    return found;
  }
  found.mu = mu;
  if (n > 1.0) found.interval = range;
  return found;
}

}  // namespace recoil
