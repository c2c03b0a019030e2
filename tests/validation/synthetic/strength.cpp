#include "validation/synthetic/strength.hpp"

#include <algorithm>
#include <cmath>

namespace hidden {
namespace {

struct Misfit {
  std::vector<double> residuals;
  double sum = 0.0;
};

Misfit misfit(const Design& design, const std::vector<Point>& points, double C_H, double C_A) {
  Base base = design.base;
  base.C_H = C_H;
  base.C_A = C_A;
  static const Effects nothing;
  Misfit m;
  for (const Point& p : points) {
    const double square = square_of_restitution(base, nothing, p.velocity, p.diameter);
    const double e = std::sqrt(std::max(square, 0.0));
    m.residuals.push_back((p.restitution * p.restitution - square) / (p.sd * (p.restitution + e)));
    m.sum += m.residuals.back() * m.residuals.back();
  }
  return m;
}

Refit refit_from(const Design& design, const std::vector<Point>& points, double C_H, double C_A) {
  double x[2] = {C_H, C_A};
  const double unit[2] = {std::max(design.base.C_H, 1e-6), std::max(design.base.C_A, 1e-6)};
  Misfit now = misfit(design, points, x[0], x[1]);
  double damping = 1e-3;
  for (int round = 0; round < 60; ++round) {
    double gradient[2] = {};
    double normal[2][2] = {};
    std::vector<double> slope[2];
    for (int j = 0; j < 2; ++j) {
      const double h = 1e-4 * unit[j] + 1e-4 * x[j];
      double moved[2] = {x[0], x[1]};
      moved[j] += h;
      const Misfit there = misfit(design, points, moved[0], moved[1]);
      for (std::size_t i = 0; i < points.size(); ++i) {
        slope[j].push_back((there.residuals[i] - now.residuals[i]) / h);
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (int j = 0; j < 2; ++j) {
        gradient[j] += slope[j][i] * now.residuals[i];
        for (int k = 0; k < 2; ++k) normal[j][k] += slope[j][i] * slope[k][i];
      }
    }
    // A parameter at its bound stays there while the slope pushes it out.
    bool held[2];
    // So does one that changes nothing: the damping of an adhesion that is not there.
    for (int j = 0; j < 2; ++j) {
      held[j] = (x[j] == 0.0 && gradient[j] > 0.0) || normal[j][j] == 0.0;
    }
    double step_size = 0.0;
    double gain = 0.0;
    for (int tries = 0; tries < 12; ++tries) {
      double a = normal[0][0] * (1.0 + damping);
      double d = normal[1][1] * (1.0 + damping);
      double b = normal[0][1];
      double r0 = -gradient[0];
      double r1 = -gradient[1];
      if (held[0]) a = 1.0, b = 0.0, r0 = 0.0;
      if (held[1]) d = 1.0, b = 0.0, r1 = 0.0;
      const double det = a * d - b * b;
      const double next[2] = {std::max(x[0] + (d * r0 - b * r1) / det, 0.0),
                              std::max(x[1] + (a * r1 - b * r0) / det, 0.0)};
      const Misfit there = misfit(design, points, next[0], next[1]);
      if (there.sum <= now.sum) {
        step_size = std::abs(next[0] - x[0]) / unit[0] + std::abs(next[1] - x[1]) / unit[1];
        gain = now.sum - there.sum;
        x[0] = next[0];
        x[1] = next[1];
        now = there;
        damping = std::max(damping * 0.1, 1e-9);
        break;
      }
      damping *= 10.0;
    }
    if (step_size < 1e-6 || gain < 1e-6 * (now.sum + 1e-6)) break;
  }
  return {x[0], x[1], std::sqrt(now.sum)};
}

}  // namespace

Refit refit_base(const Design& design, const std::vector<Point>& points) {
  return refit_from(design, points, design.base.C_H, design.base.C_A);
}

}  // namespace hidden
