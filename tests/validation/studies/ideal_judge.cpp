#include "validation/studies/ideal_judge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

#include "core/random.hpp"
#include "mechanism/mechanism.hpp"
#include "validation/studies/baseline.hpp"
#include "validation/synthetic/hidden_effect.hpp"
#include "validation/synthetic/sphere.hpp"
#include "validation/synthetic/strength.hpp"

namespace recoil::hidden {

namespace fs = std::filesystem;

// ---- what can be named -----------------------------------------------------------------------

Case without_noise(Case made) {
  for (std::size_t i = 0; i < made.points.size(); ++i) {
    made.readings[i] = made.points[i].restitution;
  }
  made.design.decimals = 6;
  return made;
}

double misfit_left(const fs::path& fit, const std::string& mechanism,
                   const std::vector<std::string>& freed) {
  const FitResult fitted =
      fit_with(fit, mechanism.empty() ? std::vector<std::string>{} : std::vector{mechanism}, freed);
  return fitted.usable ? std::sqrt(fitted.chi2) : std::numeric_limits<double>::infinity();
}

double NearestRival::nameable() const {
  constexpr double margin = 4.0;
  const double lambda = misfit * misfit;
  if (!(lambda > 0.0)) return 0.0;
  if (!std::isfinite(lambda)) return 1.0;
  return 0.5 * std::erfc((margin - lambda - 2.0 * freed) / (2.0 * std::sqrt(2.0 * lambda)));
}

namespace {

/// Fits with a spread take a hundred times as long as others.
bool spreads(std::string_view id) { return id == "polydispersity" || id == "survivor_bias"; }

bool worth_trying(std::string_view other, std::string_view truth) {
  if (other == truth) return false;
  return !spreads(other) || spreads(truth) || truth == "rebound_truncation" || truth == "outliers";
}

/// The parameters that the catalogue fixes and that a search for causes may free.
std::vector<std::string> released_by_a_search(const std::string& id) {
  std::vector<std::string> names;
  for (const Parameter& parameter : find_mechanism(id)->info.parameters) {
    if (!parameter.free && parameter.searched) names.emplace_back(parameter.name);
  }
  return names;
}

bool is_law_of_one_cause(const std::string& a, const std::string& b) {
  const std::string_view cause = find_mechanism(a)->info.cause;
  return !cause.empty() && cause == find_mechanism(b)->info.cause;
}

void keep_nearer(NearestRival& closest, const NearestRival& rival) {
  const auto hard = [](const NearestRival& one) { return std::pair(one.nameable(), one.misfit); };
  if (hard(rival) < hard(closest)) closest = rival;
}

}  // namespace

std::pair<NearestRival, NearestRival> nearest_rivals(const Case& made) {
  const std::string& truth = made.order.effects.front();
  const ScratchFolder scratch;
  const fs::path fit = write_case(without_noise(made), scratch.path());
  const NearestRival none{"", std::numeric_limits<double>::infinity(), 0};
  std::pair<NearestRival, NearestRival> closest{none, none};
  for (const HiddenEffect& effect : hidden_effects()) {
    const bool in_catalogue =
        effect.kind == EffectKind::physics || effect.kind == EffectKind::measurement;
    if (!in_catalogue || !worth_trying(effect.id, truth)) continue;
    const std::string id(effect.id);
    std::vector<std::vector<std::string>> ways = {{}};
    if (auto freed = released_by_a_search(id); !freed.empty()) ways.push_back(std::move(freed));
    for (const std::vector<std::string>& freed : ways) {
      const NearestRival rival = {id, misfit_left(fit, id, freed), static_cast<int>(freed.size())};
      keep_nearer(closest.first, rival);
      if (!is_law_of_one_cause(id, truth)) keep_nearer(closest.second, rival);
    }
  }
  return closest;
}

// ---- what can be seen ------------------------------------------------------------------------

namespace {

/// The sizes of an error of the laws, relative to the loss, with their probabilities.
constexpr std::array<std::pair<double, double>, 3> law_errors = {
    {{0.03, 1.0 / 7.0}, {0.06, 2.0 / 7.0}, {0.12, 4.0 / 7.0}}};
constexpr double false_alarms = 0.05;
constexpr std::uint32_t judging = 2;  // beside the purposes of `RandomPurpose`

/// ln of the density of N(0, I + s^2 F F') times a probability, a constant left out.
struct Normal {
  Eigen::LLT<Eigen::MatrixXd> covariance;
  double log_weight;  ///< ln of its probability, less half of ln det

