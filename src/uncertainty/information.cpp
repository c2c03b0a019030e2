#include "uncertainty/information.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "estimate/impact_problem.hpp"
#include "estimate/predictor.hpp"

namespace recoil {
namespace {

constexpr int planned_points = 5;
// A direction is named after a combination if the cosine of the angle between them is at least
// this.
constexpr double close_direction = 0.97;

/// The free slots whose estimate is positive and not at a bound.
std::vector<std::size_t> inner_slots(const FitResult& fitted) {
  std::vector<std::size_t> inner;
  for (std::size_t j = 0; j < fitted.theta.size(); ++j) {
    if (fitted.model.slots[j].free && !fitted.at_bound[j] && fitted.theta[j] > 0.0) {
      inner.push_back(j);
    }
  }
  return inner;
}

/// What turns a derivative in a slot into one in its logarithm; 1 for a coefficient of the error of
/// the laws, which has no logarithm.
double scale_of(const FitResult& fitted, std::size_t slot) {
  return slot < fitted.model.first_law_slot() ? fitted.theta[slot] : 1.0;
}

/// The slots of the uncertain constants.
std::vector<std::size_t> constant_slots(const FitResult& fitted) {
  std::vector<std::size_t> slots;
  for (std::size_t j = fitted.model.first_constant(); j < fitted.theta.size(); ++j) {
    slots.push_back(j);
  }
  return slots;
}

std::vector<std::size_t> joined(std::vector<std::size_t> one,
                                const std::vector<std::size_t>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

/// The information about the first `count` parameters (the free ones), given the information of the
/// points about these and the constants, all in logarithms. If the fit moves the constants, it is
/// the Schur complement. If the fit holds them, it is the inverse of A^-1 + A^-1 B S B' A^-1, with
/// A the block of the parameters, B the block next to it and S the variances of the constants; A
/// itself if A is singular.
Eigen::MatrixXd without_constants(const FitResult& fitted, const Eigen::MatrixXd& points,
                                  std::size_t count) {
  const auto p = static_cast<Eigen::Index>(count);
  const Eigen::Index k = points.rows() - p;
  if (k == 0) return points;
  const Eigen::MatrixXd own = points.topLeftCorner(p, p);
  const Eigen::MatrixXd beside = points.topRightCorner(p, k);
  Eigen::VectorXd errors(k);
  for (Eigen::Index c = 0; c < k; ++c) {
    const auto constant = static_cast<std::size_t>(c);
    const std::size_t slot = fitted.model.first_constant() + constant;
    const double slope = fitted.model.constants[constant].deviation_slope(fitted.theta[slot]);
    errors[c] = 1.0 / (scale_of(fitted, slot) * slope);
  }
  if (fitted.model.adjusts_constants()) {
    const double weight = fitted.weights.noise.constants_weight / fitted.noise_scale;
    Eigen::MatrixXd others = points.bottomRightCorner(k, k);
    others.diagonal() += (weight * errors.cwiseInverse()).cwiseAbs2();
    return own - beside * others.ldlt().solve(beside.transpose());
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(own);
  if (!lu.isInvertible()) return own;
  const Eigen::MatrixXd effects = lu.solve(beside * errors.asDiagonal());
  return (lu.inverse() + effects * effects.transpose()).inverse();
}

/// Derivatives of the weighted residuals of `data` with respect to ln theta of the slots `inner`,
/// at the estimate [n x inner].
Eigen::MatrixXd logarithmic_jacobian(const FitResult& fitted, const Observations& data,
                                     const Weights& weights,
                                     const std::vector<std::size_t>& inner) {
  const LeastSquaresProblem problem = impact_problem(fitted.model, data, weights);
  const std::size_t n = data.points.size();
  const std::size_t p = fitted.theta.size();
  std::vector<double> residuals(problem.residual_count);
  std::vector<double> full(problem.residual_count * p);
  Eigen::MatrixXd jacobian =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(inner.size()));
  if (!problem.evaluate(fitted.theta, residuals, full)) return jacobian;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < inner.size(); ++k) {
      jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          full[i * p + inner[k]] * scale_of(fitted, inner[k]) / fitted.noise_scale;
    }
  }
  return jacobian;
}

/// Standard deviations of ln theta [slots]; infinite if J'J is singular; 0 for other slots.
std::vector<double> relative_deviations(const Eigen::MatrixXd& fisher, std::size_t slots,
                                        const std::vector<std::size_t>& inner) {
  std::vector<double> sd(slots, 0.0);
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(fisher);
  const bool regular = lu.isInvertible();
  const Eigen::MatrixXd covariance =
      regular ? Eigen::MatrixXd(lu.inverse()) : Eigen::MatrixXd(fisher);
  for (std::size_t k = 0; k < inner.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    sd[inner[k]] = regular ? std::sqrt(std::max(0.0, covariance(at, at))) : INFINITY;
  }
  return sd;
}

/// A combination, with the gradient of its logarithm in ln theta.
struct Meaning {
  Combination combination;
  std::vector<double> gradient;  // [slots]
};

std::vector<Meaning> combinations_of(const FitResult& fitted) {
  std::vector<Meaning> list;
  const ImpactModel& model = fitted.model;
  for (std::size_t d = 0; d < model.contacts.size(); ++d) {
    const std::size_t H = model.slot_C_H[d];
    const std::size_t A = model.slot_C_A[d];
    const std::size_t f = model.slot_adhesion[d];
    const double total = fitted.theta[A] + 2.0 * fitted.theta[H];
    if (!(total > 0.0)) continue;
    // V_a ~ f0^(5/4), and f0 ~ W^(2/3) where W is the parameter.
    const double per_force = traits(model.adhesion).by_force ? 1.0 : 2.0 / 3.0;
    std::vector<double> near(fitted.theta.size(), 0.0);
    near[f] = 3.75 * per_force;
    near[A] += fitted.theta[A] / total;
    near[H] += 2.0 * fitted.theta[H] / total;
    list.push_back({Combination::capture_velocity, near});
    std::vector<double> far(fitted.theta.size(), 0.0);
    far[f] = per_force;
    far[A] = 1.0;
    list.push_back({Combination::adhesion_loss, far});
    std::vector<double> plateau(fitted.theta.size(), 0.0);
    plateau[H] = 1.0;
    list.push_back({Combination::plateau_loss, plateau});
  }
  return list;
}

std::optional<Combination> meaning_of(const std::vector<double>& exponents,
                                      const FitResult& fitted) {
  for (const Meaning& meaning : combinations_of(fitted)) {
    double dot = 0.0;
    double length = 0.0;
    for (std::size_t j = 0; j < exponents.size(); ++j) {
      if (!fitted.model.slots[j].free || fitted.at_bound[j]) continue;
      dot += exponents[j] * meaning.gradient[j];
      length += meaning.gradient[j] * meaning.gradient[j];
    }
    if (length > 0.0 && std::abs(dot) > close_direction * std::sqrt(length)) {
      return meaning.combination;
    }
  }
  return std::nullopt;
}

std::vector<InformationDirection> directions_of(
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>& eigen, const FitResult& fitted,
    const std::vector<std::size_t>& inner) {
  std::vector<InformationDirection> directions;
  for (Eigen::Index k = eigen.eigenvalues().size() - 1; k >= 0; --k) {
    InformationDirection direction;
    direction.exponents.assign(fitted.theta.size(), 0.0);
    Eigen::Index largest = 0;
    eigen.eigenvectors().col(k).cwiseAbs().maxCoeff(&largest);
    const double sign = eigen.eigenvectors()(largest, k) < 0.0 ? -1.0 : 1.0;
    for (std::size_t i = 0; i < inner.size(); ++i) {
      direction.exponents[inner[i]] = sign * eigen.eigenvectors()(static_cast<Eigen::Index>(i), k);
    }
    const double value = eigen.eigenvalues()(k);
    direction.relative_sd = value > 0.0 ? 1.0 / std::sqrt(value) : INFINITY;
    direction.meaning = meaning_of(direction.exponents, fitted);
    directions.push_back(std::move(direction));
  }
  return directions;
}

/// The planned observation: the one nearest in ln V, preferably of this place, moved to `velocity`.
WeightedData planned(const FitResult& fitted, const CapturePlace& place, double velocity) {
  const std::vector<Observation>& points = fitted.data.points;
  const auto distance = [&](const Observation& o) {
    const bool elsewhere = o.dataset != place.dataset || o.diameter != place.diameter;
    return std::abs(std::log(o.velocity / velocity)) + (elsewhere ? 100.0 : 0.0) +
           (o.censored ? 1000.0 : 0.0);
  };
  const auto nearest = std::min_element(
      points.begin(), points.end(),
      [&](const Observation& a, const Observation& b) { return distance(a) < distance(b); });
  const std::array<std::size_t, 1> own = {static_cast<std::size_t>(nearest - points.begin())};
  WeightedData one{fitted.data.subset(own), fitted.weights.subset(own)};
  Observation& moved = one.data.points.front();
  moved.dataset = place.dataset;
  moved.diameter = place.diameter;
  moved.velocity = velocity;
  moved.censored = false;
  moved.captured = 0;
  moved.restitution =
      predict(fitted.model, fitted.theta, place.dataset, place.diameter, velocity, false)
          .restitution();
  one.weights.points.front().scatter = 0.0;
  return one;
}

std::vector<PlannedPoints> plans_for(const FitResult& fitted,
                                     const std::vector<CapturePlace>& places,
                                     const Eigen::MatrixXd& fisher,
                                     const std::vector<std::size_t>& inner) {
  double fastest = 0.0;
  for (const Observation& o : fitted.data.points) fastest = std::max(fastest, o.velocity);
  std::vector<PlannedPoints> plans;
  for (const CapturePlace& place : places) {
    if (!(place.velocity > 0.0)) continue;
    std::vector<double> velocities;
    for (const double ratio : {1.05, 1.2, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0}) {
      if (ratio * place.velocity < fastest) velocities.push_back(ratio * place.velocity);
    }
    velocities.push_back(fastest);
    for (const double velocity : velocities) {
      const WeightedData more = planned(fitted, place, velocity);
      const Eigen::MatrixXd row = logarithmic_jacobian(fitted, more.data, more.weights,
                                                       joined(inner, constant_slots(fitted)));
      const Eigen::MatrixXd then =
          without_constants(fitted, fisher + planned_points * row.transpose() * row, inner.size());
      plans.push_back({place.dataset, place.diameter, velocity, place.velocity, planned_points,
                       relative_deviations(then, fitted.theta.size(), inner)});
    }
  }
  return plans;
}

}  // namespace

std::vector<ErrorGain> worthwhile_gains(const Information& information) {
  constexpr double worth_a_word = 0.8;  // largest ratio of new to present error worth reporting
  std::vector<ErrorGain> gains;
  if (information.plans.empty()) return gains;
  const std::vector<double>& then = information.plans.front().relative_sd;
  for (std::size_t j = 0; j < information.relative_sd.size(); ++j) {
    const double now = information.relative_sd[j];
    if (now > 0.0 && then[j] < worth_a_word * now) gains.push_back({j, now, then[j]});
  }
  return gains;
}

Information information_at(const FitResult& fitted, const std::vector<CapturePlace>& capture) {
  Information information;
  const std::vector<std::size_t> inner = inner_slots(fitted);
  information.relative_sd.assign(fitted.theta.size(), 0.0);
  if (inner.empty() || fitted.data.points.empty()) return information;
  const Eigen::MatrixXd jacobian = logarithmic_jacobian(fitted, fitted.data, fitted.weights,
                                                        joined(inner, constant_slots(fitted)));
  const Eigen::MatrixXd full = jacobian.transpose() * jacobian;
  const Eigen::MatrixXd fisher = without_constants(fitted, full, inner.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(fisher);
  information.directions = directions_of(eigen, fitted, inner);
  const double smallest = eigen.eigenvalues().minCoeff();
  information.condition = smallest > 0.0 ? eigen.eigenvalues().maxCoeff() / smallest : INFINITY;
  information.relative_sd = relative_deviations(fisher, fitted.theta.size(), inner);
  information.plans = plans_for(fitted, capture, full, inner);
  const auto worst =
      std::max_element(information.relative_sd.begin(), information.relative_sd.end()) -
      information.relative_sd.begin();
  std::stable_sort(information.plans.begin(), information.plans.end(),
                   [&](const PlannedPoints& a, const PlannedPoints& b) {
                     return a.relative_sd[static_cast<std::size_t>(worst)] <
                            b.relative_sd[static_cast<std::size_t>(worst)];
                   });
  return information;
}

}  // namespace recoil