  Normal(const Eigen::MatrixXd& errors, double size, double probability)
      : covariance(Eigen::MatrixXd::Identity(errors.rows(), errors.rows()) +
                   size * size * errors * errors.transpose()) {
    const Eigen::MatrixXd lower = covariance.matrixL();
    log_weight = std::log(probability) - lower.diagonal().array().log().sum();
  }
  double operator()(const Eigen::VectorXd& z) const {
    return log_weight - 0.5 * covariance.matrixL().solve(z).squaredNorm();
  }
};

double log_density(const std::vector<Normal>& sizes, const Eigen::VectorXd& z) {
  std::vector<double> each;
  std::transform(sizes.begin(), sizes.end(), std::back_inserter(each),
                 [&](const Normal& one) { return one(z); });
  const double most = *std::max_element(each.begin(), each.end());
  return most + std::log(std::accumulate(each.begin(), each.end(), 0.0, [&](double sum, double l) {
           return sum + std::exp(l - most);
         }));
}

/// Directions [points x any] that C_H and C_A do not move: orthonormal.
Eigen::MatrixXd beside_the_dampings(const Case& made, const std::vector<Point>& points,
                                    const Refit& base, const Eigen::VectorXd& residuals) {
  Eigen::MatrixX2d slopes(residuals.size(), 2);
  const double h_H = 1e-4 * std::max(base.C_H, 1e-6);
  const double h_A = 1e-4 * std::max(base.C_A, 1e-6);
  slopes.col(0) = (base_residuals(made.design, points, base.C_H + h_H, base.C_A) - residuals) / h_H;
  slopes.col(1) = (base_residuals(made.design, points, base.C_H, base.C_A + h_A) - residuals) / h_A;
  for (const Eigen::Index j : {0, 1}) {
    if (const double size = slopes.col(j).norm(); size > 0.0) slopes.col(j) /= size;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(slopes);
  qr.setThreshold(1e-6);
  const Eigen::MatrixXd all =
      qr.householderQ() * Eigen::MatrixXd::Identity(slopes.rows(), slopes.rows());
  return all.rightCols(slopes.rows() - qr.rank());
}

/// What a relative error of the losses of 1 does to the residuals: F [points x rank], with
/// covariance F F'.
Eigen::MatrixXd errors_of_laws(const Case& made, const std::vector<Point>& points,
                               const Refit& base) {
  const auto n = static_cast<Eigen::Index>(points.size());
  Base fitted = made.design.base;
  fitted.C_H = base.C_H;
  fitted.C_A = base.C_A;
  static const Effects nothing;
  Eigen::ArrayXd loss(n), log_velocity(n), log_diameter(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Point& p = points[static_cast<std::size_t>(i)];
    const double square = square_of_restitution(fitted, nothing, p.velocity, p.diameter);
    loss(i) = (1.0 - square) / (p.sd * (p.restitution + std::sqrt(std::max(square, 0.0))));
    log_velocity(i) = std::log(p.velocity);
    log_diameter(i) = std::log(p.diameter);
  }
  Eigen::MatrixXd covariance(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    covariance.col(j) = (-0.5 * ((log_velocity - log_velocity(j)).square() +
                                 (log_diameter - log_diameter(j)).square()))
                            .exp() *
                        loss * loss(j);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

}  // namespace

double power_beside_law_errors(const Eigen::VectorXd& effect, const Eigen::MatrixXd& errors,
                               std::uint64_t seed, int draws) {
  std::vector<Normal> sizes;
  for (const auto& [size, probability] : law_errors) sizes.emplace_back(errors, size, probability);
  RandomStream random(seed, static_cast<RandomPurpose>(judging), 0);
  const auto normal = [&](Eigen::Index n) {
    Eigen::VectorXd z(n);
    for (double& one : z) one = random.normal();
    return z;
  };
  const auto statistic = [&](const Eigen::VectorXd& z) {
    return log_density(sizes, z - effect) - log_density(sizes, z);
  };
  std::vector<double> nothing;
  for (int k = 0; k < draws; ++k) {
    double u = random.uniform();
    double size = 0.0;
    for (const auto& [one, probability] : law_errors) {
      size = one;
      if ((u -= probability) < 0.0) break;
    }
    nothing.push_back(statistic(normal(effect.size()) + size * (errors * normal(errors.cols()))));
  }
  std::sort(nothing.begin(), nothing.end());
  const double bar = nothing[static_cast<std::size_t>((1.0 - false_alarms) * draws)];
  int seen = 0;
  for (int k = 0; k < draws; ++k) {
    seen += statistic(normal(effect.size()) + effect) > bar ? 1 : 0;
  }
  return static_cast<double>(seen) / draws;
}

double probability_to_see(const Case& made) {
  std::vector<Point> points = made.points;
  std::erase_if(points, [](const Point& p) { return !(p.restitution > 0.0); });
  const Refit base = refit_base(made.design, points);
  const Eigen::VectorXd residuals = base_residuals(made.design, points, base.C_H, base.C_A);
  const Eigen::MatrixXd free = beside_the_dampings(made, points, base, residuals);
  return power_beside_law_errors(free.transpose() * residuals,
                                 free.transpose() * errors_of_laws(made, points, base),
                                 made.order.experiment_seed());
}

IdealJudge ideal_judge(const Case& made, bool with_rivals) {
  IdealJudge judge;
  if (with_rivals) std::tie(judge.rival, judge.other) = nearest_rivals(made);
  judge.sees = probability_to_see(made);
  return judge;
}

}  // namespace recoil::hidden
